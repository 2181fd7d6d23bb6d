#include "curved/local_surface.hpp"

#include <algorithm>

namespace difmesh::detail {
namespace {

// A polynomial of one coordinate and its first two derivatives, by Horner.
struct LineJet {
  double value;
  double first;
  double second;
};

LineJet along(const double (&c)[5], double x) {
  return {c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4]))),
          c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * 4.0 * c[4])),
          2.0 * c[2] + x * (6.0 * c[3] + x * 12.0 * c[4])};
}

}  // namespace

double value_of(const Coefficients& coefficients, double xi, double eta) {
  double value = 0.0;
  for (std::size_t p = 5; p-- > 0;) {
    const double* const c = &coefficients[power(p, 0)];
    value = value * xi + (c[0] + eta * (c[1] + eta * (c[2] + eta * (c[3] + eta * c[4]))));
  }
  return value;
}

GraphJet jet_of(const Coefficients& coefficients, double xi, double eta) {
  double values[5];
  double firsts[5];
  double seconds[5];
  for (std::size_t p = 0; p < 5; ++p) {
    double row[5];
    std::copy_n(&coefficients[power(p, 0)], 5, row);
    const LineJet jet = along(row, eta);
    values[p] = jet.value;
    firsts[p] = jet.first;
    seconds[p] = jet.second;
  }
  const LineJet value = along(values, xi);
  const LineJet first = along(firsts, xi);
  const LineJet second = along(seconds, xi);
  return {value.value, value.first, first.value, value.second, first.first, second.value};
}

void FunctionJet::add(const FunctionJet& other, double weight) {
  value += weight * other.value;
  for (std::size_t a = 0; a < 3; ++a) {
    gradient[a] += weight * other.gradient[a];
    for (std::size_t b = 0; b < 3; ++b) {
      hessian[a][b] += weight * other.hessian[a][b];
    }
  }
}

FunctionJet Graph::jet(const Vec3& x) const {
  const auto& [xi, eta, zeta] = frame;
  const GraphJet q = jet_of(coefficients, dot(xi, x), dot(eta, x));
  FunctionJet result;
  result.value = (dot(zeta, x) - q.value) * scale;
  for (std::size_t a = 0; a < 3; ++a) {
    result.gradient[a] = (zeta[a] - q.by_xi * xi[a] - q.by_eta * eta[a]) * scale;
    for (std::size_t b = 0; b < 3; ++b) {
      result.hessian[a][b] =
          -(q.by_xi_xi * xi[a] * xi[b] + q.by_xi_eta * (xi[a] * eta[b] + eta[a] * xi[b]) +
            q.by_eta_eta * eta[a] * eta[b]) *
          scale;
    }
  }
  return result;
}

double LocalSurface::function(const Vec3& x) const {
  double sum = 0.0;
  for (int n = 0; n < count; ++n) {
    sum += graphs[static_cast<std::size_t>(n)].function(x);
  }
  return sum / count;
}

FunctionJet LocalSurface::jet(const Vec3& x) const {
  if (count == 1) {
    return graphs[0].jet(x);
  }
  FunctionJet sum;
  for (int n = 0; n < count; ++n) {
    sum.add(graphs[static_cast<std::size_t>(n)].jet(x), 1.0 / count);
  }
  return sum;
}

LevelCurvature curvature_of(const FunctionJet& jet) {
  const Vec3& g = jet.gradient;
  const auto& h = jet.hessian;
  const double square = squared_length(g);
  const double trace = h[0][0] + h[1][1] + h[2][2];
  double along = 0.0;
  double adjugate = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      const std::size_t a1 = (a + 1) % 3;
      const std::size_t a2 = (a + 2) % 3;
      const std::size_t b1 = (b + 1) % 3;
      const std::size_t b2 = (b + 2) % 3;
      along += g[a] * h[a][b] * g[b];
      adjugate += g[a] * g[b] * (h[a1][b1] * h[a2][b2] - h[a1][b2] * h[a2][b1]);
    }
  }
  return {(square * trace - along) / (2.0 * square * std::sqrt(square)),
          adjugate / (square * square)};
}

double LevelCurvature::spread() const {
  return std::sqrt(std::max(0.0, mean * mean - gaussian));
}

}  // namespace difmesh::detail
