#pragma once
// The plane that touches a graph over the centre of a box.

#include <array>
#include <cmath>

#include "curved/graph_share.hpp"

namespace difmesh::detail {

// Shorter edges, and planes that lean less against an axis, add nothing but rounding.
inline constexpr double kNoLength = 1e-14;
inline constexpr double kNoSlope = 1e-9;

/// A point of [0,1] and its weight.
struct GaussPoint {
  double at;
  double weight;
};
inline constexpr std::array<GaussPoint, 3> kGauss3{
    {{0.11270166537925831, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074169, 5.0 / 18.0}}};

[[nodiscard]] inline double length_of(const PlaneSection::Edge& edge) {
  const double along_s = edge.to.s - edge.from.s;
  const double along_t = edge.to.t - edge.from.t;
  return std::sqrt(along_s * along_s + along_t * along_t);
}

template <int kDegree>
struct TangentPlane {
  double xi;  ///< of the box's centre
  double eta;
  double value;  ///< of the graph there
  double by_xi;
  double by_eta;
  Vec3 normal;            ///< not of length 1: its component along the frame's ζ is
  double offset;          ///< normal · (x - centre) = offset
  double reach;           ///< offsets of this size and more miss the box
  PlaneInSpace in_space;  ///< by ξ and η from the box's centre
  Vec3 slopes;  ///< by axis, how fast the coordinate changes in the plane at most, by ξ and η

  TangentPlane(const PlaneGraph<kDegree>& graph, const Box& box) {
    const auto& [xi_axis, eta_axis, zeta_axis] = graph.frame;
    xi = dot(xi_axis, box.centre);
    eta = dot(eta_axis, box.centre);
    value = graph.polynomial.value(xi, eta);
    const auto [slope_xi, slope_eta] = graph.polynomial.gradient(xi, eta);
    by_xi = slope_xi;
    by_eta = slope_eta;
    offset = value - dot(zeta_axis, box.centre);
    reach = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      normal[a] = zeta_axis[a] - by_xi * xi_axis[a] - by_eta * eta_axis[a];
      reach += 0.5 * std::abs(normal[a]) * box.size[a];
      in_space.point[a] = zeta_axis[a] * offset;
      in_space.along_s[a] = xi_axis[a] + zeta_axis[a] * by_xi;
      in_space.along_t[a] = eta_axis[a] + zeta_axis[a] * by_eta;
      slopes[a] = std::sqrt(in_space.along_s[a] * in_space.along_s[a] +
                            in_space.along_t[a] * in_space.along_t[a]);
    }
  }

  /// Of the graph above the plane, along ζ.
  [[nodiscard]] double distance_to(const PlaneGraph<kDegree>& graph, double s, double t) const {
    return graph.polynomial.value(xi + s, eta + t) - (value + by_xi * s + by_eta * t);
  }
};

/// What the sides of the box cut off between plane and graph: along an edge of the section the side
/// leans by the ratio of normal and slope, so that the strip's area is half the square of the
/// graph's distance by it.
/// \param square of that distance, times a weight, at a point of the section
template <int kDegree, class Square>
[[nodiscard]] double cut_off_by_sides(const PlaneSection& section,
                                      const TangentPlane<kDegree>& plane, const Vec3& zeta,
                                      const Square& square) {
  double result = 0.0;
  for (std::size_t n = 0; n < section.corners(); ++n) {
    const PlaneSection::Edge edge = section.edge(n);
    const std::size_t axis = axis_of(edge.face);
    const double length = length_of(edge);
    const double slope = plane.slopes[axis];
    if (length < kNoLength || slope < kNoSlope) {
      continue;
    }
    double squares = 0.0;
    for (const GaussPoint& point : kGauss3) {
      squares += square(point.weight, edge.from.s + point.at * (edge.to.s - edge.from.s),
                        edge.from.t + point.at * (edge.to.t - edge.from.t));
    }
    result += sense_of(edge.face) * zeta[axis] / (2.0 * slope) * squares * length;
  }
  return result;
}

}  // namespace difmesh::detail
