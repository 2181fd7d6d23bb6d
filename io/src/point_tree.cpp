#include "point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace difmesh::detail {
namespace {

constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();

/// The rounding of the plain formula, of the sum of its two products (Shewchuk's ccwerrboundA).
constexpr double kTurnError = (3.0 + 16.0 * 0x1p-53) * 0x1p-53;

/// Adds a number to a sum of numbers that do not overlap, smallest first, without rounding.
void add_exactly(std::array<double, 12>& sum, std::size_t& count, double number) {
  for (std::size_t i = 0; i < count; ++i) {
    const double total = number + sum[i];
    const double part = total - number;
    sum[i] = (number - (total - part)) + (sum[i] - part);
    number = total;
  }
  sum[count++] = number;
}

double exact_turn(const Point2& a, const Point2& b, const Point2& c) {
  std::array<double, 12> sum{};
  std::size_t count = 0;
  const auto add_product = [&](double x, double y) {
    const double product = x * y;
    add_exactly(sum, count, std::fma(x, y, -product));
    add_exactly(sum, count, product);
  };
  add_product(a[0], b[1]);
  add_product(-a[1], b[0]);
  add_product(b[0], c[1]);
  add_product(-b[1], c[0]);
  add_product(c[0], a[1]);
  add_product(-c[1], a[0]);
  // The largest that is not 0 outweighs all others together.
  for (std::size_t i = count; i-- > 0;) {
    if (sum[i] != 0.0) {
      return sum[i];
    }
  }
  return 0.0;
}

struct Estimate {
  double value;
  double error;
};

Estimate rough_turn(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  return {left - right, kTurnError * (std::abs(left) + std::abs(right))};
}

}  // namespace

double turn(const Point2& a, const Point2& b, const Point2& c) {
  const Estimate estimate = rough_turn(a, b, c);
  return std::abs(estimate.value) > estimate.error ? estimate.value : exact_turn(a, b, c);
}

void PointTree::build(std::span<const Point2> points, std::vector<std::uint32_t> numbers) {
  points_ = points;
  numbers_ = std::move(numbers);
  visits_ = 0;
  nodes_.clear();
  slots_.assign(points.size(), kGone);
  if (!numbers_.empty()) {
    build(0, 0, numbers_.size());
  }
  for (std::uint32_t slot = 0; slot < numbers_.size(); ++slot) {
    slots_[numbers_[slot]] = slot;
  }
}

void PointTree::build(std::size_t node, std::size_t first, std::size_t last) {
  const std::span<std::uint32_t> numbers(numbers_.data() + first, last - first);
  Node box{points_[numbers[0]], points_[numbers[0]], static_cast<std::uint32_t>(numbers.size())};
  for (const std::uint32_t number : numbers) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], points_[number][axis]);
      box.high[axis] = std::max(box.high[axis], points_[number][axis]);
    }
  }
  nodes_.resize(std::max(nodes_.size(), node + 1));
  nodes_[node] = box;
  if (numbers.size() <= kLeaf) {
    return;
  }
  const std::size_t axis = box.high[0] - box.low[0] < box.high[1] - box.low[1] ? 1 : 0;
  const std::size_t half = numbers.size() / 2;
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half),
                   numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
                   });
  build(2 * node + 1, first, first + half);
  build(2 * node + 2, first + half, last);
}

void PointTree::remove(std::uint32_t number) {
  const std::uint32_t slot = slots_[number];
  if (slot == kGone) {
    return;
  }
  slots_[number] = kGone;
  numbers_[slot] = kGone;
  std::size_t node = 0;
  std::size_t first = 0;
  std::size_t last = numbers_.size();
  --nodes_[0].points;
  while (last - first > kLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    const bool is_low = slot < middle;
    node = 2 * node + (is_low ? 1 : 2);
    (is_low ? last : first) = middle;
    --nodes_[node].points;
  }
}

bool PointTree::any_in(const std::array<Point2, 3>& triangle) {
  return !numbers_.empty() && any_in(triangle, 0, 0, numbers_.size());
}

bool PointTree::any_in(const std::array<Point2, 3>& triangle, std::size_t node, std::size_t first,
                       std::size_t last) {
  ++visits_;
  const Node& box = nodes_[node];
  const bool is_corner = box.low == box.high && (box.low == triangle[0] || box.low == triangle[1] ||
                                                 box.low == triangle[2]);
  if (box.points == 0 || is_corner) {
    return false;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
    if (box.high[axis] < low || box.low[axis] > high) {
      return false;
    }
  }
  for (std::size_t e = 0; e < 3; ++e) {
    // The corner of the box that lies farthest to the left of the edge.
    const Point2& a = triangle[e];
    const Point2& b = triangle[(e + 1) % 3];
    const Point2 corner{b[1] > a[1] ? box.low[0] : box.high[0],
                        b[0] > a[0] ? box.high[1] : box.low[1]};
    const Estimate estimate = rough_turn(a, b, corner);
    if (estimate.value < -estimate.error) {
      return false;
    }
  }
  if (last - first > kLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    return any_in(triangle, 2 * node + 1, first, middle) ||
           any_in(triangle, 2 * node + 2, middle, last);
  }
  return std::any_of(
      numbers_.begin() + static_cast<std::ptrdiff_t>(first),
      numbers_.begin() + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t number) {
        if (number == kGone) {
          return false;
        }
        const Point2& p = points_[number];
        return p != triangle[0] && p != triangle[1] && p != triangle[2] &&
               turn(triangle[0], triangle[1], p) >= 0.0 &&
               turn(triangle[1], triangle[2], p) >= 0.0 && turn(triangle[2], triangle[0], p) >= 0.0;
      });
}

}  // namespace difmesh::detail
