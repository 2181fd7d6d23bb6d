#pragma once
// The point of an implicit surface that is nearest to a given one.

#include <array>
#include <cstddef>
#include <vector>

#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// A smooth function whose zero set is the surface; its gradient does not vanish there.
class ImplicitSurface {
 public:
  struct Derivatives {
    double value = 0.0;
    Vec3 gradient{};
    Vec3 diagonal{};  ///< second derivatives xx, yy, zz
    Vec3 mixed{};     ///< yz, zx, xy
  };

  ImplicitSurface() = default;
  ImplicitSurface(const ImplicitSurface&) = delete;
  ImplicitSurface& operator=(const ImplicitSurface&) = delete;
  virtual ~ImplicitSurface() = default;
  [[nodiscard]] virtual Derivatives derivatives(const Vec3& x) const = 0;
};

/// A point of the surface and how far the query is from it.
struct Foot {
  Vec3 point{};
  double squared_distance = 0.0;
  double offset = 0.0;  ///< of the query along the gradient's direction at the foot
};

/// Goes down from a point on or near the surface to the next local minimum of the distance to
/// `query`: Newton steps in the tangent plane, shortened until they lead downhill. \param size of
/// the surface
[[nodiscard]] Foot descend(const ImplicitSurface& surface, const Vec3& query, const Vec3& start,
                           double size);

/// Moves a point that is near the surface onto it, along the gradient.
[[nodiscard]] Vec3 project(const ImplicitSurface& surface, Vec3 x, double size);

/// Points all over a surface, in clusters, from which to descend.
class PointCloud {
 public:
  /// \param points within `spacing` of any point of the surface there is one of them
  PointCloud(std::vector<Vec3> points, double spacing);

  /// The nearest point of all.
  [[nodiscard]] Foot nearest(const ImplicitSurface& surface, const Vec3& query, double size) const;

 private:
  struct Cluster {
    std::size_t first = 0;
    std::size_t last = 0;
    Vec3 centre{};
    double radius = 0.0;
  };
  [[nodiscard]] std::size_t nearest_in(const Cluster& cluster, const Vec3& query) const;

  std::vector<Vec3> points_;
  std::vector<Cluster> clusters_;
  double spacing_;
};

}  // namespace difmesh::detail
