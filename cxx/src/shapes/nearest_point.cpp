#include "shapes/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "shapes/shape_body.hpp"

namespace difmesh::detail {
namespace {

constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();

double squared_distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = plus(a, -1.0, b);
  return dot(d, d);
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Two unit vectors that complete a unit vector to a right-handed frame.
std::pair<Vec3, Vec3> tangents(const Vec3& normal) {
  std::size_t least = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    least = std::abs(normal[a]) < std::abs(normal[least]) ? a : least;
  }
  Vec3 axis{};
  axis[least] = 1.0;
  Vec3 first = cross(axis, normal);
  first = plus({}, 1.0 / length(first), first);
  return {first, cross(normal, first)};
}

Vec3 times_hessian(const ImplicitSurface::Derivatives& d, const Vec3& v) {
  return {d.diagonal[0] * v[0] + d.mixed[2] * v[1] + d.mixed[1] * v[2],
          d.mixed[2] * v[0] + d.diagonal[1] * v[1] + d.mixed[0] * v[2],
          d.mixed[1] * v[0] + d.mixed[0] * v[1] + d.diagonal[2] * v[2]};
}

// The step in the tangent plane towards the minimum of |x - query|^2 / 2 on the surface: Newton's
// where the Hessian of the Lagrangian is positive definite there, against the gradient elsewhere.
Vec3 tangent_step(const ImplicitSurface::Derivatives& d, const Vec3& offset) {
  const double slope = length(d.gradient);
  const Vec3 normal = plus({}, 1.0 / slope, d.gradient);
  const auto [t1, t2] = tangents(normal);
  const double multiplier = -dot(offset, normal) / slope;
  const Vec3 h1 = times_hessian(d, t1);
  const Vec3 h2 = times_hessian(d, t2);
  const double a11 = 1.0 + multiplier * dot(t1, h1);
  const double a12 = multiplier * dot(t1, h2);
  const double a22 = 1.0 + multiplier * dot(t2, h2);
  const double g1 = dot(t1, offset);
  const double g2 = dot(t2, offset);
  const double determinant = a11 * a22 - a12 * a12;
  double s1 = -g1;
  double s2 = -g2;
  if (a11 > 0.0 && determinant > kRounding * a11 * std::abs(a22)) {
    s1 = -(a22 * g1 - a12 * g2) / determinant;
    s2 = -(a11 * g2 - a12 * g1) / determinant;
  }
  return plus(plus({}, s1, t1), s2, t2);
}

}  // namespace

Vec3 project(const ImplicitSurface& surface, Vec3 x, double size) {
  constexpr int kMaxSteps = 20;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxSteps; ++i) {
    const auto d = surface.derivatives(x);
    const double squared = dot(d.gradient, d.gradient);
    const double step = std::abs(d.value) / std::sqrt(squared);
    // The negation ends it at a point without gradient, too.
    if (!(step < before)) {
      break;
    }
    x = plus(x, -d.value / squared, d.gradient);
    if (step <= kRounding * size) {
      break;
    }
    before = step;
  }
  return x;
}

Foot descend(const ImplicitSurface& surface, const Vec3& query, const Vec3& start, double size) {
  constexpr int kMaxSteps = 100;
  constexpr int kMaxHalvings = 30;
  constexpr double kLongestStep = 0.2;
  Vec3 x = project(surface, start, size);
  double squared = squared_distance(x, query);
  for (int i = 0; i < kMaxSteps; ++i) {
    Vec3 step = tangent_step(surface.derivatives(x), plus(x, -1.0, query));
    const double longest = length(step);
    if (longest > kLongestStep * size) {
      step = plus({}, kLongestStep * size / longest, step);
    }
    bool moved = false;
    for (int halving = 0; halving < kMaxHalvings && !moved; ++halving) {
      const Vec3 next = project(surface, plus(x, 1.0, step), size);
      const double next_squared = squared_distance(next, query);
      // Rounding in x makes the squared distance uncertain by this much; steps as small are the
      // last.
      const double slack = kRounding * size * (std::sqrt(squared) + kRounding * size);
      if (next_squared <= squared + (longest < 1e-6 * size ? slack : 0.0)) {
        moved = true;
        x = next;
        squared = next_squared;
      } else {
        step = plus({}, 0.5, step);
      }
    }
    if (!moved || longest <= kRounding * size) {
      break;
    }
  }
  const Vec3 gradient = surface.derivatives(x).gradient;
  return {x, squared, dot(plus(query, -1.0, x), gradient) / length(gradient)};
}

PointCloud::PointCloud(std::vector<Vec3> points, double spacing)
    : points_(std::move(points)), spacing_(spacing) {
  constexpr double kClusterSide = 5.0;
  const auto key = [&](const Vec3& p) {
    std::array<std::int64_t, 3> cell;
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = static_cast<std::int64_t>(std::floor(p[a] / (kClusterSide * spacing)));
    }
    return cell;
  };
  std::sort(points_.begin(), points_.end(), [&](const Vec3& a, const Vec3& b) {
    const auto ka = key(a);
    const auto kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t first = 0; first < points_.size();) {
    Cluster cluster{.first = first, .last = first};
    while (cluster.last < points_.size() && key(points_[cluster.last]) == key(points_[first])) {
      cluster.centre = plus(cluster.centre, 1.0, points_[cluster.last++]);
    }
    cluster.centre =
        plus({}, 1.0 / static_cast<double>(cluster.last - cluster.first), cluster.centre);
    for (std::size_t i = cluster.first; i < cluster.last; ++i) {
      cluster.radius =
          std::max(cluster.radius, std::sqrt(squared_distance(points_[i], cluster.centre)));
    }
    clusters_.push_back(cluster);
    first = cluster.last;
  }
}

std::size_t PointCloud::nearest_in(const Cluster& cluster, const Vec3& query) const {
  std::size_t best = cluster.first;
  double least = squared_distance(points_[best], query);
  for (std::size_t i = cluster.first + 1; i < cluster.last; ++i) {
    const double squared = squared_distance(points_[i], query);
    if (squared < least) {
      least = squared;
      best = i;
    }
  }
  return best;
}

// A cluster can hold the nearest point only if its ball, with the gaps between its points, reaches
// nearer than what has been found.
Foot PointCloud::nearest(const ImplicitSurface& surface, const Vec3& query, double size) const {
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(clusters_.size());
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    const double to_centre = std::sqrt(squared_distance(query, clusters_[i].centre));
    order.emplace_back(to_centre - clusters_[i].radius - spacing_, i);
  }
  std::sort(order.begin(), order.end());
  Foot best{.squared_distance = std::numeric_limits<double>::infinity()};
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [bound, index] : order) {
    if (bound > distance) {
      break;
    }
    const Vec3& start = points_[nearest_in(clusters_[index], query)];
    if (std::sqrt(squared_distance(start, query)) - spacing_ > distance) {
      continue;
    }
    const Foot foot = descend(surface, query, start, size);
    if (foot.squared_distance < best.squared_distance) {
      best = foot;
      distance = std::sqrt(foot.squared_distance);
    }
  }
  return best;
}

}  // namespace difmesh::detail
