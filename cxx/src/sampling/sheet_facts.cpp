#include "sampling/sheet_facts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kPerPortion = 4096;
constexpr double kNormalLength = 0x1p20;

/// Adds to sums that other threads may add to as well; alone it takes a tenth of the time.
struct Adder {
  bool alone;

  // Sums of directions may wrap round: any direction will do that proves good.
  void operator()(std::uint32_t& sum, std::uint32_t term) const {
    if (alone) {
      sum += term;
    } else {
      std::atomic_ref<std::uint32_t>(sum).fetch_add(term, std::memory_order_relaxed);
    }
  }
};

/// A measure of the angle of a vector, 0 to 4.
double angle_of(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  const double share = size > 0.0 ? x / size : 1.0;
  return y >= 0.0 ? 1.0 - share : 3.0 + share;
}

std::array<std::int32_t, 3> direction_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area = cross(minus(b, a), minus(c, a));
  const double length = std::sqrt(dot(area, area));
  if (!(length > 0.0)) {
    return {0, 0, 0};
  }
  const double factor = kNormalLength / length;
  return {static_cast<std::int32_t>(area[0] * factor), static_cast<std::int32_t>(area[1] * factor),
          static_cast<std::int32_t>(area[2] * factor)};
}

/// A vector across another; its length is of no matter.
Vec3 across(const Vec3& d) {
  return std::abs(d[0]) < std::abs(d[2]) ? Vec3{0.0, d[2], -d[1]} : Vec3{-d[1], d[0], 0.0};
}

/// A random number for a vertex.
std::uint32_t number_of(std::uint32_t vertex) {
  std::uint32_t number = (vertex + 1) * 0x9e3779b1U;
  number = (number ^ (number >> 15)) * 0x85ebca6bU;
  return number ^ (number >> 13);
}

/// The triangles round each vertex.
class Stars {
 public:
  Stars(std::span<const Vec3> corners, std::span<const Triangle> triangles, bool alone,
        SheetFacts& facts)
      : corners_(corners),
        triangles_(triangles),
        add_{alone},
        facts_(facts),
        sums_(corners.size()) {}

  void add_normal(std::size_t t) {
    const Triangle& triangle = triangles_[t];
    facts_.normals[t] =
        direction_of(corners_[triangle[0]], corners_[triangle[1]], corners_[triangle[2]]);
    for (const std::uint32_t vertex : triangle) {
      for (std::size_t a = 0; a < 3; ++a) {
        add_(sums_[vertex].direction[a], static_cast<std::uint32_t>(facts_.normals[t][a]));
      }
    }
  }

  /// Once all normals are added. Triangles of a half-space turn the same way round its direction,
  /// so they go round as often as they cross a fixed half-line.
  void add_turn(std::size_t t) {
    const Triangle& triangle = triangles_[t];
    const std::array<std::int32_t, 3>& normal = facts_.normals[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = triangle[c];
      const std::uint32_t from = triangle[(c + 1) % 3];
      const std::uint32_t to = triangle[(c + 2) % 3];
      Sums& sums = sums_[vertex];
      Vec3 direction;
      double along = 0.0;
      for (std::size_t a = 0; a < 3; ++a) {
        direction[a] = static_cast<double>(static_cast<std::int32_t>(sums.direction[a]));
        along += direction[a] * normal[a];
      }
      if (!(along > 0.0)) {
        std::atomic_ref<std::uint8_t>(facts_.ordinary[vertex]).store(0, std::memory_order_relaxed);
        continue;
      }
      const Vec3 v = across(direction);
      const bool below = dot(minus(corners_[from], corners_[vertex]), v) < 0.0;
      const bool above = dot(minus(corners_[to], corners_[vertex]), v) >= 0.0;
      if (below && above) {
        add_(sums.turns, 1);
      }
      add_(sums.ends, number_of(to) - number_of(from));
    }
  }

  /// Once all turns are added.
  void judge(std::size_t vertex) {
    if (sums_[vertex].turns != 1 || sums_[vertex].ends != 0) {
      facts_.ordinary[vertex] = 0;
    }
  }

 private:
  struct Sums {
    std::array<std::uint32_t, 3> direction{};  ///< of the normals; as signed integers
    std::uint32_t turns = 0;                   ///< crossings of the half-line
    std::uint32_t ends = 0;  ///< numbers of the triangles' last corners, less those of the first
  };

  std::span<const Vec3> corners_;
  std::span<const Triangle> triangles_;
  Adder add_;
  SheetFacts& facts_;
  std::vector<Sums> sums_;
};

}  // namespace

// The axes across are counter-clockwise seen against the direction.
AngleGauge::AngleGauge(const Vec3& direction) : u_(across(direction)), v_(cross(direction, u_)) {}

double AngleGauge::quarters(const Vec3& apex, const Vec3& from, const Vec3& to) const {
  const Vec3 a = minus(from, apex);
  const Vec3 b = minus(to, apex);
  const double angle = angle_of(dot(b, u_), dot(b, v_)) - angle_of(dot(a, u_), dot(a, v_));
  return angle < 0.0 ? angle + 4.0 : angle;
}

SheetFacts sheet_facts(std::span<const Vec3> corners, std::span<const Triangle> triangles,
                       Workers& workers) {
  SheetFacts facts;
  facts.normals.resize(triangles.size());
  facts.ordinary.resize(corners.size());
  std::fill(facts.ordinary.begin(), facts.ordinary.end(), std::uint8_t{1});
  Stars stars(corners, triangles, workers.count() == 1, facts);
  const auto for_all = [&](std::size_t count, const auto& visit) {
    workers.for_portions(static_cast<std::int64_t>(count), kPerPortion,
                         [&](std::int64_t begin, std::int64_t end) {
                           for (std::int64_t i = begin; i < end; ++i) {
                             visit(static_cast<std::size_t>(i));
                           }
                         });
  };
  for_all(triangles.size(), [&](std::size_t t) { stars.add_normal(t); });
  for_all(triangles.size(), [&](std::size_t t) { stars.add_turn(t); });
  for_all(corners.size(), [&](std::size_t vertex) { stars.judge(vertex); });
  return facts;
}

}  // namespace difmesh::detail
