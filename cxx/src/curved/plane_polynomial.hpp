#pragma once
// Polynomials of two coordinates by total degree, as fits have them.

#include <array>
#include <cstddef>

#include "curved/local_surface.hpp"

namespace difmesh::detail {

/// Products of powers of ξ and η up to a total degree: 1, ξ, η, ξ², ξη, η², ...
template <int kDegree>
struct PlanePolynomial {
  static constexpr std::size_t kTerms = (kDegree + 1) * (kDegree + 2) / 2;
  using Terms = std::array<double, kTerms>;

  Terms c{};

  [[nodiscard]] static Terms terms(double xi, double eta) {
    Terms result;
    result[0] = 1.0;
    std::size_t n = 1;
    for (int degree = 1; degree <= kDegree; ++degree) {
      const std::size_t before = n - static_cast<std::size_t>(degree);  // where the last one begins
      for (int m = 0; m < degree; ++m) {
        result[n] = xi * result[before + static_cast<std::size_t>(m)];
        ++n;
      }
      result[n] = eta * result[n - 1 - static_cast<std::size_t>(degree)];
      ++n;
    }
    return result;
  }
  [[nodiscard]] double value(double xi, double eta) const {
    const Terms all = terms(xi, eta);
    double sum = 0.0;
    for (std::size_t n = 0; n < kTerms; ++n) {
      sum += c[n] * all[n];
    }
    return sum;
  }
  /// Derivatives by ξ and by η.
  [[nodiscard]] std::array<double, 2> gradient(double xi, double eta) const {
    const Terms all = terms(xi, eta);
    double by_xi = 0.0;
    double by_eta = 0.0;
    std::size_t before = 0;  // where the terms of the degree below begin
    for (std::size_t degree = 1; degree <= kDegree; ++degree) {
      const std::size_t here = before + degree;
      for (std::size_t q = 0; q <= degree; ++q) {
        const double factor = c[here + q];
        if (q < degree) {
          by_xi += factor * static_cast<double>(degree - q) * all[before + q];
        }
        if (q > 0) {
          by_eta += factor * static_cast<double>(q) * all[before + q - 1];
        }
      }
      before = here;
    }
    return {by_xi, by_eta};
  }
  /// By places: coefficient of ξ^p η^q at power(p, q).
  [[nodiscard]] Coefficients coefficients() const {
    Coefficients result{};
    std::size_t n = 0;
    for (std::size_t degree = 0; degree <= kDegree; ++degree) {
      for (std::size_t q = 0; q <= degree; ++q) {
        result[power(degree - q, q)] = c[n++];
      }
    }
    return result;
  }
};

}  // namespace difmesh::detail
