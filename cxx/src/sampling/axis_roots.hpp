#pragma once
// Roots of f along many lines parallel to one axis, found together: one batch of evaluations per
// step.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/sampled_function.hpp"

namespace difmesh::detail {

/// Where the lines run: coordinate `axis` = low + size * t, t in [0,1].
struct LineFrame {
  std::size_t axis = 0;
  double low = 0.0;
  double size = 1.0;
};

class AxisRoots {
 public:
  /// A line with the signs at the ends of [low,high] known to differ.
  struct Start {
    Vec3 point{};      ///< the coordinates across the axis count
    double low = 0.0;  ///< t
    double high = 1.0;
    double guess = 0.5;        ///< within [low,high]
    double slope = 0.0;        ///< df/dt at the guess, as far as known
    bool negative_low = true;  ///< f < 0 at low
  };

  void clear() { lines_.clear(); }
  void add(const Start& start);
  [[nodiscard]] std::size_t size() const { return lines_.size(); }

  /// Finds all roots to `tolerance` in t, counting on superlinear convergence in deciding when to
  /// stop. Where the signs at the ends turn out not to differ after all, the root is the end to
  /// which the missing sign belongs.
  void solve(SampledFunction& f, const LineFrame& frame, double tolerance);

  [[nodiscard]] double root(std::size_t line) const { return lines_[line].t; }
  /// The farthest that any guess was from its root, since reset_misfit(): what the model of f is
  /// worth.
  [[nodiscard]] double misfit() const { return misfit_; }
  void reset_misfit() { misfit_ = 0.0; }

 private:
  struct Line {
    Vec3 point;
    double t;
    double low, high;
    double slope;
    bool negative_low;
    bool low_seen = false;
    bool high_seen = false;
    double f = 0.0;
    double step = 0.0;
    double f_before = 0.0;
    double t_before = 0.0;
    double step_before = 1.0;
    double width_before = 2.0;
  };

  void evaluate(SampledFunction& f, const LineFrame& frame);
  static void propose(Line& line, int round);
  [[nodiscard]] bool accept(const Line& line, double tolerance, int round) const;

  std::vector<Line> lines_;
  std::vector<std::uint32_t> active_;
  std::vector<Vec3> points_;
  std::vector<double> values_;
  double misfit_ = 0.0;
};

}  // namespace difmesh::detail
