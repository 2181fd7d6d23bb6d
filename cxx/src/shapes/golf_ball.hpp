#pragma once
// A ball less many equal balls.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "shapes/shape_body.hpp"

namespace difmesh::detail {

/// Finds the nearest of many directions, by bins on the faces of a cube.
class DirectionIndex {
 public:
  DirectionIndex() = default;
  explicit DirectionIndex(std::vector<Vec3> directions);
  /// \param u of any length
  [[nodiscard]] const Vec3& nearest(const Vec3& u) const;
  [[nodiscard]] const std::vector<Vec3>& directions() const { return directions_; }

 private:
  [[nodiscard]] std::size_t bin_of(const Vec3& u) const;
  [[nodiscard]] Vec3 place_in_bin(std::size_t bin, double a, double b) const;

  std::vector<Vec3> directions_;
  std::size_t side_ = 1;              // bins along an edge of a face
  std::vector<std::uint32_t> first_;  // of each bin, in candidates_
  std::vector<std::uint32_t> candidates_;
};

/// f = max(|u| - R, r - |u - D n|), n the nearest dimple's axis: the exact distance inside, a lower
/// bound outside.
class GolfBallModel {
 public:
  /// Dimples must not meet. \throw Error invalid_argument if they do or are out of range
  explicit GolfBallModel(const ShapeOptions& options);

  [[nodiscard]] double value(const Vec3& u) const;
  [[nodiscard]] Vec3 gradient(const Vec3& u) const;
  [[nodiscard]] double distance(const Vec3& u) const;
  [[nodiscard]] Extent extent(const Vec3&) const { return {radius_, radius_}; }
  [[nodiscard]] std::optional<double> volume() const;
  /// Of cells that rims cross: the ball's overlap less those of the lenses taken away, which do not
  /// overlap one another.
  [[nodiscard]] std::optional<double> known_fraction(const Frame& frame, const Vec3& low,
                                                     const Vec3& size) const;

 private:
  [[nodiscard]] bool rim_within(const Vec3& u, double reach) const;

  double radius_;  // R
  double rim_radius_;
  double rim_height_;     // of its plane above the ball's centre
  double dimple_radius_;  // r, of the ball taken away
  double dimple_centre_;  // D
  DirectionIndex dimples_;
};

}  // namespace difmesh::detail
