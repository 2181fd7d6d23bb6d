#pragma once
// Whether the triangles in a box are plainly one sheet of surface, so that the winding number takes
// two neighbouring values in the box and its integral tells the share of each.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "sampling/sheet_facts.hpp"

namespace difmesh::detail {

/// A mesh whose vertices are known by place and by name.
struct NamedMesh {
  std::span<const Vec3> corners;         ///< in grid units
  std::span<const std::uint64_t> names;  ///< of the corners; equal ones at equal positions
  std::span<const Triangle> triangles;
  const SheetFacts& facts;
};

/// Tests sets of triangles; keeps its memory from one to the next.
class SheetTest {
 public:
  explicit SheetTest(const NamedMesh& mesh) : mesh_(mesh) {}

  /// True only where the triangles that meet a convex box part it into two kinds of regions, whose
  /// winding numbers differ by 1. That is so for
  /// - a single triangle, and two along an edge;
  /// - triangles connected by edges whose normals lie in one half-space and that go round none of
  ///   their vertices more than once: a line along the half-space's direction meets them once;
  /// - triangles of a convex body, seen from outside or from inside.
  /// The answer does not depend on the order of the triangles.
  [[nodiscard]] bool is_sheet(std::span<const std::uint32_t> triangles);

 private:
  struct Edge {
    std::uint64_t low = 0;
    std::uint64_t high = 0;
    std::uint8_t forward = 0;   ///< 1 + place of the triangle that runs from low to high
    std::uint8_t backward = 0;  ///< and back
  };
  struct Turn {
    std::uint64_t name = 0;
    double angle = 0.0;
    bool used = false;
  };
  static constexpr std::size_t kMost = 240;
  static constexpr std::size_t kTable = 1024;

  [[nodiscard]] bool adjacent(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool connected(std::span<const std::uint32_t> triangles);
  /// All triangles have one corner, and it is ordinary.
  [[nodiscard]] bool round_ordinary_vertex(std::span<const std::uint32_t> triangles) const;
  /// As connected() and turns_once(), where all corners are ordinary, told apart by index.
  [[nodiscard]] bool connected_by_ordinary(std::span<const std::uint32_t> triangles);
  [[nodiscard]] std::uint8_t lead(std::uint8_t place) const;
  [[nodiscard]] bool insert_edge(std::uint64_t from, std::uint64_t to, std::uint8_t place);
  /// Sets direction_ as well.
  [[nodiscard]] bool in_half_space(std::span<const std::uint32_t> triangles);
  [[nodiscard]] bool turns_once(std::span<const std::uint32_t> triangles);
  void add_turn(std::uint64_t name, double angle);
  [[nodiscard]] bool convex(std::span<const std::uint32_t> triangles) const;
  /// Least and greatest height of the corners of b over the plane of a; 0 within rounding.
  [[nodiscard]] std::array<double, 2> heights(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Vec3 normal(std::uint32_t triangle) const;

  NamedMesh mesh_;
  struct Corner {
    std::uint32_t vertex = 0;
    std::uint32_t place = 0;  ///< 1 + place of the first triangle with it
  };

  Vec3 direction_{};
  std::vector<Corner> corners_;
  std::vector<Edge> table_;
  std::vector<Turn> turns_;
  std::array<std::uint16_t, 3 * kMost> used_{};
  std::size_t used_count_ = 0;
  std::array<std::uint8_t, kMost> leader_{};
};

}  // namespace difmesh::detail
