#include "sampling/graph_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace difmesh::detail {
namespace {

// Guesses from the parabolic model that miss their roots by more than this share of the box mean
// that f is not smooth on the scale of the box.
constexpr double kSmoothMisfit = 3e-4;
constexpr double kSmoothMisfitPerBend = 0.08;
constexpr int kCarefulNodes = 6;
constexpr int kMoreNodes = 3;
constexpr int kMaxLevel = 40;
// Refinements after which what does not look smooth is taken to have a kink: a strong curvature
// gets smoother with each.
constexpr int kSureLevel = 2;
// Above this rate from one Legendre coefficient to the next there is a kink, or what looks like
// one.
constexpr double kSmoothRate = 0.4;
// Polynomials may miss smooth values at the ends by this many times their estimated tail.
constexpr double kExpectedMiss = 10.0;
// Error of a rule with n nodes for a function whose singularity lies on the ellipse of Bernstein
// with semi-axes that add up to r: about this times r^(-2n).
constexpr double kGaussConstant = 10.0;
// Each panel and line may use up this share of the tolerance.
constexpr double kShareOfTolerance = 0.3;

double clamp_guess(double t, double low, double high) {
  return t >= low && t <= high ? t : (t < low ? low : (t > high ? high : 0.5 * (low + high)));
}

}  // namespace

GraphQuadrature::Result GraphQuadrature::integrate(SampledFunction& f, const SampledBox& box,
                                                   const GraphAxes& axes, const Limits& limits) {
  box_ = &box;
  model_ = BoxModel(box, axes);
  axes_ = axes;
  set_tolerances(limits);
  last_call_ = f.calls() + limits.calls;
  rounding_ = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double coordinate = std::max(std::abs(box.low[a]), std::abs(box.low[a] + box.size[a]));
    rounding_ = std::max(
        rounding_, 4.0 * std::numeric_limits<double>::epsilon() * (1.0 + coordinate / box.size[a]));
  }
  smooth_misfit_ = std::max(kSmoothMisfit, kSmoothMisfitPerBend * axes.bend);
  line_reach_ = model_.surface_reach(1);
  panel_reach_ = model_.surface_reach(0);
  careful_ = false;
  if (!run(f)) {
    careful_ = true;
    (void)run(f);
  }
  return {axes.rising ? volume_ : 1.0 - volume_, error_, exhausted_, roots_.misfit()};
}

// False if the function turns out to need more care.
bool GraphQuadrature::run(SampledFunction& f) {
  volume_ = 0.0;
  error_ = 0.0;
  exhausted_ = false;
  roots_.reset_misfit();
  find_panels(f);
  while (!panels_.empty()) {
    refine_ = f.calls() < last_call_;
    columns_.clear();
    lines_.clear();
    next_panels_.clear();
    for (Panel& panel : panels_) {
      add_columns(panel);
    }
    find_cuts(f);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      add_lines(i);
    }
    while (!lines_.empty()) {
      integrate_lines(f);
      if (!careful_ && roots_.misfit() > smooth_misfit_) {
        return false;
      }
    }
    for (const Panel& panel : panels_) {
      finish_panel(panel);
    }
    panels_.swap(next_panels_);
  }
  return true;
}

LineFrame GraphQuadrature::frame(std::size_t axis) const {
  return {axis, box_->low[axis], box_->size[axis]};
}

// Where the surface crosses the four edges along the first axis, the area of a slice has a kink.
void GraphQuadrature::find_panels(SampledFunction& f) {
  std::vector<double>& cuts = values_;
  cuts.assign({0.0, 1.0});
  EdgeSides below{};
  std::array<std::size_t, 5> first{};
  roots_.clear();
  for (std::size_t edge = 0; edge < 4; ++edge) {
    first[edge] = roots_.size();
    below[edge] = add_edge(f, edge);
  }
  first[4] = roots_.size();
  const double coarse = careful_ ? 0.05 * tolerance_ : 0.1 * std::cbrt(tolerance_);
  roots_.solve(f, frame(axes_.along), std::max(coarse, rounding_));
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    cuts.push_back(roots_.root(i));
  }
  std::sort(cuts.begin(), cuts.end());
  panels_.clear();
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    Panel panel{{.low = cuts[i], .high = cuts[i + 1]}, below};
    if (panel.high - panel.low <= rounding_) {
      continue;
    }
    const double middle = 0.5 * (panel.low + panel.high);
    for (std::size_t edge = 0; edge < 4; ++edge) {
      for (std::size_t r = first[edge]; r < first[edge + 1]; ++r) {
        panel.below[edge] = panel.below[edge] != (roots_.root(r) < middle);
      }
    }
    panels_.push_back(panel);
  }
}

// Adds the crossings of one edge to the batch; returns on which side of the surface the edge
// starts.
bool GraphQuadrature::add_edge(SampledFunction& f, std::size_t edge) {
  const auto across = static_cast<double>(edge % 2);
  const std::size_t start =
      edge % 2 * 2 * kSampleStep[axes_.across] + edge / 2 * 2 * kSampleStep[axes_.height];
  const std::size_t step = kSampleStep[axes_.along];
  const std::array<double, 3> v{box_->f[start], box_->f[start + step], box_->f[start + 2 * step]};
  const double bend = v[0] - 2.0 * v[1] + v[2];
  const double slope = 2.0 * (v[1] - v[0]) - bend;
  AxisRoots::Start line{.point = point(0.0, across)};
  line.point[axes_.height] += static_cast<double>(edge / 2) * box_->size[axes_.height];
  const auto add_between = [&](double low, double high, bool negative_low) {
    const ParabolaRoot root = parabola_root(v[0], slope, 2.0 * bend, negative_low);
    line.low = low;
    line.high = high;
    line.negative_low = negative_low;
    line.guess = clamp_guess(root.t, low, high);
    line.slope = root.slope;
    roots_.add(line);
  };
  const std::array<bool, 3> negative{v[0] < 0.0, v[1] < 0.0, v[2] < 0.0};
  if (negative[0] != negative[1]) {
    add_between(0.0, 0.5, negative[0]);
  }
  if (negative[1] != negative[2]) {
    add_between(0.5, 1.0, negative[1]);
  }
  const double nearest = std::min({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  const double turn = -slope / (4.0 * bend);
  if (negative[0] == negative[1] && negative[1] == negative[2] && turn > 0.0 && turn < 1.0 &&
      nearest < 0.25 * std::abs(bend)) {
    line.point[axes_.along] = box_->low[axes_.along] + turn * box_->size[axes_.along];
    double at_turn = 0.0;
    f.values({&line.point, 1}, {&at_turn, 1});
    if ((at_turn < 0.0) != negative[0]) {
      add_between(0.0, turn, negative[0]);
      add_between(turn, 1.0, !negative[0]);
    }
  }
  return negative[0] == axes_.rising;
}

Vec3 GraphQuadrature::point(double along, double across) const {
  Vec3 p = box_->low;
  p[axes_.along] += along * box_->size[axes_.along];
  p[axes_.across] += across * box_->size[axes_.across];
  return p;
}

// With reach / half the length = d, the ellipse of Bernstein that touches the singularity has
// semi-axes that add up to r = d + sqrt(d^2 - 1); so d = (r + 1/r) / 2 for the r that n nodes need.
void GraphQuadrature::set_tolerances(const Limits& limits) {
  kink_tolerance_ = limits.kink_tolerance;
  if (limits.tolerance == tolerance_) {
    return;
  }
  tolerance_ = limits.tolerance;
  const double reduction = kGaussConstant / (kShareOfTolerance * tolerance_);
  for (int nodes = kMinGaussNodes; nodes < kMaxGaussNodes; ++nodes) {
    const double r = std::pow(reduction, 0.5 / nodes);
    least_reach_[static_cast<std::size_t>(nodes)] = 0.5 * (r + 1.0 / r);
  }
}

int GraphQuadrature::nodes_for(double length, double reach) const {
  if (careful_) {
    return kCarefulNodes;
  }
  const double ratio = 2.0 * reach / length;
  int nodes = kMinGaussNodes;
  while (nodes < kMaxGaussNodes && ratio < least_reach_[static_cast<std::size_t>(nodes)]) {
    ++nodes;
  }
  return nodes;
}

// Values at the nodes, then in careful mode at both ends.
std::size_t GraphQuadrature::rows(int nodes) const {
  return static_cast<std::size_t>(nodes) + (careful_ ? 2 : 0);
}

double GraphQuadrature::position(const GaussRule& rule, std::size_t row) {
  const auto n = static_cast<std::size_t>(rule.count);
  return row < n ? rule.node[row] : (row == n ? rule.margin : 1.0 - rule.margin);
}

void GraphQuadrature::add_columns(Panel& panel) {
  panel.first_column = columns_.size();
  const bool uniform = std::all_of(panel.below.begin(), panel.below.end(),
                                   [&](bool side) { return side == panel.below[0]; });
  if (uniform && !careful_) {
    panel.nodes = 0;
    volume_ += panel.below[0] ? panel.high - panel.low : 0.0;
    return;
  }
  if (panel.nodes == 0) {
    double reach = panel_reach_;
    for (std::size_t face = 0; face < 2; ++face) {
      if (panel.below[2 * face] != panel.below[2 * face + 1]) {
        reach = std::min(reach, model_.cut_reach(face));
      }
    }
    panel.nodes = nodes_for(panel.high - panel.low, reach);
  }
  const GaussRule& rule = gauss_rule(panel.nodes);
  for (std::size_t row = 0; row < rows(panel.nodes); ++row) {
    const double along = panel.low + position(rule, row) * (panel.high - panel.low);
    columns_.push_back({.along = along, .below = panel.below, .model = model_.slice(along)});
  }
}

// Where the surface cuts the faces at both ends of the height axis, the height has a kink.
void GraphQuadrature::find_cuts(SampledFunction& f) {
  roots_.clear();
  for (Column& column : columns_) {
    column.first_cut = roots_.size();
    const auto& m = column.model;
    for (std::size_t face = 0; face < 2; ++face) {
      if (column.below[2 * face] == column.below[2 * face + 1]) {
        continue;
      }
      AxisRoots::Start line{.point = point(column.along, 0.0)};
      line.point[axes_.height] += static_cast<double>(face) * box_->size[axes_.height];
      line.negative_low = column.below[2 * face] == axes_.rising;
      const ParabolaRoot root = face == 0 ? parabola_root(m[0], m[1], m[2], line.negative_low)
                                          : parabola_root(m[0] + m[3] + m[6], m[1] + m[4] + m[7],
                                                          m[2] + m[5] + m[8], line.negative_low);
      line.guess = clamp_guess(root.t, 0.0, 1.0);
      line.slope = root.slope;
      roots_.add(line);
    }
  }
  const double coarse = careful_ ? 0.05 * tolerance_ : 0.1 * std::sqrt(tolerance_);
  roots_.solve(f, frame(axes_.across), std::max(coarse, rounding_));
}

void GraphQuadrature::add_lines(std::size_t index) {
  Column& column = columns_[index];
  std::array<double, 4> cuts{0.0, 0.0, 0.0, 1.0};
  std::array<double, 2> cut_at{2.0, 2.0};
  std::size_t next_root = column.first_cut;
  for (std::size_t face = 0; face < 2; ++face) {
    if (column.below[2 * face] != column.below[2 * face + 1]) {
      cut_at[face] = roots_.root(next_root++);
      cuts[1 + face] = cut_at[face];
    }
  }
  if (cuts[1] > cuts[2]) {
    std::swap(cuts[1], cuts[2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = cuts[i + 1] - cuts[i];
    if (length <= 0.0) {
      continue;
    }
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    const bool low_below = column.below[middle < cut_at[0] ? 0 : 1];
    const bool high_below = column.below[middle < cut_at[1] ? 2 : 3];
    if (careful_ || (low_below && !high_below)) {
      lines_.push_back(
          {{.low = cuts[i], .high = cuts[i + 1], .nodes = nodes_for(length, line_reach_)}, index});
    } else if (high_below) {
      column.area += length;
    }
  }
}

void GraphQuadrature::integrate_lines(SampledFunction& f) {
  roots_.clear();
  for (const Line& line : lines_) {
    add_heights(line);
  }
  roots_.solve(f, frame(axes_.height), std::max(0.05 * tolerance_, rounding_));
  refine_ = f.calls() < last_call_;
  next_lines_.clear();
  std::size_t first = 0;
  for (const Line& line : lines_) {
    values_.resize(rows(line.nodes));
    for (double& value : values_) {
      value = roots_.root(first++);
    }
    columns_[line.column].area += settle(line, next_lines_);
  }
  lines_.swap(next_lines_);
}

void GraphQuadrature::add_heights(const Line& line) {
  const Column& column = columns_[line.column];
  const auto& m = column.model;
  const GaussRule& rule = gauss_rule(line.nodes);
  AxisRoots::Start start{.negative_low = axes_.rising};
  for (std::size_t row = 0; row < rows(line.nodes); ++row) {
    const double y = line.low + position(rule, row) * (line.high - line.low);
    const ParabolaRoot root =
        parabola_root(m[0] + y * (m[1] + y * m[2]), m[3] + y * (m[4] + y * m[5]),
                      m[6] + y * (m[7] + y * m[8]), axes_.rising);
    start.point = point(column.along, y);
    start.guess = clamp_guess(root.t, 0.0, 1.0);
    start.slope = root.slope;
    roots_.add(start);
  }
}

namespace {

double weighted_sum(const GaussRule& rule, std::span<const double> values) {
  double sum = 0.0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
    sum += rule.weight[j] * values[j];
  }
  return sum;
}

// How far the polynomial through the nodes misses the values at the ends, if these are there.
std::array<double, 2> misses_at_ends(const GaussRule& rule, std::span<const double> values) {
  const auto n = static_cast<std::size_t>(rule.count);
  if (values.size() == n) {
    return {0.0, 0.0};
  }
  double low = -values[n];
  double high = -values[n + 1];
  for (std::size_t j = 0; j < n; ++j) {
    low += rule.at_low[j] * values[j];
    high += rule.at_high[j] * values[j];
  }
  return {std::abs(low), std::abs(high)};
}

}  // namespace

// What is to be said of values_ on an interval.
GraphQuadrature::Verdict GraphQuadrature::judge(const Interval& interval) const {
  const GaussRule& rule = gauss_rule(interval.nodes);
  const auto n = static_cast<std::size_t>(rule.count);
  const std::span<const double> values(values_);
  const double length = interval.high - interval.low;
  const double tolerance = kShareOfTolerance * tolerance_;
  const Outlook smooth = outlook(rule, values.first(n), length);
  const double end_tolerance = careful_ ? kShareOfTolerance * kink_tolerance_ : tolerance;
  const double kink_tolerance = interval.level >= kSureLevel ? end_tolerance : tolerance;
  const double error = smooth.error * length;
  // A kink between an end and the node next to it cannot be seen from the nodes. It makes an error
  // of half the miss times its distance from the end.
  const auto [low, high] = misses_at_ends(rule, values);
  const double unexpected = std::max(low, high) - kExpectedMiss * smooth.tail;
  const double hidden = 0.5 * rule.node[0] * unexpected * length;
  if (hidden > end_tolerance && hidden > error) {
    // More nodes tell a kink from coefficients that happen to be small.
    const int nodes = smooth.rate < kSmoothRate ? rule.count + kMoreNodes : kMaxGaussNodes + 1;
    return {false, hidden, nodes, low > high ? rule.node[0] : rule.node[n - 1]};
  }
  if (smooth.rate > kSmoothRate) {
    const bool good = error <= kink_tolerance;
    return {good, error, kMaxGaussNodes + 1, good ? 0.5 : kink_position(rule, values.first(n))};
  }
  int nodes = rule.count;
  for (double left = error; left > 0.5 * tolerance && nodes <= kMaxGaussNodes; ++nodes) {
    left *= smooth.rate * smooth.rate;
  }
  return {error <= tolerance, error, nodes, 0.5};
}

// The integral of values_ over an interval if that is good enough; otherwise 0, and what to do
// instead.
template <class T>
double GraphQuadrature::settle(const T& interval, std::vector<T>& next) {
  const Verdict verdict = judge(interval);
  const double length = interval.high - interval.low;
  if (verdict.good || !refine_ || interval.level == kMaxLevel) {
    exhausted_ = exhausted_ || !verdict.good;
    error_ = std::max(error_, verdict.error);
    return length * weighted_sum(gauss_rule(interval.nodes), values_);
  }
  T part = interval;
  ++part.level;
  if (verdict.nodes <= kMaxGaussNodes) {
    part.nodes = verdict.nodes;
    next.push_back(part);
    return 0.0;
  }
  if (careful_) {
    part.nodes = kCarefulNodes;
  }
  part.high = interval.low + verdict.cut_at * length;
  next.push_back(part);
  part.low = part.high;
  part.high = interval.high;
  next.push_back(part);
  return 0.0;
}

void GraphQuadrature::finish_panel(const Panel& panel) {
  if (panel.nodes == 0) {
    return;
  }
  values_.resize(rows(panel.nodes));
  for (std::size_t row = 0; row < values_.size(); ++row) {
    values_[row] = columns_[panel.first_column + row].area;
  }
  volume_ += settle(panel, next_panels_);
}

}  // namespace difmesh::detail
