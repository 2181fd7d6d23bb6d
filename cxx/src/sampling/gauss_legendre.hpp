#pragma once
// Gauss-Legendre rules on [0,1] that also judge whether they were good enough.

#include <array>
#include <cstddef>
#include <span>

namespace difmesh::detail {

inline constexpr int kMinGaussNodes = 4;
inline constexpr int kMaxGaussNodes = 14;

struct GaussRule {
  using Row = std::array<double, kMaxGaussNodes>;
  int count = 0;
  Row node{};    ///< ascending
  Row weight{};  ///< sums to 1
  /// Values to the coefficients of the Legendre polynomials of degree count - 1, .. count - 4.
  std::array<Row, 4> top{};
  double margin = 0.0;  ///< a thousandth of node[0]
  Row at_low{};         ///< values to that of the polynomial through them at margin
  Row at_high{};        ///< the same at 1 - margin
};

/// \pre kMinGaussNodes <= count <= kMaxGaussNodes
[[nodiscard]] const GaussRule& gauss_rule(int count);

/// What the highest Legendre coefficients of the values at the nodes say, continued to higher
/// degrees at the rate at which they fall off.
struct Outlook {
  double error = 0.0;  ///< of the rule: the coefficient of degree 2 count
  double tail = 0.0;   ///< of the polynomial through the values, between the nodes and at the ends
  double rate = 0.0;   ///< factor from one degree to the next, at most 1
};
/// Values that vary by about `scale` are taken to be nothing special.
[[nodiscard]] Outlook outlook(const GaussRule& rule, std::span<const double> values, double scale);

/// Where to cut an interval whose values do not look smooth: at the kink, if the polynomials
/// through the values on both sides of the sharpest bend meet between two nodes, else in the
/// middle.
[[nodiscard]] double kink_position(const GaussRule& rule, std::span<const double> values);

}  // namespace difmesh::detail
