#pragma once
// The fraction of one cell: boxes are bisected until the surface in each is a graph.

#include <array>
#include <cstdint>
#include <vector>

#include "sampling/graph_quadrature.hpp"
#include "sampling/sampled_box.hpp"

namespace difmesh::detail {

/// Keeps its memory between cells; not shared between threads.
class CellQuadrature {
 public:
  struct Limits {
    double tolerance = 1e-10;
    double kink_tolerance = 1e-5;
    std::int64_t max_calls = 200'000;
  };
  struct Result {
    double fraction = 0.0;
    double error_estimate = 0.0;
    bool subdivided = false;
    bool exhausted = false;  ///< calls ran out before the tolerances were met
  };

  explicit CellQuadrature(const Limits& limits) : limits_(limits) {}

  /// \param corners f at the corners of the cell, x fastest
  [[nodiscard]] Result integrate(SampledFunction& f, const Vec3& low, const Vec3& size,
                                 const std::array<double, 8>& corners);

 private:
  void take(SampledFunction& f, const SampledBox& box, Result& result);
  [[nodiscard]] bool integrate_graph(SampledFunction& f, const SampledBox& box,
                                     const GraphAxes& axes, bool last_try, Result& result);

  Limits limits_;
  std::int64_t last_call_ = 0;
  GraphQuadrature quadrature_;
  std::vector<SampledBox> boxes_;  // taken in turn, so that running out of calls leaves small boxes
};

}  // namespace difmesh::detail
