#include "curved/grazing_share.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace difmesh::detail {
namespace {

// Planes that lean less than this against an axis.
constexpr double kGrazing = 0.3;
constexpr double kLevel = 1e-12;  // and less than this count as level
constexpr double kNoCurve = 1e-14;

constexpr std::array<GaussPoint, 2> kGauss2{
    {{0.21132486540518713, 0.5}, {0.78867513459481287, 0.5}}};
constexpr std::array<GaussPoint, 4> kGauss4{{{0.069431844202973714, 0.17392742256872693},
                                             {0.33000947820757187, 0.32607257743127307},
                                             {0.66999052179242813, 0.32607257743127307},
                                             {0.93056815579702629, 0.17392742256872693}}};

/// A few numbers within an interval, in their order.
template <std::size_t kMost>
class Breaks {
 public:
  Breaks(double low, double high) : low_(low), high_(high) {}
  void add(double value) {
    if (!(value > low_ && value < high_) || count_ == kMost) {
      return;
    }
    std::size_t at = count_++;
    for (; at > 0 && values_[at - 1] > value; --at) {
      values_[at] = values_[at - 1];
    }
    values_[at] = value;
  }
  /// Calls visit(from, to) for the pieces of the interval.
  template <class Visit>
  void for_each_piece(const Visit& visit) const {
    double from = low_;
    for (std::size_t n = 0; n <= count_; ++n) {
      const double to = n < count_ ? values_[n] : high_;
      if (to - from > kNoLength) {
        visit(from, to);
      }
      from = to;
    }
  }

 private:
  double low_;
  double high_;
  std::array<double, kMost> values_;
  std::size_t count_ = 0;
};

// Calls visit(x) for the real roots of a x² + b x + c where there are two.
template <class Visit>
void for_each_root(double a, double b, double c, const Visit& visit) {
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant > 0.0)) {
    return;
  }
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  if (std::abs(a) > kNoCurve) {
    visit(q / a);
  }
  if (std::abs(q) > kNoCurve) {
    visit(c / q);
  }
}

/// A plane between two faces: s along its slope against their axis, t across it.
class GrazedCell {
 public:
  GrazedCell(const PlaneGraph<2>& graph, const TangentPlane<2>& plane, const Vec3& size,
             std::size_t axis, double slope)
      : graph_(graph),
        plane_(plane),
        cosine_(slope > kLevel ? plane.in_space.along_s[axis] / slope : 1.0),
        sine_(slope > kLevel ? plane.in_space.along_t[axis] / slope : 0.0),
        turned_{
            plane.in_space.point,
            plus(scaled(plane.in_space.along_s, cosine_), scaled(plane.in_space.along_t, sine_)),
            minus(scaled(plane.in_space.along_t, cosine_), scaled(plane.in_space.along_s, sine_))},
        section_(turned_, size, axis) {
    const double k_xx = graph.polynomial.c[3];
    const double k_xy = graph.polynomial.c[4];
    const double k_yy = graph.polynomial.c[5];
    const double cc = cosine_ * cosine_;
    const double ss = sine_ * sine_;
    const double cs = cosine_ * sine_;
    ss_ = k_xx * cc + k_xy * cs + k_yy * ss;
    tt_ = k_xx * ss - k_xy * cs + k_yy * cc;
    st_ = 2.0 * (k_yy - k_xx) * cs + k_xy * (cc - ss);
    const double zeta = graph.frame[2][axis];
    const double sense = zeta > 0.0 ? 1.0 : -1.0;
    lean_ = sense * slope / std::abs(zeta);
    high_ = (0.5 * size[axis] - sense * turned_.point[axis]) / std::abs(zeta);
    low_ = (-0.5 * size[axis] - sense * turned_.point[axis]) / std::abs(zeta);
  }

  [[nodiscard]] bool is_empty() const { return section_.corners() < 3; }

  /// False where the faces are further away than the graph comes, at the section's corners.
  [[nodiscard]] bool meets_a_face() const {
    double most_apart = 0.0;
    double nearest = 1e9;
    for (std::size_t n = 0; n < section_.corners(); ++n) {
      const PlanePoint at = section_.edge(n).from;
      most_apart = std::max(most_apart, std::abs(apart(at.s, at.t)));
      nearest = std::min({nearest, high(at.s), -low(at.s)});
    }
    return nearest <= most_apart;
  }

  void integrate(double& volume, PlanePolynomial<2>::Terms& slopes) const {
    volume = 0.0;
    slopes = {};
    slice_bounds().for_each_piece([&](double from, double to) {
      for (const GaussPoint& point : kGauss4) {
        add_slice(from + point.at * (to - from), point.weight * (to - from), volume, slopes);
      }
    });
    volume -= cut_off_by_sides(section_, plane_, graph_.frame[2],
                               [this](double weight, double s, double t) {
                                 const double graph = between_faces(apart(s, t), s);
                                 const double plane = between_faces(0.0, s);
                                 return weight * (graph * graph - plane * plane);
                               });
  }

 private:
  // Of the graph over the plane, and of the two faces, along ζ.
  [[nodiscard]] double apart(double s, double t) const {
    return ss_ * s * s + st_ * s * t + tt_ * t * t;
  }
  [[nodiscard]] double high(double s) const { return high_ - lean_ * s; }
  [[nodiscard]] double low(double s) const { return low_ - lean_ * s; }
  [[nodiscard]] double between_faces(double height, double s) const {
    return std::clamp(height, low(s), high(s));
  }

  // Slices in which the integrand is smooth by t: between the corners, the points where faces meet
  // the section's edges on the plane or on the graph, and those where a slice touches such a curve.
  [[nodiscard]] Breaks<64> slice_bounds() const {
    double least = section_.edge(0).from.t;
    double most = least;
    for (std::size_t n = 1; n < section_.corners(); ++n) {
      least = std::min(least, section_.edge(n).from.t);
      most = std::max(most, section_.edge(n).from.t);
    }
    Breaks<64> bounds(least, most);
    for (std::size_t n = 0; n < section_.corners(); ++n) {
      bounds.add(section_.edge(n).from.t);
    }
    for (const double face : {high_, low_}) {
      for (std::size_t n = 0; n < section_.corners(); ++n) {
        add_crossings(section_.edge(n), face, bounds);
      }
      for_each_root(st_ * st_ - 4.0 * ss_ * tt_, 2.0 * st_ * lean_,
                    lean_ * lean_ + 4.0 * ss_ * face, [&](double t) { bounds.add(t); });
    }
    return bounds;
  }

  void add_crossings(const PlaneSection::Edge& edge, double face, Breaks<64>& bounds) const {
    const auto& [from, to, side] = edge;
    const double along_s = to.s - from.s;
    const double along_t = to.t - from.t;
    const auto add = [&](double share) {
      if (share > 0.0 && share < 1.0) {
        bounds.add(from.t + share * along_t);
      }
    };
    if (std::abs(lean_ * along_s) > kNoCurve) {
      add((face / lean_ - from.s) / along_s);
    }
    for_each_root(apart(along_s, along_t),
                  2.0 * ss_ * from.s * along_s + st_ * (from.s * along_t + from.t * along_s) +
                      2.0 * tt_ * from.t * along_t + lean_ * along_s,
                  apart(from.s, from.t) - face + lean_ * from.s, add);
  }

  // The section's extent along a slice.
  [[nodiscard]] std::array<double, 2> extent(double t) const {
    double low = 1e9;
    double high = -1e9;
    for (std::size_t n = 0; n < section_.corners(); ++n) {
      const auto [from, to, side] = section_.edge(n);
      if ((from.t <= t) != (to.t <= t)) {
        const double s = from.s + (t - from.t) / (to.t - from.t) * (to.s - from.s);
        low = std::min(low, s);
        high = std::max(high, s);
      }
    }
    return {low, high};
  }

  void add_slice(double t, double weight, double& volume, PlanePolynomial<2>::Terms& slopes) const {
    const auto [least, most] = extent(t);
    if (!(most > least)) {
      return;
    }
    Breaks<8> breaks(least, most);
    for (const double face : {high_, low_}) {
      if (std::abs(lean_) > kLevel) {
        breaks.add(face / lean_);
      }
      for_each_root(ss_, st_ * t + lean_, tt_ * t * t - face, [&](double s) { breaks.add(s); });
    }
    breaks.for_each_piece([&](double from, double to) {
      for (const GaussPoint& point : kGauss2) {
        const double s = from + point.at * (to - from);
        const double height = apart(s, t);
        const double area = point.weight * (to - from) * weight;
        volume += area * (between_faces(height, s) - between_faces(0.0, s));
        if (height > low(s) && height < high(s)) {
          const auto terms = PlanePolynomial<2>::terms(plane_.xi + cosine_ * s - sine_ * t,
                                                       plane_.eta + sine_ * s + cosine_ * t);
          for (std::size_t n = 0; n < slopes.size(); ++n) {
            slopes[n] += area * terms[n];
          }
        }
      }
    });
  }

  const PlaneGraph<2>& graph_;
  const TangentPlane<2>& plane_;
  double cosine_;
  double sine_;
  PlaneInSpace turned_;
  PlaneSection section_;
  double ss_ = 0.0;  // of the graph over the plane: coefficients of s², s t and t²
  double st_ = 0.0;
  double tt_ = 0.0;
  double lean_ = 0.0;  // by which the faces come nearer to the plane along s
  double high_ = 0.0;
  double low_ = 0.0;
};

}  // namespace

bool add_grazing_share(const PlaneGraph<2>& graph, const TangentPlane<2>& plane, const Vec3& size,
                       double& volume, PlanePolynomial<2>::Terms& slopes) {
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    axis = std::abs(graph.frame[2][other]) > std::abs(graph.frame[2][axis]) ? other : axis;
  }
  const double slope = plane.slopes[axis];
  if (!(slope < kGrazing)) {
    return false;
  }
  const GrazedCell cell(graph, plane, size, axis, slope);
  if (cell.is_empty()) {
    volume = 0.0;
    slopes = {};
    return true;
  }
  if (!cell.meets_a_face()) {
    return false;
  }
  cell.integrate(volume, slopes);
  return true;
}

}  // namespace difmesh::detail
