// Gauss-Legendre rules: exact on polynomials, and where they cut functions with a kink.
#include "sampling/gauss_legendre.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

using namespace difmesh;
using detail::gauss_rule;
using detail::GaussRule;
using detail::kMaxGaussNodes;
using detail::kMinGaussNodes;

namespace {

std::vector<double> values_at_nodes(const GaussRule& rule, const auto& f) {
  std::vector<double> values;
  for (std::size_t j = 0; j < static_cast<std::size_t>(rule.count); ++j) {
    values.push_back(f(rule.node[j]));
  }
  return values;
}

double sum_with(const GaussRule::Row& row, std::span<const double> values) {
  double sum = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    sum += row[j] * values[j];
  }
  return sum;
}

// The Legendre polynomial of a degree on [0,1], by its explicit sum rather than the recurrence.
double shifted_legendre(int degree, double t) {
  double sum = 0.0;
  double term = 1.0;  // binomial(degree, k) binomial(degree + k, k) (-t)^k
  for (int k = 0; k <= degree; ++k) {
    sum += term;
    term *= -t * (degree - k) * (degree + k + 1) / ((k + 1.0) * (k + 1.0));
  }
  return degree % 2 == 0 ? sum : -sum;
}

}  // namespace

TEST_CASE("gauss rules integrate polynomials of degree 2 n - 1 exactly and no higher ones") {
  for (int n = kMinGaussNodes; n <= kMaxGaussNodes; ++n) {
    CAPTURE(n);
    const GaussRule& rule = gauss_rule(n);
    REQUIRE(rule.count == n);
    for (int degree = 0; degree < 2 * n; ++degree) {
      const auto values = values_at_nodes(rule, [&](double t) { return std::pow(t, degree); });
      CHECK(sum_with(rule.weight, values) == doctest::Approx(1.0 / (degree + 1)).epsilon(1e-13));
    }
    const auto values = values_at_nodes(rule, [&](double t) { return shifted_legendre(n, t); });
    for (const double value : values) {
      CHECK(std::abs(value) < 1e-6);  // the sum cancels for high degrees
    }
    CHECK(rule.margin == doctest::Approx(1e-3 * rule.node[0]));
  }
}

TEST_CASE("gauss rules find coefficients and the values near the ends") {
  for (int n = kMinGaussNodes; n <= 10; ++n) {
    CAPTURE(n);
    const GaussRule& rule = gauss_rule(n);
    for (int degree = 0; degree < n; ++degree) {
      const auto f = [&](double t) { return shifted_legendre(degree, t); };
      const auto values = values_at_nodes(rule, f);
      for (int back = 0; back < 4; ++back) {
        const double wanted = n - 1 - back == degree ? 1.0 : 0.0;
        CHECK(std::abs(sum_with(rule.top[static_cast<std::size_t>(back)], values) - wanted) < 1e-9);
      }
      CHECK(std::abs(sum_with(rule.at_low, values) - f(rule.margin)) < 1e-9);
      CHECK(std::abs(sum_with(rule.at_high, values) - f(1.0 - rule.margin)) < 1e-9);
    }
  }
}

TEST_CASE("gauss rules find the kink of two parabolas that meet between nodes") {
  for (int n = 6; n <= kMaxGaussNodes; ++n) {
    const GaussRule& rule = gauss_rule(n);
    // Between nodes that have two more on either side, which determine the parabolas; nearer to the
    // upper one, for the gap below the sharpest node is tried first.
    for (int gap = 2; gap + 3 < n; ++gap) {
      for (const double share : {0.55, 0.63, 0.93}) {
        const auto at = static_cast<std::size_t>(gap);
        const double kink = rule.node[at] + share * (rule.node[at + 1] - rule.node[at]);
        for (const double sign : {1.0, -1.0}) {
          const auto values = values_at_nodes(rule, [&](double t) {
            const double beyond = t - kink;
            return 0.3 + 0.2 * t + 0.1 * t * t +
                   (beyond > 0.0 ? sign * beyond * (5.0 + 0.3 * beyond) : 0.0);
          });
          CAPTURE(n);
          CAPTURE(kink);
          CHECK(detail::kink_position(rule, values) == doctest::Approx(kink).epsilon(1e-10));
        }
      }
    }
  }
}

TEST_CASE("gauss rules cut in the middle where no continuations meet") {
  const GaussRule& rule = gauss_rule(8);
  // A jump: both parabolas are constants that never meet.
  const auto values = values_at_nodes(rule, [](double t) { return t < 0.3 ? 0.0 : 1.0; });
  CHECK(detail::kink_position(rule, values) == 0.5);
}
