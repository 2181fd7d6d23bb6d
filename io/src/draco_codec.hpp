#pragma once
/// \file draco_codec.hpp
/// Draco's library behind plain arrays. Its headers are included in draco_*.cpp only; without
/// DIFMESH_WITH_DRACO draco_missing.cpp stands in.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/io/draco_options.hpp"
#include "packed_surface.hpp"

namespace difmesh::detail {

/// What the build lacks without Draco: empty with it.
#ifdef DIFMESH_IO_HAS_DRACO
inline constexpr std::string_view kDracoMissing = {};
#else
inline constexpr std::string_view kDracoMissing = "Draco (DIFMESH_WITH_DRACO)";
#endif

struct EncodedDraco {
  std::vector<char> bytes;
  std::size_t points = 0;  ///< as Draco counts them; they may differ from what went in
  std::size_t faces = 0;
  std::vector<std::uint32_t> ids;  ///< Draco's unique id of each attribute, in their order
  std::array<float, 3> low{};      ///< box of the decoded positions
  std::array<float, 3> high{};
  double position_error = 0.0;
};

/// \throw Error invalid_argument for options out of range
void check_draco(const std::filesystem::path& path, const DracoOptions& options);
/// The bits of positions that the options ask for.
[[nodiscard]] int position_bits_of(const Mesh& mesh, const DracoOptions& options);
/// \param origin where .drc files keep it, with the attributes' names; glTF has its own places
/// \throw Error invalid_value with Draco's words if it refuses the mesh
[[nodiscard]] EncodedDraco encode_draco(const std::filesystem::path& path,
                                        const PackedPrimitive& primitive,
                                        const DracoOptions& options, int position_bits,
                                        const std::optional<Vec3>& origin = {});

enum class DracoKind : std::uint8_t { position, normal, generic, other };

struct DecodedAttribute {
  std::uint32_t id = 0;
  DracoKind kind = DracoKind::other;
  std::size_t components = 0;
  bool is_integer = false;
  std::string name;      ///< from the metadata; may be empty
  Array<double> values;  ///< components per point
};

struct DecodedDraco {
  std::size_t points = 0;
  Array<Triangle> triangles;  ///< indices below points
  std::vector<DecodedAttribute> attributes;
  std::optional<Vec3> origin;  ///< from the metadata
};

/// What the start of Draco's data promises.
struct DracoCounts {
  std::uint64_t faces = 0;
  std::uint64_t points = 0;  ///< of edgebreaker, vertices: points may be more
};
/// \throw Error file_format, for point clouds and for more than the bytes can be trusted with too
[[nodiscard]] DracoCounts draco_counts(const std::filesystem::path& path,
                                       std::span<const char> bytes);

/// \param ids of the attributes that are wanted; all of known kinds if empty
/// \throw Error file_format
[[nodiscard]] DecodedDraco decode_draco(const std::filesystem::path& path,
                                        std::span<const char> bytes,
                                        std::span<const std::uint32_t> ids = {});

}  // namespace difmesh::detail
