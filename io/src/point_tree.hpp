#pragma once
/// \file point_tree.hpp
/// Points in the plane, and whether a triangle holds any.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace difmesh::detail {

using Point2 = std::array<double, 2>;

/// Twice the signed area of the triangle a, b, c, with the right sign; > 0 if counter-clockwise.
/// Exact in sign unless products of coordinates underflow. Source: Shewchuk, Discrete &
/// Computational Geometry 18 (1997), with the expansions in full where the filter does not tell.
[[nodiscard]] double turn(const Point2& a, const Point2& b, const Point2& c);

/// A balanced tree over points, which may leave it one by one.
class PointTree {
 public:
  /// Over the points of these numbers. Cost: O(n log n)
  void build(std::span<const Point2> points, std::vector<std::uint32_t> numbers);
  void remove(std::uint32_t number);
  /// Whether a point is in the counter-clockwise triangle or on its border. Points at the place of
  /// a corner do not count. Cost: O(log n), and each part of the tree that the border crosses.
  [[nodiscard]] bool any_in(const std::array<Point2, 3>& triangle);
  /// Parts of the tree seen by any_in() since build().
  [[nodiscard]] std::uint64_t visits() const { return visits_; }

 private:
  static constexpr std::size_t kLeaf = 8;
  struct Node {
    Point2 low;
    Point2 high;
    std::uint32_t points;  ///< that are left
  };
  void build(std::size_t node, std::size_t first, std::size_t last);
  [[nodiscard]] bool any_in(const std::array<Point2, 3>& triangle, std::size_t node,
                            std::size_t first, std::size_t last);

  std::span<const Point2> points_;
  std::vector<std::uint32_t> numbers_;  ///< sorted by place; kGone where one left
  std::vector<std::uint32_t> slots_;    ///< where a point is in numbers_
  std::vector<Node> nodes_;             ///< the halves of node n are 2n + 1 and 2n + 2
  std::uint64_t visits_ = 0;
};

}  // namespace difmesh::detail
