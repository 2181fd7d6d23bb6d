#pragma once
/// \file base64.hpp
/// RFC 4648, section 4.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace difmesh::detail {

/// Base64 of bytes that come in portions, after a prefix.
class Base64Encoder {
 public:
  Base64Encoder(std::string_view prefix, std::uint64_t expected_bytes);
  void add(const void* data, std::size_t bytes);
  /// The whole text; the last call.
  [[nodiscard]] std::string finish();

 private:
  void put(std::size_t digits);

  std::string text_;
  std::uint32_t bits_ = 0;
  std::size_t bytes_ = 0;  ///< in bits_
};

/// The bytes, with or without padding at the end; nothing for text that is no base64.
[[nodiscard]] std::optional<std::vector<char>> from_base64(std::string_view text);

}  // namespace difmesh::detail
