#include "sampling/sampled_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace difmesh::detail {
namespace {

// Between samples f departs from its multilinear interpolant by at most an eighth of its second
// differences over their spacing, summed over the axes. This is how many times larger than those of
// the samples themselves they are allowed to be.
constexpr double kBendSafety = 4.0;
// A sample this close to 0 in terms of the largest one is as good as 0.
constexpr double kNoise = 1e-13;
// Slopes along the height axis: the least over the greatest, and over the greatest along other
// axes.
constexpr double kLeastSteadiness = 0.15;
constexpr double kLeastDominance = 0.25;
// The same for cuts of faces; a curve may be steeper than a surface before it becomes expensive.
constexpr double kLeastFaceSteadiness = 0.1;
constexpr double kLeastFaceDominance = 0.1;

std::array<std::size_t, 2> others(std::size_t axis) {
  return {(axis + 1) % 3, (axis + 2) % 3};
}

Vec3 sample_point(const SampledBox& box, std::size_t index) {
  const std::array<std::size_t, 3> ijk{index % 3, index / 3 % 3, index / 9};
  Vec3 point;
  for (std::size_t a = 0; a < 3; ++a) {
    point[a] = box.low[a] + box.size[a] * (0.5 * static_cast<double>(ijk[a]));
  }
  return point;
}

bool is_corner(std::size_t index) {
  return index % 3 != 1 && index / 3 % 3 != 1 && index / 9 != 1;
}

constexpr double kHuge = std::numeric_limits<double>::max();
constexpr SlopeRange kNoSlopes{.low = kHuge, .high = -kHuge, .bend = 0.0};

double score(double steadiest, double largest_other) {
  return largest_other > 0.0 ? steadiest / largest_other : std::numeric_limits<double>::infinity();
}

}  // namespace

SampledBox sample_cell(SampledFunction& f, const Vec3& low, const Vec3& size,
                       const std::array<double, 8>& corners) {
  SampledBox box{.low = low, .size = size};
  std::array<Vec3, 19> points;
  std::array<double, 19> values;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    if (!is_corner(i)) {
      points[count++] = sample_point(box, i);
    }
  }
  f.values(points, values);
  count = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    box.f[i] = is_corner(i) ? corners[i % 3 / 2 + i / 3 % 3 / 2 * 2 + i / 18 * 4] : values[count++];
  }
  return box;
}

std::array<SampledBox, 2> bisect(SampledFunction& f, const SampledBox& box, std::size_t axis) {
  std::array<SampledBox, 2> halves;
  std::array<Vec3, 18> points;
  std::array<double, 18> values;
  std::size_t count = 0;
  for (std::size_t half = 0; half < 2; ++half) {
    SampledBox& part = halves[half];
    part = {.low = box.low, .size = box.size, .share = 0.5 * box.share, .depth = box.depth + 1};
    part.size[axis] *= 0.5;
    part.low[axis] += static_cast<double>(half) * part.size[axis];
    for (std::size_t i = 0; i < 27; ++i) {
      const std::size_t position = i / kSampleStep[axis] % 3;
      if (position == 1) {
        points[count++] = sample_point(part, i);
      } else {
        part.f[i] =
            box.f[i - position * kSampleStep[axis] + (half + position / 2) * kSampleStep[axis]];
      }
    }
  }
  f.values(points, values);
  count = 0;
  for (SampledBox& part : halves) {
    for (std::size_t i = 0; i < 27; ++i) {
      if (i / kSampleStep[axis] % 3 == 1) {
        part.f[i] = values[count++];
      }
    }
  }
  return halves;
}

double SlopeRange::largest() const {
  return std::max(std::abs(low), std::abs(high));
}

double SlopeRange::steadiest() const {
  return std::max({low, -high, 0.0});
}

void SlopeRange::include(double before, double middle, double after) {
  const double first = 2.0 * (middle - before);
  const double second = 2.0 * (after - middle);
  const double half_bend = 0.5 * (second - first);
  const double start = first - half_bend;
  const double end = second + half_bend;
  low = std::min({low, start, end});
  high = std::max({high, start, end});
  bend = std::max(bend, std::abs(half_bend));
}

std::array<SlopeRange, 3> slope_ranges(const SampledBox& box) {
  std::array<SlopeRange, 3> slopes{kNoSlopes, kNoSlopes, kNoSlopes};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = kSampleStep[axis];
    const auto [b, c] = others(axis);
    for (std::size_t line = 0; line < 9; ++line) {
      const std::size_t start = line % 3 * kSampleStep[b] + line / 3 * kSampleStep[c];
      slopes[axis].include(box.f[start], box.f[start + step], box.f[start + 2 * step]);
    }
  }
  return slopes;
}

SlopeRange face_slope_range(const SampledBox& box, std::size_t axis, std::size_t face_axis,
                            std::size_t face) {
  SlopeRange slopes = kNoSlopes;
  const std::size_t step = kSampleStep[axis];
  const std::size_t other = 3 - axis - face_axis;
  for (std::size_t line = 0; line < 3; ++line) {
    const std::size_t start = line * kSampleStep[other] + 2 * face * kSampleStep[face_axis];
    slopes.include(box.f[start], box.f[start + step], box.f[start + 2 * step]);
  }
  return slopes;
}

bool one_signed(double low, double high, double bend) {
  if (low < 0.0 && high >= 0.0) {
    return false;
  }
  const double nearest = std::min(std::abs(low), std::abs(high));
  const double farthest = std::max(std::abs(low), std::abs(high));
  return nearest + kNoise * farthest >= kBendSafety / 8.0 * bend;
}

namespace {

// Least value on [0,1] of the parabola through values at 0, 1/2 and 1.
double parabola_minimum(double v0, double v1, double v2) {
  const double bend = v0 - 2.0 * v1 + v2;
  const double slope = 2.0 * (v1 - v0) - bend;
  const double turn = -slope / (4.0 * bend);
  const double least = std::min({v0, v1, v2});
  return bend > 0.0 && turn > 0.0 && turn < 1.0
             ? std::min(least, v0 + turn * (slope + turn * 2.0 * bend))
             : least;
}

// Least value of the parabolas through the samples times `sign` in one of the planes of samples.
double plane_minimum(const SampledBox& box, std::size_t plane_axis, std::size_t plane,
                     double sign) {
  const auto [a, b] = others(plane_axis);
  double least = kHuge;
  for (const auto& [along, across] : {std::pair{a, b}, std::pair{b, a}}) {
    std::array<double, 3> minima;
    for (std::size_t line = 0; line < 3; ++line) {
      const double* v = box.f.data() + line * kSampleStep[across] + plane * kSampleStep[plane_axis];
      minima[line] = parabola_minimum(sign * v[0], sign * v[kSampleStep[along]],
                                      sign * v[2 * kSampleStep[along]]);
    }
    least = std::min(least, parabola_minimum(minima[0], minima[1], minima[2]));
  }
  return least;
}

// The same in the box.
double box_minimum(const SampledBox& box, double sign) {
  double least = kHuge;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least = std::min(least, parabola_minimum(plane_minimum(box, axis, 0, sign),
                                             plane_minimum(box, axis, 1, sign),
                                             plane_minimum(box, axis, 2, sign)));
  }
  return least;
}

// The parabolas through the samples at a place in [0,1]^3.
double parabolas_at(const SampledBox& box, const Vec3& t) {
  std::array<Vec3, 3> weight;
  for (std::size_t a = 0; a < 3; ++a) {
    weight[a] = {(1.0 - t[a]) * (1.0 - 2.0 * t[a]), 4.0 * t[a] * (1.0 - t[a]),
                 t[a] * (2.0 * t[a] - 1.0)};
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < 27; ++i) {
    sum += weight[0][i % 3] * weight[1][i / 3 % 3] * weight[2][i / 9] * box.f[i];
  }
  return sum;
}

// Where f times `sign` is likely to be least: at the turns of the three parabolas through the least
// sample, but off the samples, which parabolas cannot miss.
Vec3 likely_minimum(const SampledBox& box, double sign) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < 27; ++i) {
    least = sign * box.f[i] < sign * box.f[least] ? i : least;
  }
  Vec3 t;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t position = least / kSampleStep[a] % 3;
    const double* v = box.f.data() + least - position * kSampleStep[a];
    const double bend = v[0] - 2.0 * v[kSampleStep[a]] + v[2 * kSampleStep[a]];
    const double slope = 2.0 * (v[kSampleStep[a]] - v[0]) - bend;
    const double turn = -slope / (4.0 * bend);
    const double sample = 0.5 * static_cast<double>(position);
    const double nearest = position == 2 ? 0.875 : sample + 0.125;
    const bool between = turn > 0.0 && turn < 1.0 && std::abs(turn - sample) > 0.125;
    t[a] = between ? turn : nearest;
  }
  return t;
}

// How far f may go beyond 0 in a box of samples of one sign. Parabolas are trusted if they are
// right where f is least by them; else it takes all that the second differences allow.
double possible_reach(SampledFunction& f, const SampledBox& box, double bend, double sign) {
  constexpr double kTrustedMisfit = 0.02;
  const Vec3 t = likely_minimum(box, sign);
  const Vec3 x{box.low[0] + t[0] * box.size[0], box.low[1] + t[1] * box.size[1],
               box.low[2] + t[2] * box.size[2]};
  double value = 0.0;
  f.values({&x, 1}, {&value, 1});
  const double misfit = std::abs(value - parabolas_at(box, t));
  if (misfit > kTrustedMisfit * bend || sign * value < 0.0) {
    return kBendSafety / 8.0 * bend;
  }
  return std::max(0.0, -box_minimum(box, sign)) + 2.0 * misfit;
}

}  // namespace

Filling filling(SampledFunction& f, const SampledBox& box, const std::array<SlopeRange, 3>& slopes,
                double negligible) {
  const auto [low, high] = std::minmax_element(box.f.begin(), box.f.end());
  if (*low < 0.0 && *high >= 0.0) {
    return Filling::mixed;
  }
  const double bend = slopes[0].bend + slopes[1].bend + slopes[2].bend;
  const Filling pure = *low < 0.0 ? Filling::full : Filling::empty;
  if (one_signed(*low, *high, bend)) {
    return pure;
  }
  // What pokes through is at most as deep as that, where f varies by `farthest` in all, and as wide
  // as a parabola of that depth that bends as f does.
  const double farthest = std::max(std::abs(*low), std::abs(*high));
  const double reach = possible_reach(f, box, bend, pure == Filling::full ? -1.0 : 1.0);
  const double depth = std::min(1.0, reach / farthest);
  const double width = std::min(1.0, std::sqrt(reach / bend));
  return box.share * depth * width <= negligible ? pure : Filling::doubtful;
}

namespace {

// Whether the surface may cut a face, and not only by a bulge so shallow that the volume beyond
// does not matter: the bulge is as wide as the root of its depth.
bool face_may_be_cut(const SampledBox& box, std::size_t face_axis, std::size_t face, double slope,
                     double negligible) {
  const auto [a, b] = others(face_axis);
  bool negative = false;
  bool positive = false;
  for (std::size_t i = 0; i < 9; ++i) {
    const double value =
        box.f[i % 3 * kSampleStep[a] + i / 3 * kSampleStep[b] + 2 * face * kSampleStep[face_axis]];
    (value < 0.0 ? negative : positive) = true;
  }
  if (negative && positive) {
    return true;
  }
  // Parabolas miss f by less than this share of its second differences where it is smooth.
  constexpr double kParabolaMisfit = 0.01;
  const double bend = face_slope_range(box, a, face_axis, face).bend +
                      face_slope_range(box, b, face_axis, face).bend;
  const double least = plane_minimum(box, face_axis, 2 * face, negative ? -1.0 : 1.0);
  const double depth = (kParabolaMisfit * bend - least) / slope;
  return depth > 0.0 && depth * std::sqrt(depth) * box.share > negligible;
}

// The gradient at the corners and the centre widens what the differences show.
void include_gradients(SampledFunction& f, const SampledBox& box,
                       std::array<SlopeRange, 3>& slopes) {
  std::array<Vec3, 9> points;
  std::array<Vec3, 9> gradients;
  for (std::size_t i = 0; i < 8; ++i) {
    points[i] = sample_point(box, i % 2 * 2 + i / 2 % 2 * 6 + i / 4 * 18);
  }
  points[8] = sample_point(box, 13);
  f.gradients(points, gradients);
  for (const Vec3& gradient : gradients) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double slope = gradient[a] * box.size[a];
      slopes[a].low = std::min(slopes[a].low, slope);
      slopes[a].high = std::max(slopes[a].high, slope);
    }
  }
}

// The axis along which f is monotone most clearly, if there is one.
bool choose_height(const std::array<SlopeRange, 3>& slopes, GraphAxes& axes) {
  double best = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [b, c] = others(a);
    const double steadiest = slopes[a].steadiest();
    const double rank = score(steadiest, std::max(slopes[b].largest(), slopes[c].largest()));
    if (steadiest >= kLeastSteadiness * slopes[a].largest() && rank >= kLeastDominance &&
        rank > best) {
      best = rank;
      axes.height = a;
      axes.rising = slopes[a].low > 0.0;
      axes.bend = std::max({slopes[0].bend, slopes[1].bend, slopes[2].bend}) / steadiest;
    }
  }
  return best > 0.0;
}

// How well the cuts of the faces across the height axis are heights along `across`; 0 if not at
// all.
double face_score(const SampledBox& box, const GraphAxes& axes, const std::array<bool, 2>& cut) {
  double worst = kHuge;
  for (std::size_t face = 0; face < 2; ++face) {
    if (!cut[face]) {
      continue;
    }
    const SlopeRange slopes = face_slope_range(box, axes.across, axes.height, face);
    const SlopeRange other = face_slope_range(box, axes.along, axes.height, face);
    const double rank = score(slopes.steadiest(), other.largest());
    if (slopes.steadiest() < kLeastFaceSteadiness * slopes.largest() ||
        rank < kLeastFaceDominance) {
      return 0.0;
    }
    worst = std::min(worst, rank);
  }
  return worst;
}

std::size_t worst_bend_except(const SampledBox& box, const std::array<SlopeRange, 3>& slopes,
                              std::size_t except) {
  std::size_t worst = except == 0 ? 1 : 0;
  for (std::size_t a = worst + 1; a < 3; ++a) {
    if (a == except) {
      continue;
    }
    const double more = slopes[a].bend - slopes[worst].bend;
    if (more > 0.0 || (more == 0.0 && box.size[a] > box.size[worst])) {
      worst = a;
    }
  }
  return worst;
}

}  // namespace

std::size_t worst_bend(const SampledBox& box, const std::array<SlopeRange, 3>& slopes) {
  constexpr std::size_t kNoAxis = 3;
  return worst_bend_except(box, slopes, kNoAxis);
}

BoxPlan plan_box(SampledFunction& f, const SampledBox& box, std::array<SlopeRange, 3> slopes,
                 double negligible) {
  if (f.has_gradient()) {
    include_gradients(f, box, slopes);
  }
  BoxPlan plan;
  plan.split_axis = worst_bend(box, slopes);
  if (!choose_height(slopes, plan.axes)) {
    return plan;
  }
  GraphAxes axes = plan.axes;
  const double slope = slopes[axes.height].largest();
  const std::array<bool, 2> cut{face_may_be_cut(box, axes.height, 0, slope, negligible),
                                face_may_be_cut(box, axes.height, 1, slope, negligible)};
  double best = 0.0;
  for (const std::size_t across : others(axes.height)) {
    axes.across = across;
    axes.along = 3 - across - axes.height;
    const double rank = face_score(box, axes, cut);
    if (rank > best) {
      best = rank;
      plan.axes = axes;
      plan.is_graph = true;
    }
  }
  if (!plan.is_graph) {
    plan.split_axis = worst_bend_except(box, slopes, plan.axes.height);
  }
  return plan;
}

double rough_fraction(const SampledBox& box, const std::array<SlopeRange, 3>& slopes) {
  const double across_half =
      0.5 * (slopes[0].largest() + slopes[1].largest() + slopes[2].largest());
  double sum = 0.0;
  for (std::size_t i = 0; i < 27; ++i) {
    const double weight =
        (i % 3 == 1 ? 2.0 : 1.0) * (i / 3 % 3 == 1 ? 2.0 : 1.0) * (i / 9 == 1 ? 2.0 : 1.0) / 64.0;
    const double inside = across_half > 0.0 ? std::clamp(0.5 - box.f[i] / across_half, 0.0, 1.0)
                                            : (box.f[i] < 0.0 ? 1.0 : 0.0);
    sum += weight * inside;
  }
  return sum;
}

}  // namespace difmesh::detail
