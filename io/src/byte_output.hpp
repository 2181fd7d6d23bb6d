#pragma once
/// \file byte_output.hpp
/// Bytes and numbers that go somewhere in large pieces.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

class ByteOutput {
 public:
  ByteOutput() : buffer_(kBufferSize) {}
  virtual ~ByteOutput() = default;
  ByteOutput(const ByteOutput&) = delete;
  ByteOutput& operator=(const ByteOutput&) = delete;

  /// Inline, as most calls are of a few bytes whose number is known where they stand.
  void write(const void* data, std::size_t bytes) {
    if (bytes > buffer_.size() - used_) {
      write_in_pieces(data, bytes);
    } else if (bytes > 0) {
      std::memcpy(buffer_.data() + used_, data, bytes);
      used_ += bytes;
    }
  }
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Shortest decimal form that reads as the same number.
  void write_number(double number);
  void write_number(std::uint64_t number);
  /// "x y z", each as above.
  void write_vector(const Vec3& vector);
  /// Bytes written so far.
  [[nodiscard]] std::int64_t size() const { return drained_ + static_cast<std::int64_t>(used_); }

 protected:
  static constexpr std::size_t kBufferSize = std::size_t{1} << 18;

  /// Hands on what waits.
  void flush();
  /// What waits: all that was written, if nothing was handed on yet.
  [[nodiscard]] std::string_view waiting() const { return {buffer_.data(), used_}; }

 private:
  /// Takes all bytes. \throw Error file_write
  virtual void drain(const char* data, std::size_t bytes) = 0;
  void write_in_pieces(const void* data, std::size_t bytes);
  void make_room(std::size_t bytes);

  std::int64_t drained_ = 0;
  std::size_t used_ = 0;
  std::vector<char> buffer_;
};

}  // namespace difmesh::detail
