#include "difmesh/io/mesh_file.hpp"

#include <memory>
#include <string_view>
#include <utility>

#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "encoded_file.hpp"
#include "format_part.hpp"
#include "memory.hpp"
#include "mesh_check.hpp"
#include "packed_surface.hpp"
#include "text.hpp"

namespace difmesh {
namespace {

using namespace detail;

MeshFileReport write_encoded(const std::filesystem::path& path, const Mesh& mesh,
                             const FormatPart& part, const WriteMeshOptions& options) {
  const MeshPortion whole = portion_of(mesh);
  const EncoderRequest request{path, contents_of(whole, part.facts, options), true};
  std::unique_ptr<MeshEncoder> encoder = part.encoder(request);
  AtomicFile file(path);
  EncodedFile encoded(file, std::move(encoder),
                      MeshCounts{mesh.positions.size(), mesh.triangles.size()});
  encoded.add(whole);
  return encoded.finish();
}

}  // namespace

MeshFileReport write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options) {
  const DefaultFloatEnvironment environment;
  const FormatPart& part = format_to_write(path, options);
  const MeshFormat& facts = part.facts;
  check_portion(path, portion_of(mesh), {},
                part.float32_positions ? facts.name : std::string_view());
  if (facts.scalars) {
    check_scalars(path, written_scalars(mesh, options));
  }
  return part.encoder != nullptr ? write_encoded(path, mesh, part, options)
                                 : part.write(path, mesh, options);
}

MeshFile read_mesh_file(const std::filesystem::path& path, const ReadMeshOptions& options) {
  const DefaultFloatEnvironment environment;
  const FormatPart& part = format_part(path, extension_of(path), ErrorCode::file_format);
  return naming_file(path, [&] { return part.read(path, options); });
}

Mesh read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
  return read_mesh_file(path, options).mesh;
}

}  // namespace difmesh
