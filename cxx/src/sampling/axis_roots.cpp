#include "sampling/axis_roots.hpp"

#include <algorithm>
#include <cmath>

namespace difmesh::detail {
namespace {

// Every third step from here on halves the bracket if the others have not.
constexpr int kFirstGuardedRound = 4;
constexpr int kGuardInterval = 3;
// Bisection alone ends after as many rounds as a double has bits; twice that never happens.
constexpr int kMaxRounds = 200;

}  // namespace

void AxisRoots::add(const Start& start) {
  lines_.push_back({.point = start.point,
                    .t = start.guess,
                    .low = start.low,
                    .high = start.high,
                    .slope = start.slope,
                    .negative_low = start.negative_low});
}

void AxisRoots::evaluate(SampledFunction& f, const LineFrame& frame) {
  points_.resize(active_.size());
  values_.resize(active_.size());
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Line& line = lines_[active_[i]];
    points_[i] = line.point;
    points_[i][frame.axis] = frame.low + frame.size * line.t;
  }
  f.values(points_, values_);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    lines_[active_[i]].f = values_[i];
  }
}

// Narrows the bracket by the value at t and sets the step to the next t: along the model's slope
// first, along the secant then, to an end not yet seen where these leave the bracket, or to its
// middle.
void AxisRoots::propose(Line& line, int round) {
  const bool negative = line.f < 0.0;
  const bool at_low_side = negative == line.negative_low;
  (at_low_side ? line.low : line.high) = line.t;
  (at_low_side ? line.low_seen : line.high_seen) = true;
  if (round > 0) {
    line.slope = (line.f - line.f_before) / (line.t - line.t_before);
  }
  const double middle = 0.5 * (line.low + line.high);
  double next = line.t - line.f / line.slope;
  const bool rising = line.negative_low ? line.slope > 0.0 : line.slope < 0.0;
  if (!rising || !std::isfinite(next)) {
    next = middle;
  } else if (next < line.low) {
    next = line.low_seen ? middle : line.low;
  } else if (next > line.high) {
    next = line.high_seen ? middle : line.high;
  }
  if (round >= kFirstGuardedRound && (round - kFirstGuardedRound) % kGuardInterval == 0) {
    const double width = line.high - line.low;
    if (width > 0.5 * line.width_before) {
      next = middle;
    }
    line.width_before = width;
  }
  line.step_before = line.step;
  line.step = next - line.t;
}

// The error left after the step. After the first one, the slope's relative error is taken to be ten
// times the worst misfit of the model in the box: between the nodes of a quadratic model its slope
// is off by up to ten times as much as its value. After that it is the secant's e0 e1 f'' / 2 f',
// with f'' / f' at most 4.
bool AxisRoots::accept(const Line& line, double tolerance, int round) const {
  if (line.f == 0.0 || line.high - line.low <= tolerance) {
    return true;
  }
  const double step = std::abs(line.step);
  const double before = std::abs(line.step_before);
  return step * (round == 0 ? std::max(1e-7, 10.0 * misfit_) : std::min(1.0, 2.0 * before)) <=
         tolerance;
}

void AxisRoots::solve(SampledFunction& f, const LineFrame& frame, double tolerance) {
  active_.resize(lines_.size());
  for (std::size_t i = 0; i < active_.size(); ++i) {
    active_[i] = static_cast<std::uint32_t>(i);
  }
  for (int round = 0; !active_.empty(); ++round) {
    evaluate(f, frame);
    for (const std::uint32_t i : active_) {
      propose(lines_[i], round);
      if (round == 0) {
        misfit_ = std::max(misfit_, std::abs(lines_[i].step));
      }
    }
    std::size_t kept = 0;
    for (const std::uint32_t i : active_) {
      Line& line = lines_[i];
      const bool done = accept(line, tolerance, round) || round == kMaxRounds;
      line.t_before = line.t;
      line.f_before = line.f;
      if (line.f != 0.0) {
        line.t += line.step;
      }
      if (!done) {
        active_[kept++] = i;
      }
    }
    active_.resize(kept);
  }
}

}  // namespace difmesh::detail
