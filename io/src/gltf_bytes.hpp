#pragma once
/// \file gltf_bytes.hpp
/// glTF is little endian, and its chunks and views start at multiples of four bytes.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace difmesh::detail {

/// The most vertices that indices of 16 bits can name: 65535 itself restarts strips.
inline constexpr std::size_t kMostShortIndices = 65535;

[[nodiscard]] constexpr std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + 3U) / 4U * 4U;
}

/// The number whose bytes in memory are those of `value` in little-endian order, and back.
template <class T>
[[nodiscard]] T little_endian(T value) {
  if constexpr (std::endian::native == std::endian::big) {
    unsigned char bytes[sizeof(T)];
    unsigned char swapped[sizeof(T)];
    std::memcpy(bytes, &value, sizeof value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      swapped[i] = bytes[sizeof(T) - 1 - i];
    }
    std::memcpy(&value, swapped, sizeof value);
  }
  return value;
}

}  // namespace difmesh::detail
