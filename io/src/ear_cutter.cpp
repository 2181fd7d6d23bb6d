#include "ear_cutter.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace difmesh::detail {
namespace {

constexpr std::uint32_t kCut = std::numeric_limits<std::uint32_t>::max();

/// Parts of the tree seen per corner; combs and spirals take 50, stars of needles 300.
constexpr std::uint64_t kMostVisits = 1000;

/// Of a triangle's longest edge squared: twice the area of a thin one.
constexpr double kThin = 1e-12;

double squared_distance(const Point2& a, const Point2& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

}  // namespace

EarCutter::Result EarCutter::cut(std::span<const Point2> points) {
  points_ = points;
  start();
  const std::size_t wanted = points.size() - 2;
  Result result = Result::done;
  std::uint32_t any = 0;
  while (triangles_.size() < wanted && !takes_too_long()) {
    if (cut_one_round() || cut_one_of(thin_, Shape::thin_ear) || cut_one_of(flat_, Shape::flat)) {
      continue;
    }
    while (round_of_[any] == kCut) {
      ++any;
    }
    cut_off(any);
    result = Result::crossed;
  }
  return triangles_.size() < wanted ? Result::too_long : result;
}

void EarCutter::start() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  previous_.resize(count);
  next_.resize(count);
  for (std::uint32_t c = 0; c < count; ++c) {
    previous_[c] = c == 0 ? count - 1 : c - 1;
    next_[c] = c + 1 == count ? 0 : c + 1;
  }
  round_ = 0;
  round_of_.assign(count, 1);
  later_.clear();
  thin_.clear();
  flat_.clear();
  triangles_.clear();
  std::vector<std::uint32_t> in_the_way;
  for (std::uint32_t c = 0; c < count; ++c) {
    later_.push_back(c);
    if (is_in_the_way(c)) {
      in_the_way.push_back(c);
    }
  }
  in_the_way_.build(points_, std::move(in_the_way));
}

bool EarCutter::is_in_the_way(std::uint32_t corner) const {
  return turn(points_[previous_[corner]], points_[corner], points_[next_[corner]]) <= 0.0;
}

bool EarCutter::takes_too_long() const {
  return in_the_way_.visits() > kMostVisits * points_.size();
}

EarCutter::Shape EarCutter::shape_of(std::uint32_t corner) {
  const Point2& a = points_[previous_[corner]];
  const Point2& b = points_[corner];
  const Point2& c = points_[next_[corner]];
  if (a == b || b == c || a == c) {
    return Shape::ear;  // without area, and nothing changes where it was
  }
  const double area = turn(a, b, c);
  if (area == 0.0) {
    return Shape::flat;
  }
  if (area < 0.0 || in_the_way_.any_in({a, b, c})) {
    return Shape::none;
  }
  const double longest =
      std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
  return area > kThin * longest ? Shape::ear : Shape::thin_ear;
}

bool EarCutter::cut_one_round() {
  ++round_;
  std::swap(now_, later_);
  later_.clear();
  const std::size_t wanted = points_.size() - 2;
  const std::size_t before = triangles_.size();
  for (std::size_t n = 0; n < now_.size() && triangles_.size() < wanted && !takes_too_long(); ++n) {
    const std::uint32_t corner = now_[n];
    if (round_of_[corner] != round_) {
      continue;  // cut off, or a neighbour was in this round
    }
    const Shape shape = shape_of(corner);
    if (shape == Shape::ear) {
      cut_off(corner);
    } else if (shape != Shape::none) {
      (shape == Shape::flat ? flat_ : thin_).push_back(corner);
    }
  }
  return triangles_.size() > before;
}

bool EarCutter::cut_one_of(std::vector<std::uint32_t>& corners, Shape shape) {
  while (!corners.empty()) {
    const std::uint32_t corner = corners.back();
    corners.pop_back();
    if (round_of_[corner] != kCut && shape_of(corner) == shape) {
      cut_off(corner);
      return true;
    }
  }
  return false;
}

void EarCutter::cut_off(std::uint32_t corner) {
  const std::uint32_t before = previous_[corner];
  const std::uint32_t after = next_[corner];
  triangles_.push_back({before, corner, after});
  round_of_[corner] = kCut;
  in_the_way_.remove(corner);
  next_[before] = after;
  previous_[after] = before;
  ask_again(before);
  ask_again(after);
}

void EarCutter::ask_again(std::uint32_t corner) {
  if (!is_in_the_way(corner)) {
    in_the_way_.remove(corner);
  }
  if (round_of_[corner] != round_ + 1) {
    round_of_[corner] = round_ + 1;
    later_.push_back(corner);
  }
}

}  // namespace difmesh::detail
