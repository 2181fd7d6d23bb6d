#pragma once
// Graphs as the table of surfaces keeps them: with the coefficients that positions need.

#include <array>

#include "curved/local_surface.hpp"

namespace difmesh::detail {

/// A graph of 13 columns, or a paraboloid.
class PositionGraph {
 public:
  PositionGraph() = default;
  explicit PositionGraph(const Graph& graph) : frame_(graph.frame), scale_(graph.scale) {
    const Coefficients& c = graph.coefficients;
    for (std::size_t m = 0; m < 5; ++m) {
      along_xi_[m] = c[power(m, 0)];
    }
    for (std::size_t m = 1; m < 5; ++m) {
      along_eta_[m - 1] = c[power(0, m)];
    }
    mixed_ = {c[power(1, 1)], c[power(1, 2)], c[power(2, 1)], c[power(2, 2)]};
  }

  /// As Graph's.
  [[nodiscard]] double function(const Vec3& x) const {
    const double xi = dot(frame_[0], x);
    const double eta = dot(frame_[1], x);
    const auto& a = along_xi_;
    const auto& b = along_eta_;
    const double value =
        (a[0] + xi * (a[1] + xi * (a[2] + xi * (a[3] + xi * a[4])))) +
        eta * (b[0] + eta * (b[1] + eta * (b[2] + eta * b[3]))) +
        xi * eta * ((mixed_[0] + mixed_[1] * eta) + xi * (mixed_[2] + mixed_[3] * eta));
    return (dot(frame_[2], x) - value) * scale_;
  }
  [[nodiscard]] FunctionJet jet(const Vec3& x) const {
    Graph graph;
    graph.frame = frame_;
    graph.scale = scale_;
    for (std::size_t m = 0; m < 5; ++m) {
      graph.coefficients[power(m, 0)] = along_xi_[m];
    }
    for (std::size_t m = 1; m < 5; ++m) {
      graph.coefficients[power(0, m)] = along_eta_[m - 1];
    }
    graph.coefficients[power(1, 1)] = mixed_[0];
    graph.coefficients[power(1, 2)] = mixed_[1];
    graph.coefficients[power(2, 1)] = mixed_[2];
    graph.coefficients[power(2, 2)] = mixed_[3];
    return graph.jet(x);
  }

 private:
  std::array<Vec3, 3> frame_{};
  std::array<double, 5> along_xi_{};
  std::array<double, 4> along_eta_{};
  std::array<double, 4> mixed_{};  // of ξη, ξη², ξ²η and ξ²η²
  double scale_ = 1.0;
};

}  // namespace difmesh::detail
