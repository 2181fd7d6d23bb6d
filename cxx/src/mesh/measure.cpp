#include "difmesh/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "difmesh/float_environment.hpp"
#include "mesh/closed_surface.hpp"
#include "mesh/mesh_arrays.hpp"

namespace difmesh {
namespace {

using detail::index_twice;

/// One side of a triangle, filed under the smaller of its two vertices.
struct EdgeUse {
  std::uint32_t high = 0;    ///< the larger vertex
  bool ascending = false;    ///< the triangle runs from the smaller vertex to the larger
  std::uint64_t corner = 0;  ///< 3 triangle + corner at which the side starts
};

/// Disjoint sets over 0..n-1. The smaller member is the root, so no result depends on the order of
/// joining; halving of paths keeps them short.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// Whether a and b were apart until now.
  bool join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::size_t root(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }
  std::vector<std::size_t> parent_;
};

/// Neumaier's compensated sum: a million terms of either sign lose no digit.
class Sum {
 public:
  void add(double term) {
    const double next = total_ + term;
    lost_ += std::abs(total_) >= std::abs(term) ? (total_ - next) + term : (term - next) + total_;
    total_ = next;
  }
  /// Terms that overflow give infinity, whose lost part would be NaN.
  [[nodiscard]] double value() const { return std::isfinite(lost_) ? total_ + lost_ : total_; }

 private:
  double total_ = 0.0;
  double lost_ = 0.0;
};

std::size_t next_corner(std::size_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

void measure_box(std::span<const Vec3> positions, Measure& m) {
  if (positions.empty()) {
    return;
  }
  m.low = m.high = positions[0];
  for (const Vec3& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m.low[axis] = std::min(m.low[axis], p[axis]);
      m.high[axis] = std::max(m.high[axis], p[axis]);
    }
  }
}

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Area, volume and triangles without area. The pyramids stand on the centre of the box: with a far
/// origin the volume would be a small difference of large numbers.
void measure_extent(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                    Measure& m) {
  const Vec3 centre{0.5 * m.low[0] + 0.5 * m.high[0], 0.5 * m.low[1] + 0.5 * m.high[1],
                    0.5 * m.low[2] + 0.5 * m.high[2]};
  Sum twice_area;
  Sum six_volumes;
  for (const Triangle& t : triangles) {
    if (index_twice(t)) {
      ++m.degenerate_triangles;
      continue;
    }
    const Vec3& base = positions[t[0]];
    const Vec3 normal = cross(minus(positions[t[1]], base), minus(positions[t[2]], base));
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (length == 0.0) {
      ++m.degenerate_triangles;
      continue;
    }
    const Vec3 arm = minus(base, centre);
    twice_area.add(length);
    six_volumes.add(arm[0] * normal[0] + arm[1] * normal[1] + arm[2] * normal[2]);
  }
  m.area = 0.5 * twice_area.value();
  m.volume = six_volumes.value() / 6.0;
}

/// All sides of all triangles, in buckets by their smaller vertex, each bucket sorted by the larger
/// one: two passes over the triangles and sorts of some three entries each.
struct EdgeTable {
  std::vector<std::size_t> first;  ///< bucket of vertex v: uses[first[v] .. first[v + 1])
  std::vector<EdgeUse> uses;
};

EdgeTable collect_edges(std::size_t vertices, std::span<const Triangle> triangles) {
  EdgeTable table;
  table.first.assign(vertices + 2, 0);
  for (const Triangle& t : triangles) {
    if (!index_twice(t)) {
      for (std::size_t c = 0; c < 3; ++c) {
        ++table.first[std::size_t{std::min(t[c], t[next_corner(c)])} + 2];
      }
    }
  }
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  table.uses.resize(table.first.back());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if (!index_twice(t)) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t from = t[c];
        const std::uint32_t to = t[next_corner(c)];
        table.uses[table.first[std::size_t{std::min(from, to)} + 1]++] = {std::max(from, to),
                                                                          from < to, 3 * i + c};
      }
    }
  }
  table.first.pop_back();
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(table.uses.begin() + static_cast<std::ptrdiff_t>(table.first[v]),
              table.uses.begin() + static_cast<std::ptrdiff_t>(table.first[v + 1]),
              [](const EdgeUse& a, const EdgeUse& b) { return a.high < b.high; });
  }
  return table;
}

/// Walks over the edges: counts them by their number of triangles, joins triangles over them into
/// components, and joins the corners on either side of an edge into fans about its two vertices.
class Topology {
 public:
  Topology(std::size_t vertices, std::span<const Triangle> triangles)
      : triangles_(triangles),
        components_(triangles.size()),
        corners_(3 * triangles.size()),
        fans_(vertices, 0),
        on_bad_edge_(vertices, false) {}

  void measure(Measure& m) {
    count_corners(m);
    const EdgeTable table = collect_edges(fans_.size(), triangles_);
    for (std::size_t v = 0; v + 1 < table.first.size(); ++v) {
      for (std::size_t i = table.first[v]; i < table.first[v + 1];) {
        std::size_t end = i + 1;
        while (end < table.first[v + 1] && table.uses[end].high == table.uses[i].high) {
          ++end;
        }
        visit(v, std::span(table.uses).subspan(i, end - i), m);
        i = end;
      }
    }
    finish(m);
  }

 private:
  /// Every corner starts as a fan of its own, every triangle as a component.
  void count_corners(Measure& m) {
    for (const Triangle& t : triangles_) {
      if (!index_twice(t)) {
        ++faces_;
        for (const std::uint32_t v : t) {
          ++fans_[v];
        }
      }
    }
    m.components = faces_;
  }

  void visit(std::size_t low, std::span<const EdgeUse> uses, Measure& m) {
    ++m.edges;
    for (const EdgeUse& use : uses.subspan(1)) {
      m.components -= components_.join(uses[0].corner / 3, use.corner / 3) ? 1 : 0;
    }
    if (uses.size() == 1) {
      ++m.boundary_edges;
    } else if (uses.size() == 2) {
      m.misoriented_edges += uses[0].ascending == uses[1].ascending ? 1 : 0;
      join_corners(low, uses[0], uses[1], true);
      join_corners(uses[0].high, uses[0], uses[1], false);
    } else {
      ++m.non_manifold_edges;
      count_ways(uses, m);
      on_bad_edge_[low] = on_bad_edge_[uses[0].high] = true;
    }
  }

  void count_ways(std::span<const EdgeUse> uses, Measure& m) {
    const auto up = static_cast<std::size_t>(
        std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.ascending; }));
    m.unbalanced_edges += 2 * up == uses.size() ? 0 : 1;
    odd_edges_ += static_cast<std::int64_t>(uses.size() % 2);
  }

  void join_corners(std::size_t vertex, const EdgeUse& a, const EdgeUse& b, bool at_low) {
    const auto corner_at = [at_low](const EdgeUse& use) {
      return use.ascending == at_low ? use.corner : next_corner(use.corner);
    };
    fans_[vertex] -= corners_.join(corner_at(a), corner_at(b)) ? 1 : 0;
  }

  void finish(Measure& m) const {
    for (std::size_t v = 0; v < fans_.size(); ++v) {
      m.isolated_vertices += fans_[v] == 0 ? 1 : 0;
      m.non_manifold_vertices += fans_[v] > 1 || on_bad_edge_[v] ? 1 : 0;
    }
    m.closed = m.boundary_edges == 0 && odd_edges_ == 0;
    m.manifold =
        m.non_manifold_edges == 0 && m.non_manifold_vertices == 0 && m.misoriented_edges == 0;
    m.euler_number = m.vertices - m.isolated_vertices - m.edges + faces_;
  }

  std::span<const Triangle> triangles_;
  DisjointSets components_;
  DisjointSets corners_;
  std::vector<std::int64_t> fans_;  ///< per vertex: its corners less the joins among them
  std::vector<bool> on_bad_edge_;
  std::int64_t faces_ = 0;
  std::int64_t odd_edges_ = 0;  ///< with 3, 5, ... triangles
};

/// Edges in balance by index are so by position; others may be where vertices are split.
bool is_balanced(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                 const Measure& m) {
  if (m.boundary_edges + m.misoriented_edges + m.unbalanced_edges == 0) {
    return true;
  }
  std::vector<std::uint64_t> keys(positions.size());
  std::transform(positions.begin(), positions.end(), keys.begin(), detail::position_key);
  return detail::edge_balance(keys, triangles) == 0;
}

}  // namespace

Measure measure(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  const DefaultFloatEnvironment environment;
  detail::check_mesh_arrays("measure", positions, triangles);
  Measure m;
  m.vertices = static_cast<std::int64_t>(positions.size());
  m.triangles = static_cast<std::int64_t>(triangles.size());
  measure_box(positions, m);
  measure_extent(positions, triangles, m);
  Topology(positions.size(), triangles).measure(m);
  m.has_volume = is_balanced(positions, triangles, m);
  return m;
}

}  // namespace difmesh
