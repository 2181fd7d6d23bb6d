#include "difmesh/curvature.hpp"

#include <algorithm>

#include "boundary.hpp"
#include "convert.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

difmesh::CurvatureOptions to_options(const dif_curvature_options* options) {
  dif_curvature_options defaults{};
  dif_curvature_options_init(&defaults, sizeof defaults);
  const dif_curvature_options given = capi::read_struct(options, defaults, "options");
  difmesh::CurvatureOptions result;
  result.rings = given.rings;
  result.threads = given.threads;
  result.progress = capi::to_progress(given.progress, given.progress_user);
  return result;
}

void copy(const difmesh::Array<double>& from, double* to) {
  if (to != nullptr) {
    std::copy(from.begin(), from.end(), to);
  }
}

}  // namespace

dif_status dif_curvature_options_init(dif_curvature_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::CurvatureOptions defaults;
    dif_curvature_options value{};
    value.rings = defaults.rings;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_mesh_curvature(const dif_mesh* mesh, const dif_curvature_options* options,
                              double* mean, double* gaussian, double* largest, double* smallest) {
  return capi::guarded([&] {
    const difmesh::Mesh& surface = capi::required(mesh, "mesh").mesh;
    difmesh::CurvatureOptions given = to_options(options);
    given.principal = largest != nullptr || smallest != nullptr;
    const difmesh::Curvature result = curvature(surface, given);
    copy(result.mean, mean);
    copy(result.gaussian, gaussian);
    copy(result.largest, largest);
    copy(result.smallest, smallest);
  });
}
