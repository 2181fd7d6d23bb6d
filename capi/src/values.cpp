#include "difmesh/values.hpp"

#include <limits>

#include "boundary.hpp"
#include "convert.hpp"

namespace capi = difmesh::capi;

dif_status dif_fractions_from_values(const dif_field* values, double empty, double full,
                                     double* fractions) {
  return capi::guarded([&] {
    const difmesh::ValueView view = capi::to_values(values);
    fractions_from_values(view, {empty, full}, &capi::required(fractions, "fractions"));
  });
}

dif_status dif_fractions_from_labels(const dif_field* values, int64_t count, const int64_t* labels,
                                     uint8_t* fractions) {
  return capi::guarded([&] {
    const difmesh::ValueView view = capi::to_values(values);
    capi::required_array(labels, count, "labels");
    fractions_from_labels(view, {labels, capi::to_size(count)},
                          &capi::required(fractions, "fractions"));
  });
}

dif_status dif_value_extremes(const dif_field* values, double* lowest, double* highest) {
  return capi::guarded([&] {
    const difmesh::ValueView view = capi::to_values(values);
    capi::required(lowest, "lowest");
    capi::required(highest, "highest");
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto found = extremes_of(view).value_or(difmesh::ValueExtremes{nan, nan});
    *lowest = found.lowest;
    *highest = found.highest;
  });
}
