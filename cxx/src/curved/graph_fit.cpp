#include "curved/graph_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "curved/graph_share.hpp"
#include "planes/cube_fraction.hpp"

namespace difmesh::detail {
namespace {

constexpr int kCandidateReach = 2;  // cells that may have a weight
constexpr double kDiverged = 3.0;   // a change of coefficients as large as that
constexpr double kSettled = 1e-4;   // and as small as that, if more would remain unexplained
constexpr double kExact = 1e-8;     // and as small as that, where nothing would
constexpr double kHopeless = 0.3;   // unexplained after two steps
constexpr double kRidge = 1e-13;    // of the mean of the diagonal, against singular equations

/// Where weights end, in cells, how well cells must be explained, and in how many steps.
struct FitRule {
  double radius;
  double most_unexplained;
  int steps;
};
template <int kDegree>
FitRule rule_for(bool is_cut_short) {
  if (kDegree == 4) {
    return {3.2, 0.02, 7};
  }
  return is_cut_short ? FitRule{3.1, 0.03, 20} : FitRule{2.1, 0.03, 7};
}

struct Candidate {
  Box box;
  double fraction;
};

// Solves for x in A x = b, A symmetric and given by its lower triangle; false where A is not
// positive definite. `size` of the equations count.
template <std::size_t kSize>
bool solve(std::array<std::array<double, kSize>, kSize>& a, std::array<double, kSize>& b,
           std::size_t size) {
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      double sum = a[row][column];
      for (std::size_t n = 0; n < column; ++n) {
        sum -= a[row][n] * a[column][n];
      }
      if (column < row) {
        a[row][column] = sum / a[column][column];
      } else if (sum > 0.0) {
        a[row][row] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t n = 0; n < row; ++n) {
      b[row] -= a[row][n] * b[n];
    }
    b[row] /= a[row][row];
  }
  for (std::size_t row = size; row-- > 0;) {
    for (std::size_t n = row + 1; n < size; ++n) {
      b[row] -= a[n][row] * b[n];
    }
    b[row] /= a[row][row];
  }
  return true;
}

template <int kDegree>
class GraphFit {
 public:
  explicit GraphFit(const Neighbourhood& cells) : cells_(cells), rule_(gather()) {}

  std::optional<Graph> run(const Vec3& m) {
    start(m);
    for (int step = 0; step < rule_.steps; ++step) {
      const std::optional<double> change = improve(step);
      if (!change) {
        return std::nullopt;
      }
      if (step < 2) {
        align(step == 1);
        if (!is_near()) {
          return std::nullopt;
        }
      } else if (unexplained_ > kHopeless) {
        return std::nullopt;
      } else if (is_settled(*change)) {
        break;
      }
    }
    if (!(unexplained_ <= rule_.most_unexplained)) {
      return std::nullopt;
    }
    Graph result;
    result.frame = graph_.frame;
    result.coefficients = graph_.polynomial.coefficients();
    result.residual = unexplained_;
    result.normalise();
    return result;
  }

 private:
  static constexpr std::size_t kTerms = PlanePolynomial<kDegree>::kTerms;
  static constexpr std::size_t kMostCells = 125;

  // The cells that there are, and the box of those among the 27 around, with its fraction.
  FitRule gather() {
    constexpr int kReach = kCandidateReach;
    Vec3 low{9.0, 9.0, 9.0};
    Vec3 high{-9.0, -9.0, -9.0};
    double volume = 0.0;
    double filled = 0.0;
    bool is_cut_short = false;
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(kMostCells); ++n) {
      const Index3 steps{n % 5 - kReach, n / 5 % 5 - kReach, n / 25 - kReach};
      const bool is_next =
          std::abs(steps[0]) < 2 && std::abs(steps[1]) < 2 && std::abs(steps[2]) < 2;
      if (!cells_.is_there(steps)) {
        is_cut_short = is_cut_short || is_next;
        continue;
      }
      Candidate& candidate = candidates_[count_++];
      candidate.fraction = cells_.fraction(steps);
      double own_volume = 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double size = cells_.size()[axis];
        candidate.box.centre[axis] = cells_.centre(axis, steps[axis]) * size;
        candidate.box.size[axis] = cells_.width(axis, steps[axis]) * size;
        own_volume *= candidate.box.size[axis];
        if (is_next) {
          const double half = 0.5 * candidate.box.size[axis];
          low[axis] = std::min(low[axis], candidate.box.centre[axis] - half);
          high[axis] = std::max(high[axis], candidate.box.centre[axis] + half);
        }
      }
      volume += is_next ? own_volume : 0.0;
      filled += is_next ? own_volume * candidate.fraction : 0.0;
    }
    around_ = {scaled(plus(low, high), 0.5), minus(high, low)};
    share_around_ = filled / volume;
    return rule_for<kDegree>(is_cut_short);
  }

  // The plane with this normal that gives the cells around their mean fraction.
  void start(const Vec3& m) {
    Vec3& normal = graph_.frame[2];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[axis] = m[axis] / cells_.size()[axis];
    }
    normal = unit(normal);
    std::size_t least = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      least = std::abs(normal[axis]) < std::abs(normal[least]) ? axis : least;
    }
    Vec3 across{0.0, 0.0, 0.0};
    across[least] = 1.0;
    set_across(across);
    graph_.polynomial.c[0] = cube_offset(normal[0] * around_.size[0], normal[1] * around_.size[1],
                                         normal[2] * around_.size[2], share_around_) +
                             dot(normal, around_.centre);
  }

  // ξ along a direction as far as it is across ζ, and η across both.
  void set_across(const Vec3& direction) {
    auto& [xi, eta, zeta] = graph_.frame;
    xi = unit(minus(direction, scaled(zeta, dot(direction, zeta))));
    eta = cross(zeta, xi);
  }

  // One step of Gauss and Newton: first for a plane, then for all coefficients. Returns the largest
  // change of a coefficient.
  std::optional<double> improve(int step) {
    std::array<std::array<double, kTerms>, kTerms> matrix{};
    std::array<double, kTerms> right{};
    std::size_t used = 0;
    unexplained_ = 0.0;
    for (std::size_t n = 0; n < count_; ++n) {
      const Candidate& candidate = candidates_[n];
      const double weight = weight_of(candidate.box);
      if (!(weight > 0.0)) {
        continue;
      }
      const GraphShare<kDegree> share = share_below(graph_, candidate.box, step > 0);
      const double residual = candidate.fraction - share.share;
      unexplained_ = std::max(unexplained_, std::abs(residual) * weight);
      if (share.is_pure) {
        continue;
      }
      ++used;
      for (std::size_t row = 0; row < kTerms; ++row) {
        const double weighted = weight * share.slopes[row];
        right[row] += weighted * residual;
        for (std::size_t column = 0; column <= row; ++column) {
          matrix[row][column] += weighted * share.slopes[column];
        }
      }
    }
    const std::size_t terms = terms_for(step, used);
    double trace = 0.0;
    for (std::size_t row = 0; row < terms; ++row) {
      trace += matrix[row][row];
    }
    for (std::size_t row = 0; row < terms; ++row) {
      matrix[row][row] += kRidge * trace / static_cast<double>(terms);
    }
    if (used < terms || !solve(matrix, right, terms)) {
      return std::nullopt;
    }
    double change = 0.0;
    for (std::size_t row = 0; row < terms; ++row) {
      graph_.polynomial.c[row] += right[row];
      change = std::max(change, std::abs(right[row]));
    }
    return change < kDiverged ? std::optional(change) : std::nullopt;
  }

  // Coefficients that a step is for. Where open sides leave few cells, paraboloids stay planes.
  [[nodiscard]] static std::size_t terms_for(int step, std::size_t used) {
    if (step == 0 || (kDegree == 2 && used < 6)) {
      return 3;
    }
    return step == 1 ? 6 : kTerms;
  }

  // By the distance from the point of the surface that is over the centre, in cells.
  [[nodiscard]] double weight_of(const Box& box) const {
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double away =
          (box.centre[axis] - graph_.polynomial.c[0] * graph_.frame[2][axis]) / cells_.size()[axis];
      square += away * away;
    }
    const double root = std::max(0.0, 1.0 - square / (rule_.radius * rule_.radius));
    return root * root;
  }

  // Turns ζ to the graph's normal over the centre, and starts from a plane, or with the second
  // powers that there are.
  void align(bool keeps_second_powers) {
    auto& c = graph_.polynomial.c;
    auto& [xi, eta, zeta] = graph_.frame;
    const double length = std::sqrt(1.0 + c[1] * c[1] + c[2] * c[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      zeta[axis] = (zeta[axis] - c[1] * xi[axis] - c[2] * eta[axis]) / length;
    }
    set_across(xi);
    c[0] /= length;
    c[1] = 0.0;
    c[2] = 0.0;
    std::fill(c.begin() + (keeps_second_powers ? 6 : 3), c.end(), 0.0);
  }

  // Of what is unexplained before a step, some of the step's size goes by it; planes leave nothing.
  [[nodiscard]] bool is_settled(double change) const {
    return change < kExact || (change < kSettled && unexplained_ > 10.0 * change);
  }

  [[nodiscard]] bool is_near() const {
    double away = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      away = std::max(
          away, std::abs(graph_.polynomial.c[0] * graph_.frame[2][axis]) / cells_.size()[axis]);
    }
    return away <= kMostAway;
  }

  const Neighbourhood& cells_;
  std::array<Candidate, kMostCells> candidates_;
  std::size_t count_ = 0;
  Box around_{};
  double share_around_ = 0.0;
  FitRule rule_;
  PlaneGraph<kDegree> graph_;
  double unexplained_ = 0.0;
};

}  // namespace

template <int kDegree>
std::optional<Graph> fitted_graph(const Neighbourhood& cells, const Vec3& m) {
  return GraphFit<kDegree>(cells).run(m);
}

template std::optional<Graph> fitted_graph<2>(const Neighbourhood&, const Vec3&);
template std::optional<Graph> fitted_graph<4>(const Neighbourhood&, const Vec3&);

}  // namespace difmesh::detail
