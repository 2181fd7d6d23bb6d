// The table of formats, and what can be asked of it.

#include "difmesh/io/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh {
namespace detail {

namespace {

#define DIFMESH_MESH_FORMAT(name) &name##_format,
constexpr std::array kParts{
#include "format_list.hpp"
};
#undef DIFMESH_MESH_FORMAT

std::array<MeshFormat, kParts.size()> make_facts() noexcept {
  std::array<MeshFormat, kParts.size()> facts{};
  std::ranges::transform(kParts, facts.begin(), [](const FormatPart* part) {
    MeshFormat row = part->facts;
    row.streamed = part->encoder != nullptr;
    return row;
  });
  return facts;
}

/// ".ply, .obj and .off", of the formats that have something.
template <class Has>
std::string extensions(const Has& has) {
  std::vector<std::string_view> found;
  for (const FormatPart* part : kParts) {
    if (has(part->facts)) {
      found.push_back(part->facts.extension);
    }
  }
  std::string text;
  for (std::size_t n = 0; n < found.size(); ++n) {
    text += n == 0 ? "" : n + 1 == found.size() ? " and " : ", ";
    text += found[n];
  }
  return text;
}

/// In the letters of the table, with a dot.
std::string normal_extension(std::string_view extension) {
  std::string normal = extension.starts_with('.') ? "" : ".";
  normal += lower_case(extension);
  return normal;
}

const FormatPart* find_part(std::string_view extension) {
  const std::string small = normal_extension(extension);
  const auto* const found = std::ranges::find_if(
      kParts, [&](const FormatPart* part) { return part->facts.extension == small; });
  return found == kParts.end() ? nullptr : *found;
}

}  // namespace

const FormatPart& format_part(const std::filesystem::path& path, const std::string& extension,
                              ErrorCode unknown) {
  const std::string start =
      (unknown == ErrorCode::file_format ? "" : "cannot write ") + quoted(path) + ": ";
  const FormatPart* const part = find_part(extension);
  if (part == nullptr) {
    throw Error(unknown, start + "unknown extension " + in_quotes(extension) +
                             "; meshes have the extensions " +
                             extensions([](const MeshFormat&) { return true; }));
  }
  if (!part->facts.is_available()) {
    throw Error(ErrorCode::unsupported,
                start + "difmesh was built without " + std::string(part->facts.needs));
  }
  return *part;
}

namespace {

/// Rejects options that the format cannot honour.
void check_options(const std::filesystem::path& path, const MeshFormat& format,
                   const WriteMeshOptions& options) {
  const auto check = [&](bool is_set, const char* option, const auto& has) {
    if (is_set && !has(format)) {
      fail_write(ErrorCode::invalid_argument, path,
                 std::string(format.name) + " has no place for the option " + option + "; " +
                     extensions(has) + " have");
    }
  };
  const WriteMeshOptions usual;
  const auto is_scene = [](const MeshFormat& f) { return f.scene; };
  check(options.color.has_value(), "color", [](const MeshFormat& f) { return f.colors; });
  check(options.draco.has_value(), "draco",
        [](const MeshFormat& f) { return f.compression != Compression::none; });
  check(options.up != usual.up, "up", is_scene);
  check(options.metres_per_unit != usual.metres_per_unit, "metres_per_unit", is_scene);
  check(options.local_origin.has_value(), "local_origin", is_scene);
  check(options.most_vertices != usual.most_vertices, "most_vertices", is_scene);
  check(options.name != usual.name, "name", is_scene);
}

}  // namespace

const FormatPart& format_to_write(const std::filesystem::path& path,
                                  const WriteMeshOptions& options) {
  const FormatPart& part =
      format_part(path, options.format.empty() ? extension_of(path) : options.format,
                  ErrorCode::invalid_argument);
  check_options(path, part.facts, options);
  return part;
}

MeshContents contents_of(const MeshPortion& portion, const MeshFormat& format,
                         const WriteMeshOptions& options) {
  MeshContents contents;
  contents.normals = format.normals && options.normals && !portion.normals.empty();
  contents.edge_ids = format.edge_ids && options.edge_ids && !portion.edge_ids.empty();
  if (format.scalars && options.scalars) {
    for (const VertexScalar& scalar : portion.scalars) {
      contents.scalars.push_back(scalar.name);
    }
  }
  return contents;
}

}  // namespace detail

std::span<const MeshFormat> mesh_formats() noexcept {
  static const auto facts = detail::make_facts();
  return facts;
}

const MeshFormat* find_mesh_format(std::string_view extension) {
  const std::string small = detail::normal_extension(extension);
  const auto found = std::ranges::find(mesh_formats(), small, &MeshFormat::extension);
  return found == mesh_formats().end() ? nullptr : &*found;
}

const MeshFormat* mesh_format_of(const std::filesystem::path& path) {
  return find_mesh_format(detail::extension_of(path));
}

}  // namespace difmesh
