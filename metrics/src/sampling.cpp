#include "sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/first_error.hpp"
#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "facet_points.hpp"
#include "tally.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kVerticesAtOnce = 256;
constexpr std::int64_t kTrianglesAtOnce = 64;
// Of the points, for the progress: vertices are half as many as triangles, with four each or more.
constexpr double kVertexShare = 0.1;
// Triangles up to this many times the usual size are not divided.
constexpr double kUsual = 2.0;
// 50 million points on one triangle are a mistake rather than a wish.
constexpr double kMostParts = 4096.0;

std::size_t to_size(std::int64_t n) {
  return static_cast<std::size_t>(n);
}

/// Area and longest edge of a triangle, in scaled units.
struct Extent {
  double area = 0.0;
  double longest = 0.0;
};

Extent extent_of(const SurfaceView& surface, std::size_t triangle) {
  const Vec3& base = surface.positions[surface.triangles[triangle][0]];
  const auto [a, b, c] = surface.corners(triangle, scaled(base, surface.scale));
  const Vec3 bc = minus(c, b);
  return {0.5 * length(cross(b, c)),
          std::sqrt(std::max({squared_length(b), squared_length(c), squared_length(bc)}))};
}

/// Measures one surface; one call each of what is public, in this order.
class Sampling {
 public:
  Sampling(const SurfaceView& surface, const DistanceField& field, Phases& phases, double share)
      : surface_(surface), field_(field), phases_(phases), share_(share) {}

  /// Decides how finely triangles are divided.
  void set_spacing(double facet_spacing) {
    double area = 0.0;
    double sum_of_squares = 0.0;
    double longest = 0.0;
    std::size_t largest = 0;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const Extent extent = extent_of(surface_, t);
      area += extent.area;
      sum_of_squares += extent.longest * extent.longest;
      if (extent.longest > longest) {
        longest = extent.longest;
        largest = t;
      }
    }
    if (!(area > 0.0)) {
      throw Error(ErrorCode::invalid_argument, "distance: all triangles of the " + name() +
                                                   " have area 0: there is no surface to measure");
    }
    result_.area = area / surface_.scale / surface_.scale;
    if (facet_spacing > 0.0) {
      part_size_ = 2.0 * facet_spacing * surface_.scale;
      if (!(longest / part_size_ <= kMostParts)) {
        throw Error(ErrorCode::invalid_argument,
                    "distance: facet_spacing is " + rounded_text(facet_spacing) +
                        ", but triangle " + std::to_string(largest) + " of the " + name() +
                        " has an edge of length " + rounded_text(longest / surface_.scale) +
                        "; 8192 steps at most are possible");
      }
    } else {
      part_size_ =
          kUsual * std::sqrt(sum_of_squares / static_cast<double>(surface_.triangles.size()));
    }
  }

  void measure_vertices() {
    std::vector<char> used(surface_.positions.size(), 0);
    for (const Triangle& triangle : surface_.triangles) {
      for (const std::uint32_t v : triangle) {
        used[v] = 1;
      }
    }
    at_vertices_.resize(surface_.positions.size());
    const auto count = static_cast<std::int64_t>(surface_.positions.size());
    const Tally tally = run(kVertexShare, count, kVerticesAtOnce,
                            [&](std::int64_t v, DistanceProbe& probe, Tally& portion) {
                              if (used[to_size(v)] != 0) {
                                measure_vertex(v, probe, portion);
                              }
                            });
    result_.vertices = tally.statistics(surface_.scale);
  }

  void measure_facets() {
    const auto count = static_cast<std::int64_t>(surface_.triangles.size());
    std::vector<double> reach(to_size((count + kTrianglesAtOnce - 1) / kTrianglesAtOnce), 0.0);
    const Tally tally = run(1.0 - kVertexShare, count, kTrianglesAtOnce,
                            [&](std::int64_t t, DistanceProbe& probe, Tally& portion) {
                              double& furthest = reach[to_size(t / kTrianglesAtOnce)];
                              furthest = std::max(furthest, measure_facet(t, probe, portion));
                            });
    result_.facets = tally.statistics(surface_.scale);
    result_.reach = *std::max_element(reach.begin(), reach.end()) / surface_.scale;
    result_.has_sign = field_.has_sign();
  }

  [[nodiscard]] const Distance& result() const { return result_; }

 private:
  /// Portions of the points, each with a probe and a tally of its own, merged in their order.
  template <class Measure>
  Tally run(double share, std::int64_t count, std::int64_t grain, const Measure& measure) {
    std::vector<Tally> tallies(to_size((count + grain - 1) / grain));
    FirstError error;
    phases_.run(share * share_, count, grain, [&](std::int64_t begin, std::int64_t end) {
      error.guard(begin, [&] {
        const std::unique_ptr<DistanceProbe> probe = field_.probe();
        for (std::int64_t i = begin; i < end; ++i) {
          measure(i, *probe, tallies[to_size(begin / grain)]);
        }
      });
    });
    error.rethrow();
    Tally whole;
    for (const Tally& tally : tallies) {
      whole.merge(tally);
    }
    return whole;
  }

  void measure_vertex(std::int64_t v, DistanceProbe& probe, Tally& tally) {
    const Vec3& position = surface_.positions[to_size(v)];
    const double distance = probe.measure(position);
    if (!std::isfinite(distance)) {
      throw_not_finite(distance, "vertex " + std::to_string(v), position);
    }
    at_vertices_[to_size(v)] = distance * surface_.scale;
    tally.add(at_vertices_[to_size(v)], 1.0, v, position);
  }

  /// Returns how far any point of the facet may be from the nearest one that is measured.
  double measure_facet(std::int64_t t, DistanceProbe& probe, Tally& tally) {
    const Extent extent = extent_of(surface_, to_size(t));
    const double ratio = extent.longest / part_size_;
    const std::int64_t parts =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(ratio)));
    const Triangle& corners = surface_.triangles[to_size(t)];
    const Vec3& base = surface_.positions[corners[0]];
    const Vec3 to_b = minus(surface_.positions[corners[1]], base);
    const Vec3 to_c = minus(surface_.positions[corners[2]], base);
    for_each_facet_point(parts, [&](const Vec3& weights, double share) {
      // From one corner: a weighted sum of positions would round several times in proportion to
      // their distance from the origin.
      const Vec3 position = plus(base, plus(scaled(to_b, weights[1]), scaled(to_c, weights[2])));
      const double distance = probe.measure(position);
      if (!std::isfinite(distance)) {
        throw_not_finite(distance, "a point of triangle " + std::to_string(t), position);
      }
      tally.add(distance * surface_.scale, share * extent.area, t, position);
    });
    const double corner_weight = kCornerShare * extent.area / static_cast<double>(parts * parts);
    for (const std::uint32_t v : corners) {
      tally.add_to_means(at_vertices_[v], corner_weight);
    }
    // Points next to each other form triangles of half a part's size. In a triangle with the
    // longest edge l no point is further than l / √3 from all corners; where it is equilateral, the
    // centre.
    return extent.longest / (2.0 * static_cast<double>(parts) * std::sqrt(3.0));
  }

  [[nodiscard]] std::string name() const { return surface_.name; }

  [[noreturn]] static void throw_not_finite(double distance, const std::string& where,
                                            const Vec3& position) {
    throw Error(ErrorCode::invalid_value, "distance: the distance at " + where + " at " +
                                              rounded_text(position) + " is " +
                                              rounded_text(distance));
  }

  const SurfaceView& surface_;
  const DistanceField& field_;
  Phases& phases_;
  double share_;
  double part_size_ = 0.0;           ///< longest edge of a part, scaled
  std::vector<double> at_vertices_;  ///< distances, scaled
  Distance result_;
};

}  // namespace

Distance measure_surface(const SurfaceView& surface, const DistanceField& field,
                         double facet_spacing, Phases& phases, double share) {
  Sampling sampling(surface, field, phases, share);
  sampling.set_spacing(facet_spacing);
  sampling.measure_vertices();
  sampling.measure_facets();
  return sampling.result();
}

}  // namespace difmesh::detail
