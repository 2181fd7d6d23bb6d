#pragma once
/// \file fractions.hpp
/// Fields of volume fractions of implicit shapes, to about 1e-12 for smooth ones.
///
/// A box's volume is an iterated integral: Gauss-Legendre along c and b of the length along a, all
/// limits found by root finding, in the way of R. I. Saye (SIAM J. Sci. Comput. 37, 2015). Bounds
/// by interval arithmetic make sure that f is monotone wherever a root is sought, so that none is
/// missed and every piece is smooth; where they cannot tell, the box is halved.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "support/box_clip.hpp"
#include "support/shapes.hpp"

namespace difmesh::test {

[[nodiscard]] inline Box cell_box(const Grid& grid, const Index3& low, const Index3& size) {
  Box box;
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = grid.origin[a] + static_cast<double>(low[a]) * grid.spacing[a];
    box.high[a] = grid.origin[a] + static_cast<double>(low[a] + size[a]) * grid.spacing[a];
  }
  return box;
}

[[nodiscard]] inline double volume(const Box& box) {
  const Vec3 size = subtract(box.high, box.low);
  return size[0] * size[1] * size[2];
}

/// Bounds of f over a box, or over a face, edge or point of one.
template <class Shape>
[[nodiscard]] Interval value_bounds(const Shape& shape, const Box& box) {
  Triple<Interval> x;
  Vec3 centre{};
  for (std::size_t a = 0; a < 3; ++a) {
    x[a] = {box.low[a], box.high[a]};
    centre[a] = 0.5 * (box.low[a] + box.high[a]);
  }
  const Triple<Interval> g = shape.gradient(x);
  double reach = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    reach += 0.5 * (box.high[a] - box.low[a]) * g[a].magnitude();
  }
  const double middle = shape.value(centre);
  const Interval direct = shape.value(x);
  return {std::max(direct.low, middle - reach), std::min(direct.high, middle + reach)};
}

template <class Shape>
class BoxQuadrature {
 public:
  explicit BoxQuadrature(const Shape& shape) : shape_(shape) {}

  /// Volume of the box inside the shape.
  [[nodiscard]] double inside(const Box& box, int depth = 0) const {
    const Interval f = value_bounds(shape_, box);
    if (!f.has_zero()) {
      return f.low > 0.0 ? 0.0 : volume(box);
    }
    if (depth == kDepth) {
      return linearised(box);
    }
    if (const auto plan = make_plan(box)) {
      return integrate(box, *plan);
    }
    Box first = box;
    Box second = box;
    const auto axis = static_cast<std::size_t>(depth % 3);
    first.high[axis] = second.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
    return inside(first, depth + 1) + inside(second, depth + 1);
  }

 private:
  static constexpr int kDepth = 36;      // 2^-12 of the box: what linearising misses is below 1e-15
  static constexpr double kSteep = 0.5;  // least share of the largest derivative along an axis
  static constexpr std::size_t kNodes = 7;
  static constexpr std::array<double, kNodes> kPlaces{
      -0.9491079123427585, -0.7415311855993945, -0.4058451513773972, 0.0,
      0.4058451513773972,  0.7415311855993945,  0.9491079123427585};
  static constexpr std::array<double, kNodes> kWeights{
      0.1294849661688697, 0.2797053914892766, 0.3818300505051189, 0.4179591836734694,
      0.3818300505051189, 0.2797053914892766, 0.1294849661688697};

  /// Axes of the iterated integral, a innermost, and the faces across a that the surface may cross.
  struct Plan {
    std::size_t a = 0;
    std::size_t b = 0;
    std::size_t c = 0;
    std::array<bool, 2> crossed{};
  };
  using Breaks = std::array<double, 6>;

  static Box face(const Box& box, std::size_t axis, std::size_t side) {
    Box flat = box;
    flat.low[axis] = flat.high[axis] = side == 0 ? box.low[axis] : box.high[axis];
    return flat;
  }

  /// Per axis: least over largest derivative over the box, in units of the box's sides. Axes along
  /// which the box is flat get 0.
  Vec3 steepness(const Box& box) const {
    Triple<Interval> x;
    for (std::size_t a = 0; a < 3; ++a) {
      x[a] = {box.low[a], box.high[a]};
    }
    const Triple<Interval> g = shape_.gradient(x);
    double largest = 0.0;
    Vec3 least{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double side = box.high[a] - box.low[a];
      largest = std::max(largest, side * g[a].magnitude());
      least[a] = side * g[a].mignitude();
    }
    return largest > 0.0 ? scaled(least, 1.0 / largest) : Vec3{0.0, 0.0, 0.0};
  }

  /// None where f is not steep enough along some axis of the box, of a face or of an edge.
  std::optional<Plan> make_plan(const Box& box) const {
    const Vec3 steep = steepness(box);
    Plan plan;
    plan.a = static_cast<std::size_t>(std::max_element(steep.begin(), steep.end()) - steep.begin());
    if (steep[plan.a] < kSteep) {
      return std::nullopt;
    }
    Vec3 on_faces{1.0, 1.0, 1.0};
    on_faces[plan.a] = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      const Box flat = face(box, plan.a, side);
      plan.crossed[side] = value_bounds(shape_, flat).has_zero();
      if (plan.crossed[side]) {
        const Vec3 on_face = steepness(flat);
        for (std::size_t k = 0; k < 3; ++k) {
          on_faces[k] = std::min(on_faces[k], on_face[k]);
        }
      }
    }
    plan.b = static_cast<std::size_t>(std::max_element(on_faces.begin(), on_faces.end()) -
                                      on_faces.begin());
    plan.c = 3 - plan.a - plan.b;
    if (on_faces[plan.b] < kSteep || !edges_are_monotone(box, plan)) {
      return std::nullopt;
    }
    return plan;
  }

  bool edges_are_monotone(const Box& box, const Plan& plan) const {
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t end = 0; end < 2 && plan.crossed[side]; ++end) {
        const Box edge = face(face(box, plan.a, side), plan.b, end);
        if (value_bounds(shape_, edge).has_zero() && steepness(edge)[plan.c] == 0.0) {
          return false;
        }
      }
    }
    return true;
  }

  double integrate(const Box& box, const Plan& plan) const {
    Breaks breaks{};
    std::size_t count = 0;
    breaks[count++] = box.low[plan.c];
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t end = 0; end < 2 && plan.crossed[side]; ++end) {
        Vec3 p = box.low;
        p[plan.a] = side == 0 ? box.low[plan.a] : box.high[plan.a];
        p[plan.b] = end == 0 ? box.low[plan.b] : box.high[plan.b];
        if (const auto place = root(p, plan.c, box)) {
          breaks[count++] = *place;
        }
      }
    }
    breaks[count++] = box.high[plan.c];
    return over_pieces(breaks, count, [&](double c) {
      Vec3 p = box.low;
      p[plan.c] = c;
      return slice(box, plan, p);
    });
  }

  /// Area inside across axis c at p[c].
  double slice(const Box& box, const Plan& plan, Vec3 p) const {
    Breaks breaks{};
    std::size_t count = 0;
    breaks[count++] = box.low[plan.b];
    for (std::size_t side = 0; side < 2; ++side) {
      p[plan.a] = side == 0 ? box.low[plan.a] : box.high[plan.a];
      if (plan.crossed[side]) {
        if (const auto place = root(p, plan.b, box)) {
          breaks[count++] = *place;
        }
      }
    }
    breaks[count++] = box.high[plan.b];
    return over_pieces(breaks, count, [&](double b) {
      p[plan.b] = b;
      return inside_length(p, plan.a, box);
    });
  }

  /// ∫ over the range of the breaks, piece by piece.
  template <class Function>
  static double over_pieces(Breaks& breaks, std::size_t count, Function&& function) {
    std::fill(breaks.begin() + static_cast<std::ptrdiff_t>(count), breaks.end(), breaks[count - 1]);
    std::sort(breaks.begin(), breaks.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double half = 0.5 * (breaks[i + 1] - breaks[i]);
      if (half > 0.0) {
        for (std::size_t n = 0; n < kNodes; ++n) {
          sum += half * kWeights[n] * function(breaks[i] + half * (1.0 + kPlaces[n]));
        }
      }
    }
    return sum;
  }

  /// Length inside along the axis through p. \pre f is monotone there.
  double inside_length(Vec3 p, std::size_t axis, const Box& box) const {
    p[axis] = box.low[axis];
    const bool low_in = shape_.value(p) < 0.0;
    if (const auto place = root(p, axis, box)) {
      return low_in ? *place - box.low[axis] : box.high[axis] - *place;
    }
    return low_in ? box.high[axis] - box.low[axis] : 0.0;
  }

  /// Where f changes sign along the axis through p, by Newton's method kept in a bracket.
  std::optional<double> root(Vec3 p, std::size_t axis, const Box& box) const {
    double low = box.low[axis];
    double high = box.high[axis];
    const double precision = 1e-15 * (high - low);
    p[axis] = low;
    const double f_low = shape_.value(p);
    p[axis] = high;
    const double f_high = shape_.value(p);
    if ((f_low < 0.0) == (f_high < 0.0)) {
      return std::nullopt;
    }
    double x = low + (high - low) * (f_low / (f_low - f_high));
    for (int step = 0; step < 60; ++step) {
      p[axis] = x;
      const double f = shape_.value(p);
      ((f < 0.0) == (f_low < 0.0) ? low : high) = x;
      double next = x - f / shape_.gradient(p)[axis];
      if (!(next >= low && next <= high)) {
        next = 0.5 * (low + high);
      }
      const double moved = std::abs(next - x);
      x = next;
      if (moved <= precision) {
        break;
      }
    }
    return x;
  }

  double linearised(const Box& box) const {
    const Vec3 centre = scaled(add(box.low, box.high), 0.5);
    const Vec3 g = shape_.gradient(centre);
    const double f = shape_.value(centre);
    if (dot(g, g) == 0.0) {
      return f < 0.0 ? volume(box) : 0.0;
    }
    return volume(box) * static_cast<double>(clipped_share(subtract(box.high, box.low), g, -f));
  }

  const Shape& shape_;
};

/// Share of a box inside a shape, in [0,1].
template <class Shape>
[[nodiscard]] double inside_share(const Shape& shape, const Box& box) {
  return std::clamp(BoxQuadrature<Shape>(shape).inside(box) / volume(box), 0.0, 1.0);
}
[[nodiscard]] inline double inside_share(const HalfSpace& half_space, const Box& box) {
  return static_cast<double>(clipped_share(box, half_space.normal, half_space.level));
}

/// Fractions of all cells of a grid, x fastest. Blocks of cells that the surface misses are filled
/// without a look at their cells.
template <class Shape>
class FieldMaker {
 public:
  FieldMaker(const Shape& shape, const Grid& grid) : shape_(shape), grid_(grid) {}

  [[nodiscard]] std::vector<double> make() {
    cells_.assign(static_cast<std::size_t>(grid_.cell_count()), 0.0);
    fill({0, 0, 0}, grid_.dims);
    return std::move(cells_);
  }

 private:
  void fill(const Index3& low, const Index3& size) {
    const Box box = cell_box(grid_, low, size);
    const Interval f = value_bounds(shape_, box);
    if (!f.has_zero()) {
      set(low, size, f.low > 0.0 ? 0.0 : 1.0);
      return;
    }
    const auto longest =
        static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    if (size[longest] == 1) {
      set(low, size, inside_share(shape_, box));
      return;
    }
    Index3 first = size;
    Index3 rest = size;
    Index3 middle = low;
    first[longest] = size[longest] / 2;
    rest[longest] = size[longest] - first[longest];
    middle[longest] += first[longest];
    fill(low, first);
    fill(middle, rest);
  }

  void set(const Index3& low, const Index3& size, double fraction) {
    for (std::int64_t k = low[2]; k < low[2] + size[2]; ++k) {
      for (std::int64_t j = low[1]; j < low[1] + size[1]; ++j) {
        const auto row = static_cast<std::ptrdiff_t>((k * grid_.dims[1] + j) * grid_.dims[0]);
        std::fill_n(cells_.begin() + row + low[0], size[0], fraction);
      }
    }
  }

  const Shape& shape_;
  const Grid& grid_;
  std::vector<double> cells_;
};

template <class Shape>
[[nodiscard]] std::vector<double> cell_fractions(const Shape& shape, const Grid& grid) {
  return FieldMaker<Shape>(shape, grid).make();
}

}  // namespace difmesh::test
