#include "difmesh/metrics/distance.hpp"

#include <algorithm>

#include "boundary.hpp"
#include "convert.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::Vec3;

difmesh::DistanceOptions to_options(const dif_distance_options* options) {
  dif_distance_options defaults{};
  dif_distance_options_init(&defaults, sizeof defaults);
  const dif_distance_options given = capi::read_struct(options, defaults, "options");
  difmesh::DistanceOptions result;
  result.facet_spacing = given.facet_spacing;
  result.with_sign = capi::to_bool(given.with_sign, "with_sign");
  result.threads = given.threads;
  result.progress = capi::to_progress(given.progress, given.progress_user);
  return result;
}

dif_statistics to_statistics(const difmesh::DistanceStatistics& from) {
  dif_statistics result{};
  result.points = from.points;
  result.rms = from.rms;
  result.mean = from.mean;
  result.signed_mean = from.signed_mean;
  result.lowest = from.lowest;
  result.highest = from.highest;
  result.maximum = from.maximum;
  result.maximum_index = from.maximum_index;
  std::copy(from.maximum_position.begin(), from.maximum_position.end(), result.maximum_position);
  return result;
}

void hand_over(const difmesh::Distance& from, dif_distance* to, const char* name) {
  dif_distance result{};
  result.vertices = to_statistics(from.vertices);
  result.facets = to_statistics(from.facets);
  result.area = from.area;
  result.reach = from.reach;
  result.has_sign = from.has_sign ? 1 : 0;
  capi::write_output(to, result, name);
}

}  // namespace

dif_status dif_distance_to_shape(const dif_mesh* mesh, const dif_shape* shape,
                                 const dif_distance_options* options, dif_distance* result) {
  return capi::guarded([&] {
    const difmesh::Mesh& surface = capi::required(mesh, "mesh").mesh;
    const difmesh::Shape& body = capi::required(shape, "shape").shape;
    capi::check_output(result, "distance");
    hand_over(difmesh::distance(surface, body, to_options(options)), result, "distance");
  });
}

dif_status dif_distance_to_function(const dif_mesh* mesh, dif_function function, void* user,
                                    const dif_distance_options* options, dif_distance* result) {
  return capi::guarded([&] {
    const difmesh::Mesh& surface = capi::required(mesh, "mesh").mesh;
    if (function == nullptr) {
      capi::fail_argument("argument 'function' is NULL");
    }
    capi::check_output(result, "distance");
    const difmesh::SignedDistance signed_distance =
        capi::with_callers_settings([function, user](const Vec3& point) {
          double value = 0.0;
          if (function(user, 1, point.data(), &value) != 0) {
            throw difmesh::Error(difmesh::ErrorCode::cancelled, "cancelled by the function");
          }
          return value;
        });
    hand_over(difmesh::distance(surface, signed_distance, to_options(options)), result, "distance");
  });
}

dif_status dif_distance_to_mesh(const dif_mesh* mesh, const dif_mesh* reference,
                                const dif_distance_options* options, dif_distance* result,
                                dif_distance* back) {
  return capi::guarded([&] {
    const difmesh::Mesh& surface = capi::required(mesh, "mesh").mesh;
    const difmesh::Mesh& truth = capi::required(reference, "reference").mesh;
    capi::check_output(result, "distance");
    difmesh::DistanceOptions given = to_options(options);
    given.both_ways = back != nullptr;
    if (back != nullptr) {
      capi::check_output(back, "back");
    }
    const difmesh::MeshDistance found = difmesh::distance(surface, truth, given);
    hand_over(found.to_reference, result, "distance");
    if (back != nullptr) {
      hand_over(found.from_reference, back, "back");
    }
  });
}
