#include "curved/height_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "planes/cube_fraction.hpp"

namespace difmesh::detail {
namespace {

// By how much fractions may rise from the material outwards.
constexpr double kRise = 1e-9;
// How well the tangent planes must explain the cells around.
constexpr double kExplained = 0.03;

/// Columns along an axis, from the material's side outwards.
class Columns {
 public:
  Columns(const Neighbourhood& cells, std::size_t axis, int sense, std::int64_t reach)
      : cells_(cells), axis_(axis), sense_(sense), reach_(reach) {}

  /// Height over the centre of the middle cell of the column at (a, b) steps across, in widths of
  /// the middle cell; none where it is inconsistent within the reach.
  [[nodiscard]] std::optional<double> height(std::int64_t a, std::int64_t b) const {
    Index3 foot{0, 0, 0};
    foot[(axis_ + 1) % 3] = a;
    foot[(axis_ + 2) % 3] = b;
    const std::optional<std::int64_t> full = first_full(foot);
    const std::optional<std::int64_t> empty = full ? first_empty(foot, *full) : std::nullopt;
    if (!empty) {
      return std::nullopt;
    }
    double height = sense_ * cells_.centre(axis_, sense_ * *full) - 0.5 * width(*full);
    for (std::int64_t level = *full; level <= *empty; ++level) {
      height += width(level) * *fraction(foot, level);
    }
    return height;
  }

  /// Fraction of a cell, or none beyond an open side.
  [[nodiscard]] std::optional<double> fraction(Index3 steps, std::int64_t level) const {
    steps[axis_] = sense_ * level;
    return cells_.is_there(steps) ? std::optional(cells_.fraction(steps)) : std::nullopt;
  }
  [[nodiscard]] double width(std::int64_t level) const {
    return cells_.width(axis_, sense_ * level);
  }

 private:
  // The full cell next to the surface, seen from the middle cell's level.
  [[nodiscard]] std::optional<std::int64_t> first_full(const Index3& foot) const {
    const double full = 1.0 - cells_.purity_tolerance();
    std::optional<double> value = fraction(foot, 0);
    if (!value) {
      return std::nullopt;
    }
    if (*value >= full) {
      for (std::int64_t level = 1; level <= reach_; ++level) {
        value = fraction(foot, level);
        if (!value) {
          return std::nullopt;
        }
        if (*value < full) {
          return level - 1;
        }
      }
      return std::nullopt;
    }
    double before = *value;
    for (std::int64_t level = -1; level >= -reach_; --level) {
      value = fraction(foot, level);
      if (!value || *value < before - kRise) {
        return std::nullopt;
      }
      if (*value >= full) {
        return level;
      }
      before = *value;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<std::int64_t> first_empty(const Index3& foot,
                                                        std::int64_t full) const {
    double before = 1.0;
    for (std::int64_t level = full + 1; level <= reach_; ++level) {
      const std::optional<double> value = fraction(foot, level);
      if (!value || *value > before + kRise) {
        return std::nullopt;
      }
      if (*value <= cells_.purity_tolerance()) {
        return level;
      }
      before = *value;
    }
    return std::nullopt;
  }

  const Neighbourhood& cells_;
  std::size_t axis_;
  int sense_;
  std::int64_t reach_;
};

/// Heights by steps across, -2 to 2.
class Heights {
 public:
  [[nodiscard]] double at(int a, int b) const {
    return values_[static_cast<std::size_t>(a + 2)][static_cast<std::size_t>(b + 2)];
  }
  /// False where one of the columns asked for is inconsistent.
  bool fill(const Columns& columns, bool is_biquartic) {
    for (int ring = 0; ring <= 2; ++ring) {  // inconsistent columns are found early
      for (int a = -2; a <= 2; ++a) {
        for (int b = -2; b <= 2; ++b) {
          const bool is_asked = is_biquartic || std::abs(a) + std::abs(b) <= 2;
          if (!is_asked || std::max(std::abs(a), std::abs(b)) != ring) {
            continue;
          }
          const std::optional<double> height = columns.height(a, b);
          if (!height) {
            return false;
          }
          values_[static_cast<std::size_t>(a + 2)][static_cast<std::size_t>(b + 2)] = *height;
        }
      }
    }
    return true;
  }

 private:
  std::array<std::array<double, 5>, 5> values_{};
};

// The coefficients of u^p v^q, p and q up to the fourth, of a product of two polynomials' weights.
Coefficients biquartic(const Heights& heights, const AxisAverages& u, const AxisAverages& v) {
  Coefficients result{};
  for (std::size_t p = 0; p < 5; ++p) {
    double along_v[5];
    for (int b = -2; b <= 2; ++b) {
      double sum = 0.0;
      for (int a = -2; a <= 2; ++a) {
        sum += u.quartic(p, a) * heights.at(a, b);
      }
      along_v[b + 2] = sum;
    }
    for (std::size_t q = 0; q < 5; ++q) {
      for (int b = -2; b <= 2; ++b) {
        result[power(p, q)] += v.quartic(q, b) * along_v[b + 2];
      }
    }
  }
  return result;
}

// Of 1 and the products of u, u², v and v²: the biquadratic through the nine columns in the middle.
double biquadratic(const Heights& heights, const AxisAverages& u, const AxisAverages& v,
                   std::size_t p, std::size_t q) {
  double sum = 0.0;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      sum += u.quadratic(p, a) * v.quadratic(q, b) * heights.at(a, b);
    }
  }
  return sum;
}

// A quartic along u, one along v, and the products of first and second powers. These products are
// the biquadratic's: what distinguishes them are differences of differences of heights, of which
// powers of u or v alone leave nothing.
Coefficients cross_quartic(const Heights& heights, const AxisAverages& u, const AxisAverages& v) {
  Coefficients result{};
  const auto products = [&](int a, int b) {  // averaged over a column
    double sum = 0.0;
    for (std::size_t p = 1; p <= 2; ++p) {
      for (std::size_t q = 1; q <= 2; ++q) {
        sum += result[power(p, q)] * u.average(p, a) * v.average(q, b);
      }
    }
    return sum;
  };
  for (std::size_t p = 1; p <= 2; ++p) {
    for (std::size_t q = 1; q <= 2; ++q) {
      result[power(p, q)] = biquadratic(heights, u, v, p, q);
    }
  }
  double constant = 0.0;  // and what powers of v alone have on average over the middle columns
  for (int step = -2; step <= 2; ++step) {
    const double along_u = heights.at(step, 0) - products(step, 0);
    const double along_v = heights.at(0, step) - products(0, step);
    constant += u.quartic(0, step) * along_u;
    for (std::size_t m = 1; m < 5; ++m) {
      result[power(m, 0)] += u.quartic(m, step) * along_u;
      result[power(0, m)] += v.quartic(m, step) * along_v;
    }
  }
  for (std::size_t m = 1; m < 5; ++m) {
    constant -= result[power(0, m)] * v.average(m, 0);
  }
  result[power(0, 0)] = constant;
  return result;
}

/// One surface in the making: coordinates in widths of the middle cell along each axis.
class HeightSurface {
 public:
  HeightSurface(const Neighbourhood& cells, std::size_t axis, int sense, const HeightRule& rule)
      : cells_(cells),
        axis_(axis),
        sense_(sense),
        rule_(rule),
        columns_(cells, axis, sense, rule.reach) {}

  [[nodiscard]] std::optional<Graph> make() {
    if (!heights_.fill(columns_, rule_.is_biquartic)) {
      return std::nullopt;
    }
    const AxisAverages& u = cells_.averages(along(1));
    const AxisAverages& v = cells_.averages(along(2));
    coefficients_ = rule_.is_biquartic ? biquartic(heights_, u, v) : cross_quartic(heights_, u, v);
    Graph graph = in_space();
    const double slope =
        std::max(std::abs(coefficients_[power(1, 0)]), std::abs(coefficients_[power(0, 1)]));
    const double apart = std::abs(coefficients_[0] - biquadratic(heights_, u, v, 0, 0)) *
                         cells_.size()[axis_] * graph.scale;
    if (!(slope <= rule_.steep) && !(apart <= rule_.most_apart)) {
      return std::nullopt;
    }
    graph.residual = unexplained();
    return graph.residual <= kExplained ? std::optional(graph) : std::nullopt;
  }

 private:
  [[nodiscard]] std::size_t along(std::size_t turn) const { return (axis_ + turn) % 3; }

  [[nodiscard]] Graph in_space() const {
    const Vec3& size = cells_.size();
    Graph graph;
    graph.frame = {};
    graph.frame[0][along(1)] = 1.0;
    graph.frame[1][along(2)] = 1.0;
    graph.frame[2][axis_] = sense_;
    double scale_p = size[axis_];
    for (std::size_t p = 0; p < 5; ++p) {
      double scale = scale_p;
      for (std::size_t q = 0; q < 5; ++q) {
        graph.coefficients[power(p, q)] = coefficients_[power(p, q)] * scale;
        scale /= size[along(2)];
      }
      scale_p /= size[along(1)];
    }
    graph.normalise();
    return graph;
  }

  // The largest difference of the 27 cells' fractions from those of the planes that touch the graph
  // over the columns' middles, with the columns' heights.
  [[nodiscard]] double unexplained() const {
    double most = 0.0;
    for (int a = -1; a <= 1; ++a) {
      for (int b = -1; b <= 1; ++b) {
        const GraphJet jet =
            jet_of(coefficients_, cells_.centre(along(1), a), cells_.centre(along(2), b));
        const double by_u = jet.by_xi * cells_.width(along(1), a);
        const double by_v = jet.by_eta * cells_.width(along(2), b);
        Index3 foot{0, 0, 0};
        foot[along(1)] = a;
        foot[along(2)] = b;
        for (std::int64_t level = -1; level <= 1; ++level) {
          const double above = heights_.at(a, b) - sense_ * cells_.centre(axis_, sense_ * level);
          const double share = cube_fraction(by_u, by_v, columns_.width(level), above);
          const std::optional<double> fraction = columns_.fraction(foot, level);
          if (!fraction || !(std::abs(share - *fraction) <= most)) {
            most = fraction ? std::abs(share - *fraction) : 1.0;
          }
        }
      }
    }
    return most;
  }

  const Neighbourhood& cells_;
  std::size_t axis_;
  int sense_;
  const HeightRule& rule_;
  Columns columns_;
  Heights heights_;
  Coefficients coefficients_{};
};

}  // namespace

std::optional<Graph> height_surface(const Neighbourhood& cells, std::size_t axis, int sense,
                                    const HeightRule& rule) {
  return HeightSurface(cells, axis, sense, rule).make();
}

}  // namespace difmesh::detail
