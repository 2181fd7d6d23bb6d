#include "sampling/gauss_legendre.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace difmesh::detail {
namespace {

constexpr std::size_t kFirst = kMinGaussNodes;
constexpr std::size_t kLast = kMaxGaussNodes;

// P_0 .. P_degree at s in [-1,1], by the three-term recurrence.
std::array<double, kLast + 1> legendre(std::size_t degree, double s) {
  std::array<double, kLast + 1> p{1.0, s};
  for (std::size_t k = 1; k < degree; ++k) {
    const auto d = static_cast<double>(k);
    p[k + 1] = ((2.0 * d + 1.0) * s * p[k] - d * p[k - 1]) / (d + 1.0);
  }
  return p;
}

// P_n' at s from P_n and P_{n-1} there.
double legendre_slope(std::size_t n, double s, double p, double p_below) {
  return static_cast<double>(n) * (s * p - p_below) / (s * s - 1.0);
}

// The root of P_n that is number `index` from the left; Newton from Tricomi's estimate.
double legendre_root(std::size_t n, std::size_t index) {
  const auto count = static_cast<double>(n);
  double s = -std::cos(std::numbers::pi * (static_cast<double>(index) + 0.75) / (count + 0.5));
  for (int step = 0; step < 8; ++step) {
    const auto p = legendre(n, s);
    s -= p[n] / legendre_slope(n, s, p[n], p[n - 1]);
  }
  return s;
}

void add_node(GaussRule& rule, std::size_t n, std::size_t j) {
  constexpr double kMarginShare = 1e-3;
  const double s = 2 * j + 1 == n ? 0.0 : legendre_root(n, j);
  const auto p = legendre(n, s);
  const double slope = legendre_slope(n, s, p[n], p[n - 1]);
  rule.node[j] = 0.5 + 0.5 * s;
  rule.weight[j] = 1.0 / ((1.0 - s * s) * slope * slope);
  if (j == 0) {
    rule.margin = kMarginShare * rule.node[0];
  }
  const auto near_end = legendre(n, 1.0 - 2.0 * rule.margin);
  for (std::size_t k = 0; k < n; ++k) {
    const double to_coefficient = (2.0 * static_cast<double>(k) + 1.0) * rule.weight[j] * p[k];
    rule.at_low[j] += (k % 2 == 0 ? to_coefficient : -to_coefficient) * near_end[k];
    rule.at_high[j] += to_coefficient * near_end[k];
    if (n - 1 - k < rule.top.size()) {
      rule.top[n - 1 - k][j] = to_coefficient;
    }
  }
}

std::array<GaussRule, kLast - kFirst + 1> make_rules() {
  std::array<GaussRule, kLast - kFirst + 1> rules;
  for (std::size_t n = kFirst; n <= kLast; ++n) {
    GaussRule& rule = rules[n - kFirst];
    rule.count = static_cast<int>(n);
    for (std::size_t j = 0; j < n; ++j) {
      add_node(rule, n, j);
    }
  }
  return rules;
}

double dot(const GaussRule::Row& row, std::span<const double> values, std::size_t n) {
  double sum = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    sum += row[j] * values[j];
  }
  return std::abs(sum);
}

double power(double base, std::size_t exponent) {
  double result = 1.0;
  for (; exponent > 0; --exponent) {
    result *= base;
  }
  return result;
}

// The parabola or line through the `count` nodes that start at `first`, at t.
double extrapolate(const GaussRule& rule, std::span<const double> values, std::size_t first,
                   std::size_t count, double t) {
  double sum = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    double share = values[i];
    for (std::size_t j = first; j < first + count; ++j) {
      if (j != i) {
        share *= (t - rule.node[j]) / (rule.node[i] - rule.node[j]);
      }
    }
    sum += share;
  }
  return sum;
}

// Where the continuations from the left and from the right meet between nodes gap and gap + 1, or
// -1.
double meeting_point(const GaussRule& rule, std::span<const double> values, std::size_t gap) {
  const auto n = static_cast<std::size_t>(rule.count);
  const std::size_t left = std::min<std::size_t>(gap + 1, 3);
  const std::size_t right = std::min<std::size_t>(n - 1 - gap, 3);
  if (left < 2 || right < 2) {
    return -1.0;
  }
  const auto difference = [&](double t) {
    return extrapolate(rule, values, gap + 1 - left, left, t) -
           extrapolate(rule, values, gap + 1, right, t);
  };
  double low = rule.node[gap];
  double high = rule.node[gap + 1];
  const bool sign = difference(low) < 0.0;
  if (sign == (difference(high) < 0.0)) {
    return -1.0;
  }
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    (sign == (difference(middle) < 0.0) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

const GaussRule& gauss_rule(int count) {
  static const auto rules = make_rules();
  return rules[static_cast<std::size_t>(count) - kFirst];
}

Outlook outlook(const GaussRule& rule, std::span<const double> values, double scale) {
  const auto n = static_cast<std::size_t>(rule.count);
  std::array<double, 4> top{};
  for (std::size_t i = 0; i < top.size(); ++i) {
    top[i] = dot(rule.top[i], values, n);
  }
  // What the coefficient of degree 1 is worth at least as a yardstick: it may vanish without
  // anything being wrong with the others. That of degree 0 is none: areas of slices are parabolas
  // even under planes.
  constexpr double kLeastSlope = 0.1;
  const std::size_t chains = n > 4 ? 2 : 1;
  Outlook result;
  for (std::size_t chain = 0; chain < chains; ++chain) {
    double lower = top[chain + 2];
    if (n - 3 - chain == 1) {
      lower = std::max(lower, scale * kLeastSlope);
    }
    if (top[chain] > 0.0) {
      result.rate = std::max(result.rate, top[chain] < lower ? std::sqrt(top[chain] / lower) : 1.0);
    }
  }
  // Coefficients fall off more slowly the higher the degree (a power of it over a geometric
  // series). The exponent is what it took for the estimate to hold on spheres, with spacings up to
  // 1:2:5.
  constexpr double kSlowing = 0.85;
  result.rate = std::pow(result.rate, kSlowing);
  for (std::size_t chain = 0; chain < chains; ++chain) {
    result.error = std::max(result.error, top[chain] * power(result.rate, n + 1 + chain));
    result.tail +=
        top[chain] * result.rate * result.rate / std::max(0.1, 1.0 - result.rate * result.rate);
  }
  return result;
}

double kink_position(const GaussRule& rule, std::span<const double> values) {
  const auto n = static_cast<std::size_t>(rule.count);
  std::size_t sharpest = 1;
  double most = -1.0;
  for (std::size_t j = 1; j + 1 < n; ++j) {
    const double before = (values[j] - values[j - 1]) / (rule.node[j] - rule.node[j - 1]);
    const double after = (values[j + 1] - values[j]) / (rule.node[j + 1] - rule.node[j]);
    if (std::abs(after - before) > most) {
      most = std::abs(after - before);
      sharpest = j;
    }
  }
  for (const std::size_t gap : {sharpest - 1, sharpest}) {
    const double t = meeting_point(rule, values, gap);
    if (t > 0.0) {
      return t;
    }
  }
  return 0.5;
}

}  // namespace difmesh::detail
