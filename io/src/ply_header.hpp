#pragma once
/// \file ply_header.hpp
/// The header of a PLY file. Source: G. Turk, "The PLY Polygon File Format", 1994.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace difmesh::detail {

enum class PlyType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,  ///< this and the next one are not Turk's, but written
  uint64,
  float32,
  float64
};
enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };

[[nodiscard]] constexpr std::int64_t size_of(PlyType type) {
  constexpr std::int64_t sizes[]{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_integer(PlyType type) {
  return type < PlyType::float32;
}

/// Names of the properties of vertices that are part of a mesh.
inline constexpr std::array<std::string_view, 8> kPlyNames{
    "x", "y", "z", "nx", "ny", "nz", "edge_id_low", "edge_id_high"};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;     ///< of the value, or of the members of a list
  std::optional<PlyType> length_type;  ///< set for a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;
  std::int64_t lines = 0;  ///< of the header
};

/// \throw Error file_format, naming the line.
[[nodiscard]] PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view text);

}  // namespace difmesh::detail
