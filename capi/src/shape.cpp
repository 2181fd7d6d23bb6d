#include <algorithm>
#include <array>
#include <string>

#include "boundary.hpp"
#include "convert.hpp"
#include "difmesh/shapes.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

// The constants follow the names from 1 on.
difmesh::ShapeKind to_kind(std::int32_t kind) {
  if (kind < 1 || kind > static_cast<std::int32_t>(difmesh::shape_names().size())) {
    capi::fail_argument("kind is " + std::to_string(kind) + "; DIF_SHAPE_SPHERE to " +
                        "DIF_SHAPE_GOLF_BALL are possible");
  }
  return static_cast<difmesh::ShapeKind>(kind - 1);
}

}  // namespace

dif_status dif_shape_options_init(dif_shape_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::ShapeOptions defaults;
    dif_shape_options value{};
    value.kind = DIF_SHAPE_SPHERE;
    value.radius = defaults.radius;
    value.tube_radius = defaults.tube_radius;
    std::copy(defaults.semi_axes.begin(), defaults.semi_axes.end(), value.semi_axes);
    value.exponent = defaults.exponent;
    value.scale = defaults.scale;
    value.dimples = defaults.dimples;
    value.dimple_radius = defaults.dimple_radius;
    value.dimple_depth = defaults.dimple_depth;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_shape_create(const dif_shape_options* options, dif_shape** shape) {
  return capi::guarded([&] {
    dif_shape*& handle = capi::out_handle(shape, "shape");
    dif_shape_options defaults{};
    dif_shape_options_init(&defaults, sizeof defaults);
    const dif_shape_options given = capi::read_struct(options, defaults, "options");
    capi::require_zero(given.reserved, "options");
    difmesh::ShapeOptions wanted;
    wanted.kind = to_kind(given.kind);
    wanted.centre = capi::to_vec(given.centre);
    wanted.rotation_degrees = capi::to_vec(given.rotation_degrees);
    wanted.radius = given.radius;
    wanted.tube_radius = given.tube_radius;
    wanted.semi_axes = capi::to_vec(given.semi_axes);
    wanted.exponent = given.exponent;
    wanted.scale = given.scale;
    wanted.dimples = given.dimples;
    wanted.dimple_radius = given.dimple_radius;
    wanted.dimple_depth = given.dimple_depth;
    handle = new dif_shape{make_shape(wanted)};
  });
}

void dif_shape_free(dif_shape* shape) {
  delete shape;
}

dif_status dif_shape_bounds(const dif_shape* shape, double low[3], double high[3]) {
  return capi::guarded([&] {
    const difmesh::Bounds bounds = capi::required(shape, "shape").shape.bounds();
    capi::required(low, "low");
    capi::required(high, "high");
    std::copy(bounds.low.begin(), bounds.low.end(), low);
    std::copy(bounds.high.begin(), bounds.high.end(), high);
  });
}

dif_status dif_shape_volume(const dif_shape* shape, double* volume) {
  return capi::guarded([&] {
    const std::optional<double> known = capi::required(shape, "shape").shape.volume();
    double& result = capi::required(volume, "volume");
    if (!known) {
      throw capi::Failure(DIF_ERROR_UNSUPPORTED, "the volume of this shape is not known");
    }
    result = *known;
  });
}

dif_status dif_shape_distances(const dif_shape* shape, int64_t count, const double* points,
                               double* distances) {
  return capi::guarded([&] {
    const difmesh::Shape& body = capi::required(shape, "shape").shape;
    capi::required_array(points, count, "points");
    capi::required_array(distances, count, "distances");
    body.distances(capi::to_points(points, count), {distances, capi::to_size(count)});
  });
}
