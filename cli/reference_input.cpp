#include "reference_input.hpp"

#include <utility>

#include "difmesh/error.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "long_call.hpp"
#include "mesh_scalars.hpp"
#include "names.hpp"
#ifdef DIFMESH_WITH_METRICS
#include "difmesh/metrics/point_distances.hpp"
#endif

namespace difmesh::cli {
namespace {

Array<double> distances_from_shape(const Mesh& mesh, const ReferenceInput& input) {
  const Shape shape = input.shape.make(parse_shape("--shape", input.shape_name));
  Array<double> distances;
  distances.reserve(mesh.positions.size());
  for (const Vec3& position : mesh.positions) {
    distances.push_back(shape.distance(position));
  }
  return distances;
}

#ifdef DIFMESH_WITH_METRICS
Array<double> distances_from_mesh(const Mesh& mesh, const ReferenceInput& input, bool quiet,
                                  std::vector<std::string>& warnings) {
  const Mesh reference = read_triangles(input.path, input.allow_outside, warnings);
  LongCall long_call("measuring", quiet);
  DistanceOptions options;
  options.progress = long_call.progress();
  try {
    PointDistances found = point_distances(mesh.positions, reference, options);
    long_call.done();
    return std::move(found.distances);
  } catch (const Error& error) {
    throw Error(error.code(), "'" + input.path + "': " + error.what());
  }
}
#else
Array<double> distances_from_mesh(const Mesh&, const ReferenceInput&, bool,
                                  std::vector<std::string>&) {
  throw Error(ErrorCode::invalid_argument, "difmesh was built without distances from meshes");
}
#endif

}  // namespace

void add_reference_options(CLI::App& command, ReferenceInput& input) {
  command
      .add_option(
          "--shape", input.shape_name,
          "What the surface should be: sphere, ellipsoid, torus, genus,\nsmooth_box or golf_ball")
      ->option_text("SHAPE");
  command
      .add_option("--reference", input.path,
                  "What the surface should be: a mesh\n(" + mesh_extensions_text() + ")")
      ->option_text("MESHFILE");
  add_shape_options(command, input.shape);
}

void check_reference(const ReferenceInput& input) {
  if (!input.shape_name.empty() && !input.path.empty()) {
    throw CLI::ValidationError("--shape", "cannot be used together with --reference");
  }
  if (input.shape_name.empty() && !input.shape.given.empty()) {
    throw CLI::ValidationError(input.shape.given.front(), "only with --shape");
  }
  if (!input.shape_name.empty()) {
    (void)input.shape.make(parse_shape("--shape", input.shape_name));
  }
}

Mesh read_triangles(const std::string& path, bool allow_outside,
                    std::vector<std::string>& warnings) {
  MeshFile read = read_mesh_file(path, {.outside_files = allow_outside});
  warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
  if (read.mesh.triangles.empty()) {
    throw Error(ErrorCode::file_format, "'" + path + "': the mesh has no triangles");
  }
  return std::move(read.mesh);
}

VertexScalar errors_of(const Mesh& mesh, const ReferenceInput& input, bool quiet,
                       std::vector<std::string>& warnings) {
  return {kErrorName, input.shape_name.empty() ? distances_from_mesh(mesh, input, quiet, warnings)
                                               : distances_from_shape(mesh, input)};
}

}  // namespace difmesh::cli
