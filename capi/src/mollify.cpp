#include "difmesh/mollify.hpp"

#include <algorithm>

#include "boundary.hpp"
#include "convert.hpp"

namespace capi = difmesh::capi;

dif_status dif_mollify_options_init(dif_mollify_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    const difmesh::MollifyOptions defaults;
    dif_mollify_options value{};
    value.radius = defaults.radius;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_mollify(const dif_field* field, const dif_mollify_options* options, double* values) {
  return capi::guarded([&] {
    const difmesh::FieldView view = capi::to_view(field);
    capi::required(values, "values");
    capi::require_uniform(field, "mollification counts cells alike along each axis");
    dif_mollify_options defaults{};
    dif_mollify_options_init(&defaults, sizeof defaults);
    const dif_mollify_options given = capi::read_struct(options, defaults, "options");
    capi::require_zero(given.reserved, "options");
    difmesh::MollifyOptions chosen;
    chosen.radius = given.radius;
    chosen.boundary = capi::to_boundary(given.boundary);
    chosen.threads = given.threads;
    chosen.progress = capi::to_progress(given.progress, given.progress_user);
    const difmesh::Array<double> smooth = mollify(view, chosen);
    std::copy(smooth.begin(), smooth.end(), values);
  });
}
