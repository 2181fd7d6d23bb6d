#pragma once
/// \file names.hpp
/// What the library's choices are called on the command line and in reports.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/io/mesh_format.hpp"
#include "difmesh/io/write_mesh_options.hpp"
#include "difmesh/options.hpp"
#include "difmesh/values.hpp"

namespace difmesh::cli {

/// Both ends belong to it.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

inline constexpr std::array<Named<Placement>, 4> kPlacements{{{"midpoint", Placement::midpoint},
                                                              {"linear", Placement::linear},
                                                              {"manson", Placement::manson},
                                                              {"plic", Placement::plic}}};

inline constexpr std::array<Named<Normals>, 5> kNormals{
    {{"youngs", Normals::youngs},
     {"myc", Normals::myc},
     {"height_function", Normals::height_function},
     {"elvira", Normals::elvira},
     {"lvira", Normals::lvira}}};

inline constexpr std::array<Named<Side>, 5> kSides{{{"open", Side::open},
                                                    {"mirror", Side::mirror},
                                                    {"periodic", Side::periodic},
                                                    {"empty", Side::empty},
                                                    {"full", Side::full}}};

inline constexpr std::array<Named<ValueType>, 10> kValueTypes{{{"float32", ValueType::float32},
                                                               {"float64", ValueType::float64},
                                                               {"uint8", ValueType::uint8},
                                                               {"uint16", ValueType::uint16},
                                                               {"int8", ValueType::int8},
                                                               {"int16", ValueType::int16},
                                                               {"int32", ValueType::int32},
                                                               {"uint32", ValueType::uint32},
                                                               {"int64", ValueType::int64},
                                                               {"uint64", ValueType::uint64}}};

inline constexpr std::array<Named<ColourMap>, 2> kColourMaps{
    {{"viridis", ColourMap::viridis}, {"cool_warm", ColourMap::cool_warm}}};

inline constexpr std::array<Named<UpAxis>, 2> kUpAxes{{{"y", UpAxis::y}, {"z", UpAxis::z}}};

inline constexpr std::array<Named<DracoMethod>, 2> kDracoMethods{
    {{"edgebreaker", DracoMethod::edgebreaker}, {"sequential", DracoMethod::sequential}}};

/// The name of a value. \pre the table has it
template <class Value, std::size_t n>
[[nodiscard]] constexpr std::string_view name_of(const std::array<Named<Value>, n>& table,
                                                 Value value) {
  std::size_t i = 0;
  while (i + 1 < n && table[i].value != value) {
    ++i;
  }
  return table[i].name;
}

/// What the library takes; see options.hpp and mollify.hpp.
inline constexpr Range kPurityToleranceRange{0.0, 0.1};
inline constexpr Range kOvershootBoundRange{0.0, 1.0};
inline constexpr Range kClearanceRange{1e-13, 0.25};
inline constexpr Range kMollifyRange{1.0, 8.0};

/// Extensions that the field files of difmesh::io have, in lower case.
inline constexpr std::array<std::string_view, 3> kFieldExtensions{".npy", ".nrrd", ".nhdr"};

/// Whether a path has one of these extensions, in any case of letters.
[[nodiscard]] bool has_extension(const std::string& path,
                                 std::span<const std::string_view> extensions);
/// The words with commas between.
[[nodiscard]] std::string joined(std::span<const std::string_view> words);

/// Whether the extension is that of a mesh.
[[nodiscard]] bool is_mesh_file(const std::string& path);
/// Tells one thing of a format.
using HasFormat = bool (*)(const MeshFormat& format);
/// The extensions of all formats of meshes, or of those that have something.
[[nodiscard]] std::vector<std::string_view> mesh_extensions(HasFormat has = nullptr);
/// ".ply, .obj, .off": the same, joined.
[[nodiscard]] std::string mesh_extensions_text(HasFormat has = nullptr);

}  // namespace difmesh::cli
