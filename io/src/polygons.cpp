#include "polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ear_cutter.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

/// Of a triangle's longest edge squared: twice the area of one that counts as flat.
constexpr double kFlat = 1e-12;

constexpr std::size_t kMostCorners = 0xFFFFFFFF;

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vec3 times(double factor, const Vec3& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// One polygon: its corners as offsets from the first, in a unit in which they are about 1.
class Polygon {
 public:
  /// The corners of the fan that `triangles` are.
  void take(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
    corners_.clear();
    corners_.push_back(triangles[0][0]);
    corners_.push_back(triangles[0][1]);
    for (const Triangle& triangle : triangles) {
      corners_.push_back(triangle[2]);
    }
    double largest = 0.0;
    bool is_finite = true;
    for (const std::uint32_t v : corners_) {
      for (const double coordinate : positions[v]) {
        largest = std::max(largest, std::abs(coordinate));
        is_finite = is_finite && std::isfinite(coordinate);
      }
    }
    offsets_.clear();
    if (is_finite && largest > 0.0) {
      take_offsets(positions, largest);
    }
  }

  /// Whether there is more than one way to cut it that matters.
  [[nodiscard]] bool has_area() const { return !offsets_.empty() && dot(area_, area_) > 0.0; }

  /// Whether each triangle of the fan faces as the polygon does. If the polygon does not cross
  /// itself, the fan covers it then: its corners turn about the first one in one direction.
  [[nodiscard]] bool fan_is_right() const {
    const double length = std::sqrt(dot(area_, area_));
    for (std::size_t c = 2; c < offsets_.size(); ++c) {
      const Vec3& a = offsets_[c - 1];
      const Vec3& b = offsets_[c];
      const Vec3 side = minus(b, a);
      const double longest = std::max({dot(a, a), dot(b, b), dot(side, side)});
      if (!(dot(cross(a, b), area_) > kFlat * length * longest)) {
        return false;
      }
    }
    return true;
  }

  /// The corners in the plane of two axes that the polygon is seen best in, counter-clockwise.
  [[nodiscard]] const std::vector<Point2>& in_plane() {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      axis = std::abs(area_[i]) > std::abs(area_[axis]) ? i : axis;
    }
    std::size_t u = (axis + 1) % 3;
    std::size_t v = (axis + 2) % 3;
    if (area_[axis] < 0.0) {
      std::swap(u, v);
    }
    points_.clear();
    for (const Vec3& offset : offsets_) {
      points_.push_back({offset[u], offset[v]});
    }
    return points_;
  }

  [[nodiscard]] const std::vector<std::uint32_t>& corners() const { return corners_; }

 private:
  /// A power of two that brings `largest` near 1, as far as it is finite.
  static double unit_for(double largest) {
    int exponent = 0;
    (void)std::frexp(largest, &exponent);
    return std::ldexp(1.0, std::min(-exponent, 1000));
  }

  void take_offsets(std::span<const Vec3> positions, double largest) {
    // Before the differences, which could overflow, and after, as they may be small.
    const double unit = unit_for(largest);
    const Vec3 first = times(unit, positions[corners_[0]]);
    double reach = 0.0;
    for (const std::uint32_t v : corners_) {
      offsets_.push_back(minus(times(unit, positions[v]), first));
      for (const double coordinate : offsets_.back()) {
        reach = std::max(reach, std::abs(coordinate));
      }
    }
    const double second_unit = unit_for(reach);
    area_ = {0, 0, 0};
    for (std::size_t c = 1; c < offsets_.size(); ++c) {
      offsets_[c] = times(second_unit, offsets_[c]);
      const Vec3 part = cross(offsets_[c - 1], offsets_[c]);
      area_ = {area_[0] + part[0], area_[1] + part[1], area_[2] + part[2]};
    }
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> offsets_;  ///< none for a polygon that is not finite, or is one point at 0
  std::vector<Point2> points_;
  Vec3 area_{};  ///< twice the vector of the area
};

}  // namespace

void Polygons::add(Array<Triangle>& triangles, std::span<const std::uint32_t> corners) {
  std::size_t last = corners.size() - 1;
  while (last > 2 && corners[last] == corners[0]) {
    --last;
  }
  std::size_t repeated = 0;
  const std::size_t before = triangles.size();
  triangles.resize(before + last - 1);
  Triangle* next = triangles.data() + before;
  std::uint32_t previous = corners[0];
  std::size_t taken = 1;
  for (std::size_t c = 1; c <= last; ++c) {
    // A triangle needs three corners, equal ones too.
    if (corners[c] == previous && last - repeated > 2) {
      ++repeated;
      continue;
    }
    if (++taken > 2) {
      *next++ = {corners[0], previous, corners[c]};
    }
    previous = corners[c];
  }
  triangles.resize(before + taken - 2);
  if (runs_.empty() || runs_.back().corners != taken) {
    runs_.push_back({taken, 0});
  }
  ++runs_.back().polygons;
}

Polygons::Report Polygons::cut(const std::filesystem::path& path, Mesh& mesh) const {
  Report report;
  Polygon polygon;
  EarCutter cutter;
  std::size_t at = 0;
  for (const Run& run : runs_) {
    const std::size_t each = run.corners - 2;
    for (std::size_t n = 0; each > 1 && n < run.polygons; ++n) {
      const std::span<Triangle> triangles(mesh.triangles.data() + at + n * each, each);
      polygon.take(triangles, mesh.positions);
      if (!polygon.has_area() || polygon.fan_is_right()) {
        continue;
      }
      const EarCutter::Result result = run.corners <= kMostCorners ? cutter.cut(polygon.in_plane())
                                                                   : EarCutter::Result::too_long;
      if (result == EarCutter::Result::too_long) {
        fail_format(path, "a face of " + std::to_string(run.corners) + " corners from vertex " +
                              std::to_string(polygon.corners()[0]) +
                              " on is too intricate to be cut into triangles");
      }
      if (result == EarCutter::Result::crossed && report.crossed++ == 0) {
        report.first_crossed = static_cast<std::int64_t>(at + n * each);
      }
      for (std::size_t t = 0; t < each; ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
          triangles[t][c] = polygon.corners()[cutter.triangles()[t][c]];
        }
      }
    }
    at += run.polygons * each;
  }
  return report;
}

void cut_polygons(const std::filesystem::path& path, const Polygons& polygons, MeshFile& surface) {
  const Polygons::Report report = polygons.cut(path, surface.mesh);
  if (report.crossed > 0) {
    add_warning(
        surface.warnings, path,
        "cut " + count_of(static_cast<std::uint64_t>(report.crossed), "polygon") +
            " with sides that cross into triangles that overlap, the first of them triangle " +
            std::to_string(report.first_crossed));
  }
}

}  // namespace difmesh::detail
