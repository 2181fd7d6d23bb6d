#include "sampling/sampled_function.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"

namespace difmesh::detail {

void SampledFunction::values(std::span<const Vec3> points, std::span<double> out) {
  value_(points, out);
  calls_ += static_cast<std::int64_t>(points.size());
  // x - x is 0 for finite x and NaN otherwise: one sum tells whether a closer look is needed.
  double defect = 0.0;
  for (const double value : out) {
    defect += value - value;
  }
  if (defect == 0.0) {
    return;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!std::isfinite(out[i])) {
      fail("the function", points[i], out[i]);
    }
  }
}

void SampledFunction::gradients(std::span<const Vec3> points, std::span<Vec3> out) {
  gradient_(points, out);
  gradient_calls_ += static_cast<std::int64_t>(points.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const double component : out[i]) {
      if (!std::isfinite(component)) {
        fail("the gradient", points[i], component);
      }
    }
  }
}

void SampledFunction::fail(const char* what, const Vec3& point, double value) const {
  std::string cell;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::vector<double>& faces = grid_.faces[a];
    const double index =
        faces.empty() ? std::floor((point[a] - grid_.origin[a]) / grid_.spacing[a])
                      : static_cast<double>(std::upper_bound(faces.begin(), faces.end(), point[a]) -
                                            faces.begin() - 1);
    const auto last = static_cast<double>(grid_.dims[a] - 1);
    cell += (a == 0 ? "" : ", ") +
            std::to_string(static_cast<std::int64_t>(std::clamp(index, 0.0, last)));
  }
  throw Error(ErrorCode::invalid_value, std::string(what) + " is " + rounded_text(value) + " at " +
                                            rounded_text(point) + ", in or on cell (" + cell + ")");
}

}  // namespace difmesh::detail
