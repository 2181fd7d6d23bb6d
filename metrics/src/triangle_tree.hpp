#pragma once
// Which triangles of a mesh are close to a point. The only place that knows Embree.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "closest_point.hpp"
#include "surface_view.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace difmesh::detail {

/// A tree of boxes over the triangles of a surface. Points, distances and corners are in scaled
/// units: those of the surface times its scale. Queries may run concurrently.
class TriangleTree {
 public:
  /// \param threads for building; 0: as many as the machine has
  TriangleTree(const SurfaceView& surface, int threads);
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;
  ~TriangleTree() = default;

  struct Nearest {
    std::uint32_t triangle = 0;  ///< the first of those at the least distance
    Vec3 way{0, 0, 0};           ///< from the point to the closest point
    double distance2 = 0.0;      ///< squared
  };
  /// \param guess a triangle that may be close; any will do, a good one saves time
  [[nodiscard]] Nearest nearest(const Vec3& point, std::uint32_t guess) const;

  /// For a point so far away that rounding would blur the surface: a point on the way to it that is
  /// on the same side of everything.
  [[nodiscard]] std::optional<Vec3> from_nearby(const Vec3& point) const;

  /// All triangles within a radius of the point `point + way`, in ascending order, and some others
  /// nearby. The sum is never formed: its digits would be lost far from the origin.
  void collect(const Vec3& point, const Vec3& way, double radius,
               std::vector<std::uint32_t>& triangles) const;

  /// Corners of a triangle relative to a point.
  [[nodiscard]] Corners corners(std::uint32_t triangle, const Vec3& point) const noexcept {
    return surface_.corners(triangle, point);
  }

 private:
  struct ReleaseDevice {
    void operator()(RTCDeviceTy* device) const noexcept;
  };
  struct ReleaseScene {
    void operator()(RTCSceneTy* scene) const noexcept;
  };

  void build();
  /// The same for points more than so many radii of the surface away.
  [[nodiscard]] std::optional<Vec3> from_nearby(const Vec3& point, double radii) const;
  void throw_failure(const char* what) const;

  SurfaceView surface_;
  Vec3 centre_{0, 0, 0};  ///< of the surface's box: the origin of the boxes in float32
  double slack_ = 0.0;    ///< covers rounding in float64 of distances within the surface
  double radius_ = 0.0;   ///< no point of the surface is further from centre_
  double zoom_ = 1.0;     ///< the power of two that brings the boxes' half sides into [1, 2)
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
};

}  // namespace difmesh::detail
