#include "reference_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "mesh/closed_surface.hpp"

namespace difmesh::detail {
namespace {

// Points this close together are taken for one, as a share of a triangle's greatest distance from
// the point that is measured: its closest point is some 2^-51 of that off.
constexpr double kSame = 0x1p-40;
// Triangles whose height is a smaller share of their longest edge have no normal to speak of.
constexpr double kFlat = 0x1p-45;

constexpr std::int64_t kGrain = 4096;

/// Whether every edge is run along as often one way as the other; edges match by position.
bool is_closed(const SurfaceView& surface, Workers& workers) {
  const auto vertices = static_cast<std::int64_t>(surface.positions.size());
  const auto triangles = static_cast<std::int64_t>(surface.triangles.size());
  std::vector<std::uint64_t> keys(surface.positions.size());
  workers.for_portions(vertices, kGrain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
      keys[v] = position_key(surface.positions[v]);
    }
  });
  std::vector<std::uint64_t> sums(static_cast<std::size_t>((triangles + kGrain - 1) / kGrain));
  workers.for_portions(triangles, kGrain, [&](std::int64_t begin, std::int64_t end) {
    sums[static_cast<std::size_t>(begin / kGrain)] =
        edge_balance(keys, surface.triangles.subspan(static_cast<std::size_t>(begin),
                                                     static_cast<std::size_t>(end - begin)));
  });
  std::uint64_t balance = 0;
  for (const std::uint64_t sum : sums) {
    balance += sum;
  }
  return balance == 0;
}

double size_of(const Corners& corners) {
  return std::sqrt(std::max(
      {squared_length(corners[0]), squared_length(corners[1]), squared_length(corners[2])}));
}

/// Unit normal, or 0 for a triangle too thin to have one.
Vec3 unit_normal(const Corners& corners) {
  const Vec3 ab = minus(corners[1], corners[0]);
  const Vec3 bc = minus(corners[2], corners[1]);
  const Vec3 ca = minus(corners[0], corners[2]);
  const double ab2 = squared_length(ab);
  const double bc2 = squared_length(bc);
  const double ca2 = squared_length(ca);
  const double longest2 = std::max({ab2, bc2, ca2});
  // The two shorter edges lose least to rounding.
  const Vec3 normal = longest2 == ab2   ? cross(bc, ca)
                      : longest2 == bc2 ? cross(ca, ab)
                                        : cross(ab, bc);
  const double size = length(normal);
  return size > kFlat * longest2 ? scaled(normal, 1.0 / size) : Vec3{0, 0, 0};
}

/// The angle that a triangle takes up around the origin, which lies on it: 2π within it, half of
/// that on an edge.
double angle_around(const Corners& corners, double same_vertex, double same_edge) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3& apex = corners[corner];
    if (length(apex) <= same_vertex) {
      const Vec3 u = minus(corners[(corner + 1) % 3], apex);
      const Vec3 v = minus(corners[(corner + 2) % 3], apex);
      return std::atan2(length(cross(u, v)), dot(u, v));
    }
  }
  for (std::size_t corner = 0; corner < 3; ++corner) {
    if (length(closest_on_segment(corners[corner], corners[(corner + 1) % 3])) <= same_edge) {
      return std::numbers::pi;
    }
  }
  return 2.0 * std::numbers::pi;
}

class ReferenceProbe final : public DistanceProbe {
 public:
  ReferenceProbe(const TriangleTree& tree, double scale, bool with_sign)
      : tree_(tree), scale_(scale), with_sign_(with_sign) {}

  double measure(const Vec3& point) override {
    const Vec3 in_units = scaled(point, scale_);
    const TriangleTree::Nearest nearest = tree_.nearest(in_units, guess_);
    guess_ = nearest.triangle;
    const double distance = std::sqrt(nearest.distance2) / scale_;
    if (!with_sign_) {
      return distance;
    }
    const std::optional<Vec3> closer = tree_.from_nearby(in_units);
    const bool inside =
        closer ? is_inside(*closer, tree_.nearest(*closer, guess_)) : is_inside(in_units, nearest);
    return inside ? -distance : distance;
  }

 private:
  /// Whether the point lies behind the surface at the closest point.
  bool is_inside(const Vec3& point, const TriangleTree::Nearest& nearest) {
    const Corners corners = relative(nearest.triangle, point, nearest.way);
    const double same = kSame * size_of(tree_.corners(nearest.triangle, point));
    const bool within = angle_around(corners, same, same) > std::numbers::pi;
    const bool touching = nearest.distance2 <= same * same;
    return dot(nearest.way, within || touching ? unit_normal(corners)
                                               : mean_normal(point, nearest.way, same)) > 0.0;
  }

  /// Sum of the normals of all triangles around the closest point, each times its angle. The point
  /// is outside of a solid if it is on that side, whichever way triangles cut up edges and faces.
  Vec3 mean_normal(const Vec3& point, const Vec3& way, double same) {
    Vec3 sum{0, 0, 0};
    tree_.collect(point, way, same, around_);
    for (const std::uint32_t triangle : around_) {
      const Corners corners = relative(triangle, point, way);
      // Rounding is in proportion to this triangle's size too.
      const double same_here = std::max(same, kSame * size_of(corners));
      if (length(closest_on_triangle(corners)) <= same_here) {
        sum = plus(sum, scaled(unit_normal(corners), angle_around(corners, same, same_here)));
      }
    }
    return sum;
  }

  [[nodiscard]] Corners relative(std::uint32_t triangle, const Vec3& point, const Vec3& way) const {
    const auto [a, b, c] = tree_.corners(triangle, point);
    return {minus(a, way), minus(b, way), minus(c, way)};
  }

  const TriangleTree& tree_;
  double scale_;
  bool with_sign_;
  std::uint32_t guess_ = 0;
  std::vector<std::uint32_t> around_;
};

}  // namespace

ReferenceSurface::ReferenceSurface(const SurfaceView& surface, bool with_sign, int threads,
                                   Workers& workers)
    : scale_(surface.scale),
      tree_(surface, threads),
      has_sign_(with_sign && is_closed(surface, workers)) {}

std::unique_ptr<DistanceProbe> ReferenceSurface::probe() const {
  return std::make_unique<ReferenceProbe>(tree_, scale_, has_sign_);
}

}  // namespace difmesh::detail
