#include "curved/graph_share.hpp"

#include <cmath>

#include "curved/grazing_share.hpp"
#include "curved/tangent_plane.hpp"
#include "planes/cube_fraction.hpp"

namespace difmesh::detail {
namespace {

// Dunavant's rule of degree four: barycentric coordinates of two corners, and the weight.
struct TrianglePoint {
  double first;
  double second;
  double weight;
};
constexpr double kOuter = 0.091576213509770743460;
constexpr double kInner = 0.44594849091596488632;
constexpr double kOuterWeight = 0.10995174365532186764;
constexpr double kInnerWeight = 0.22338158967801146570;
constexpr std::array<TrianglePoint, 6> kTriangleRule{{
    {1.0 - 2.0 * kOuter, kOuter, kOuterWeight},
    {kOuter, 1.0 - 2.0 * kOuter, kOuterWeight},
    {kOuter, kOuter, kOuterWeight},
    {1.0 - 2.0 * kInner, kInner, kInnerWeight},
    {kInner, 1.0 - 2.0 * kInner, kInnerWeight},
    {kInner, kInner, kInnerWeight},
}};

// Integrals of the polynomial's terms over the section.
template <int kDegree>
typename PlanePolynomial<kDegree>::Terms integrals(const PlaneSection& section,
                                                   const TangentPlane<kDegree>& plane) {
  typename PlanePolynomial<kDegree>::Terms result{};
  const PlanePoint apex = section.edge(0).from;
  for (std::size_t n = 1; n + 1 < section.corners(); ++n) {
    const auto [from, to, face] = section.edge(n);
    const double area =
        0.5 * ((from.s - apex.s) * (to.t - apex.t) - (from.t - apex.t) * (to.s - apex.s));
    for (const TrianglePoint& point : kTriangleRule) {
      const double third = 1.0 - point.first - point.second;
      const double s = point.first * apex.s + point.second * from.s + third * to.s;
      const double t = point.first * apex.t + point.second * from.t + third * to.t;
      const auto terms = PlanePolynomial<kDegree>::terms(plane.xi + s, plane.eta + t);
      for (std::size_t m = 0; m < result.size(); ++m) {
        result[m] += point.weight * area * terms[m];
      }
    }
  }
  return result;
}

// The same from sums over the edges.
PlanePolynomial<2>::Terms integrals(const PlaneSection& section, const TangentPlane<2>& plane) {
  double one = 0.0;  // integrals of 1, s, t, s², s t and t²
  double s = 0.0;
  double t = 0.0;
  double ss = 0.0;
  double st = 0.0;
  double tt = 0.0;
  for (std::size_t n = 0; n < section.corners(); ++n) {
    const auto [from, to, face] = section.edge(n);
    const double turn = from.s * to.t - to.s * from.t;
    one += turn;
    s += (from.s + to.s) * turn;
    t += (from.t + to.t) * turn;
    ss += (from.s * from.s + from.s * to.s + to.s * to.s) * turn;
    st += (from.s * (2.0 * from.t + to.t) + to.s * (from.t + 2.0 * to.t)) * turn;
    tt += (from.t * from.t + from.t * to.t + to.t * to.t) * turn;
  }
  one *= 0.5;
  s *= 1.0 / 6.0;
  t *= 1.0 / 6.0;
  ss *= 1.0 / 12.0;
  st *= 1.0 / 24.0;
  tt *= 1.0 / 12.0;
  const double xi = plane.xi;
  const double eta = plane.eta;
  return {one,
          s + xi * one,
          t + eta * one,
          ss + 2.0 * xi * s + xi * xi * one,
          st + xi * t + eta * s + xi * eta * one,
          tt + 2.0 * eta * t + eta * eta * one};
}

}  // namespace

template <int kDegree>
GraphShare<kDegree> share_below(const PlaneGraph<kDegree>& graph, const Box& box, bool grazes) {
  const TangentPlane<kDegree> plane(graph, box);
  GraphShare<kDegree> result;
  if (!(std::abs(plane.offset) < plane.reach)) {
    result.is_pure = true;
    result.share = plane.offset > 0.0 ? 1.0 : 0.0;
    return result;
  }
  const double volume = box.size[0] * box.size[1] * box.size[2];
  result.share = cube_fraction(plane.normal[0] * box.size[0], plane.normal[1] * box.size[1],
                               plane.normal[2] * box.size[2], plane.offset);
  double added = 0.0;
  bool is_done = false;
  if constexpr (kDegree == 2) {
    is_done = grazes && add_grazing_share(graph, plane, box.size, added, result.slopes);
  }
  if (!is_done) {
    const PlaneSection section = PlaneSection::of_box(plane.in_space, box.size);
    if (section.corners() >= 3) {
      result.slopes = integrals(section, plane);
      double below_graph = 0.0;
      for (std::size_t n = 0; n < result.slopes.size(); ++n) {
        below_graph += graph.polynomial.c[n] * result.slopes[n];
      }
      const double below_plane =
          (plane.value - plane.by_xi * plane.xi - plane.by_eta * plane.eta) * result.slopes[0] +
          plane.by_xi * result.slopes[1] + plane.by_eta * result.slopes[2];
      added =
          below_graph - below_plane -
          cut_off_by_sides(section, plane, graph.frame[2], [&](double weight, double s, double t) {
            const double apart = plane.distance_to(graph, s, t);
            return weight * apart * apart;
          });
    }
  }
  result.share += added / volume;
  for (double& slope : result.slopes) {
    slope /= volume;
  }
  return result;
}

template GraphShare<2> share_below(const PlaneGraph<2>&, const Box&, bool);
template GraphShare<4> share_below(const PlaneGraph<4>&, const Box&, bool);

}  // namespace difmesh::detail
