#include "sampling/cell_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace difmesh::detail {
namespace {

// What a box may hide, in terms of the tolerance of the cell: there may be many.
constexpr double kNegligible = 1e-2;
// What a bulge through a face may hide: the quadrature may still see it.
constexpr double kNegligibleBulge = 0.3;
// A box that takes more than this is bisected: mostly a half of it then lends itself to another
// axis.
constexpr std::int64_t kCallsPerBox = 10'000;

// Boxes that hold surface and share a cell: their errors add up to the tolerance if that of a box
// of size h, of which there are h^-2, is tolerance h^2 in the cell.
double box_tolerance(double tolerance, double share) {
  constexpr double kRoughest = 1e-3;
  return std::min(kRoughest, tolerance / std::cbrt(share));
}

}  // namespace

CellQuadrature::Result CellQuadrature::integrate(SampledFunction& f, const Vec3& low,
                                                 const Vec3& size,
                                                 const std::array<double, 8>& corners) {
  last_call_ = f.calls() + limits_.max_calls;
  Result result;
  boxes_.clear();
  boxes_.push_back(sample_cell(f, low, size, corners));
  for (std::size_t next = 0; next < boxes_.size(); ++next) {
    const SampledBox box = boxes_[next];
    take(f, box, result);
  }
  result.subdivided = boxes_.size() > 1;
  return result;
}

// Adds the box's part to the result, or its halves to the queue.
void CellQuadrature::take(SampledFunction& f, const SampledBox& box, Result& result) {
  const auto slopes = slope_ranges(box);
  const Filling found = filling(f, box, slopes, kNegligible * limits_.tolerance);
  if (found == Filling::empty || found == Filling::full) {
    result.fraction += found == Filling::full ? box.share : 0.0;
    return;
  }
  const bool out_of_calls = f.calls() >= last_call_;
  const bool last_try = out_of_calls || box.share <= kNegligible * limits_.tolerance;
  BoxPlan plan;
  if (found == Filling::mixed) {
    plan = plan_box(f, box, slopes, kNegligibleBulge * limits_.tolerance);
    if (plan.is_graph && integrate_graph(f, box, plan.axes, last_try, result)) {
      return;
    }
  } else {
    plan.split_axis = worst_bend(box, slopes);
  }
  if (last_try) {
    constexpr double kRoughError = 0.25;
    result.fraction += box.share * rough_fraction(box, slopes);
    result.error_estimate += box.share * kRoughError;
    result.exhausted = result.exhausted || out_of_calls;
    return;
  }
  for (const SampledBox& half : bisect(f, box, plan.split_axis)) {
    boxes_.push_back(half);
  }
}

// False if the box had better be bisected.
bool CellQuadrature::integrate_graph(SampledFunction& f, const SampledBox& box,
                                     const GraphAxes& axes, bool last_try, Result& result) {
  const std::int64_t left = last_call_ - f.calls();
  const GraphQuadrature::Result part =
      quadrature_.integrate(f, box, axes,
                            {.tolerance = box_tolerance(limits_.tolerance, box.share),
                             .kink_tolerance = box_tolerance(limits_.kink_tolerance, box.share),
                             .calls = std::clamp<std::int64_t>(left, 0, kCallsPerBox)});
  // Samples that tell so little of f cannot be trusted to show whether it is monotone, either. At a
  // kink it gets no better by bisecting.
  constexpr double kUntrustedMisfit = 0.03;
  constexpr int kTrustedDepth = 3;
  const bool untrusted = part.misfit > kUntrustedMisfit && box.depth < kTrustedDepth;
  if ((part.exhausted || untrusted) && !last_try) {
    return false;
  }
  result.fraction += box.share * part.fraction;
  result.error_estimate += box.share * part.error_estimate;
  result.exhausted = result.exhausted || part.exhausted;
  return true;
}

}  // namespace difmesh::detail
