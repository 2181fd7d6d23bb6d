#pragma once
/// \file elements.hpp
/// Elements of fields: sizes, byte orders and conversion between types.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"

namespace difmesh::detail {

inline constexpr bool kBigEndianHost = std::endian::native == std::endian::big;

/// "3 x 4 x 5".
[[nodiscard]] std::string to_text(const Index3& dims);
/// Bytes of a field as a file's header promises it. \throw Error file_format if a dim is below 1,
///   too_large if the product overflows.
[[nodiscard]] std::int64_t bytes_promised(const std::filesystem::path& path, const Index3& dims,
                                          std::int64_t element_bytes);
/// Reverses the bytes of each element, in place.
void swap_bytes(std::byte* elements, std::int64_t bytes, std::int64_t element_bytes);

using ByteSink = std::function<void(const std::byte* bytes, std::size_t count)>;

/// Hands the field over row by row, x fastest, as little-endian elements of type `to`.
/// \throw Error invalid_value for a NaN that has to become an integer.
void write_elements(const FieldView& field, ScalarType to, const ByteSink& sink);

}  // namespace difmesh::detail
