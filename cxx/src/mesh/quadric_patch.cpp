#include "mesh/quadric_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

// Turns of the frame. Each leaves about (curvature x size of the neighbourhood)² of the last one's
// angle: three or four do on what deserves the name of a surface.
constexpr int kMostFits = 16;
constexpr double kStill = 1e-12;
// A frame that has turned by more than 60 degrees has lost the surface.
constexpr double kFarthestTurn = 0.5;
// A column that the ones before it explain to so small a share, squared, is not determined.
constexpr double kLeastPivot = 1e-10;
// Weights are (1 - r²/(kReach r_max²))².
constexpr double kReach = 1.1;

constexpr std::size_t kTerms = 6;  // 1, x, y, x², xy, y²
using Terms = std::array<double, kTerms>;

/// An orthonormal frame about a unit vector.
struct Frame {
  Vec3 x, y, z;
  explicit Frame(const Vec3& normal) : z(normal) {
    const std::size_t least = std::abs(z[0]) <= std::abs(z[1])
                                  ? (std::abs(z[0]) <= std::abs(z[2]) ? 0U : 2U)
                                  : (std::abs(z[1]) <= std::abs(z[2]) ? 1U : 2U);
    Vec3 helper{0.0, 0.0, 0.0};
    helper[least] = 1.0;
    x = unit(cross(helper, z));
    y = cross(z, x);
  }
};

/// Sums over the points of w x^i y^j, and of w z times the terms: the normal equations.
struct Moments {
  std::array<double, 15> of{};  // 1 | x y | xx xy yy | xxx xxy xyy yyy | x4 x3y xxyy xy3 y4
  Terms right{};

  void add(double x, double y, double z, double w) {
    const Terms terms{w, w * x, w * y, w * x * x, w * x * y, w * y * y};
    for (std::size_t i = 0; i < kTerms; ++i) {
      of[i] += terms[i];
      right[i] += terms[i] * z;
    }
    const double xx = x * x;
    const double yy = y * y;
    of[6] += terms[3] * x;
    of[7] += terms[3] * y;
    of[8] += terms[5] * x;
    of[9] += terms[5] * y;
    of[10] += terms[3] * xx;
    of[11] += terms[4] * xx;
    of[12] += terms[3] * yy;
    of[13] += terms[4] * yy;
    of[14] += terms[5] * yy;
  }
};

// Which moment stands in row i, column j <= i of the normal equations.
constexpr std::array<std::array<std::size_t, kTerms>, kTerms> kMoment{
    {{0}, {1, 3}, {2, 4, 5}, {3, 6, 7, 10}, {4, 7, 8, 11, 12}, {5, 8, 9, 12, 13, 14}}};

/// Solves the normal equations by L D Lᵀ. \return false if the points do not determine a patch
bool solve(const Moments& moments, Terms& c) {
  std::array<Terms, kTerms> low{};  // L below the diagonal
  Terms pivot{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    double left = moments.of[kMoment[i][i]];
    const double least = kLeastPivot * left;
    for (std::size_t j = 0; j < i; ++j) {
      double sum = moments.of[kMoment[i][j]];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= low[i][k] * low[j][k] * pivot[k];
      }
      low[i][j] = sum / pivot[j];
      left -= low[i][j] * sum;
    }
    if (!(left > least)) {
      return false;
    }
    pivot[i] = left;
  }
  c = moments.right;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      c[i] -= low[i][k] * c[k];
    }
  }
  for (std::size_t i = kTerms; i-- > 0;) {
    c[i] /= pivot[i];
    for (std::size_t k = i + 1; k < kTerms; ++k) {
      c[i] -= low[k][i] * c[k];
    }
  }
  return true;
}

bool fit_in_frame(std::span<const PatchPoint> points, const Frame& frame, Terms& c) {
  Moments moments;
  for (const PatchPoint& point : points) {
    moments.add(dot(point.at, frame.x), dot(point.at, frame.y), dot(point.at, frame.z),
                point.weight);
  }
  return solve(moments, c);
}

/// Curvatures of the graph of h at x = y = 0, from its fundamental forms. Written so that the
/// difference of the principal curvatures is a sum of squares: it does not cancel where they agree.
PatchFit graph_curvature(const Terms& c) {
  const double e = 1.0 + c[1] * c[1];
  const double f = c[1] * c[2];
  const double g = 1.0 + c[2] * c[2];
  const double area2 = 1.0 + c[1] * c[1] + c[2] * c[2];
  const double bend = -1.0 / (2.0 * area2 * std::sqrt(area2));
  const double l = 2.0 * c[3];
  const double m = c[4];
  const double n = 2.0 * c[5];
  const double twist = (e * m - f * l) / e;
  const double stretch = e * n - g * l - 2.0 * f * twist;
  return {bend * (e * n - 2.0 * f * m + g * l),
          -bend * std::sqrt(stretch * stretch + 4.0 * area2 * twist * twist),
          0.0,
          {},
          true};
}

}  // namespace

void PatchPoints::assign(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices) {
  points_.resize(vertices.size());
  const Vec3& centre = positions[vertices[0]];
  unit_ = 0.0;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    points_[n].at = minus(positions[vertices[n]], centre);
    for (const double component : points_[n].at) {
      unit_ = std::max(unit_, std::abs(component));
    }
  }
  double farthest = 0.0;
  for (PatchPoint& point : points_) {
    for (double& component : point.at) {
      component /= unit_;
    }
    point.weight = dot(point.at, point.at);
    farthest = std::max(farthest, point.weight);
  }
  for (PatchPoint& point : points_) {
    const double near = 1.0 - point.weight / (kReach * farthest);
    point.weight = near * near;
  }
}

PatchFit fit_patch(std::span<const PatchPoint> points, const Vec3& normal) {
  Vec3 axis = normal;
  PatchFit fitted;
  for (int fit = 0; fit < kMostFits; ++fit) {
    const Frame frame(axis);
    Terms c{};
    if (!fit_in_frame(points, frame, c)) {
      break;
    }
    fitted = graph_curvature(c);
    fitted.height = c[0];
    fitted.axis = axis;
    if (std::abs(c[1]) <= kStill && std::abs(c[2]) <= kStill) {
      break;
    }
    axis = unit(minus(frame.z, plus(scaled(frame.x, c[1]), scaled(frame.y, c[2]))));
    if (!(dot(axis, normal) > kFarthestTurn)) {
      break;
    }
  }
  return fitted;
}

}  // namespace difmesh::detail
