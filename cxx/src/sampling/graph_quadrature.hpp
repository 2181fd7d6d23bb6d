#pragma once
// The fraction of a box in which the surface is a height over a face.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/axis_roots.hpp"
#include "sampling/box_model.hpp"
#include "sampling/gauss_legendre.hpp"
#include "sampling/sampled_box.hpp"

namespace difmesh::detail {

/// Keeps its memory between boxes; not shared between threads.
class GraphQuadrature {
 public:
  struct Result {
    double fraction = 0.0;  ///< of the box; may leave [0,1] by the error
    double error_estimate = 0.0;
    bool exhausted = false;  ///< calls ran out before the tolerance was met
    /// How far a guess from the box's samples was from the surface at most, in sides of the box.
    double misfit = 0.0;
  };

  struct Limits {
    double tolerance = 1e-10;      ///< of the fraction of the box, where f is smooth
    double kink_tolerance = 1e-5;  ///< where it is not
    std::int64_t calls = 0;        ///< evaluations after which nothing is refined any more
  };

  [[nodiscard]] Result integrate(SampledFunction& f, const SampledBox& box, const GraphAxes& axes,
                                 const Limits& limits);

 private:
  // For the four edges along the first axis, by across + 2 height: whether f there has the sign
  // that it has below the surface.
  using EdgeSides = std::array<bool, 4>;
  struct Interval {
    double low = 0.0;
    double high = 1.0;
    int nodes = 0;  // 0: to be chosen
    int level = 0;  // refinements so far
  };
  // Part of the box along the first axis, between crossings of the edges: the area of a slice below
  // the surface is smooth there.
  struct Panel : Interval {
    EdgeSides below{};
    std::size_t first_column = 0;
  };
  // One slice.
  struct Column {
    double along = 0.0;
    EdgeSides below{};
    std::array<double, 9> model{};
    std::size_t first_cut = 0;  // in roots_, the lower face's before the upper's
    double area = 0.0;
  };
  // Part of a slice across, between cuts of the faces: the height is smooth and within the box
  // there.
  struct Line : Interval {
    std::size_t column = 0;
  };
  struct Verdict {
    bool good = true;
    double error = 0.0;
    int nodes = 0;        // that would do; more than there are rules for if none would
    double cut_at = 0.5;  // where to cut then
  };

  [[nodiscard]] bool run(SampledFunction& f);
  void find_panels(SampledFunction& f);
  [[nodiscard]] bool add_edge(SampledFunction& f, std::size_t edge);
  void add_columns(Panel& panel);
  void find_cuts(SampledFunction& f);
  void add_lines(std::size_t index);
  void integrate_lines(SampledFunction& f);
  void add_heights(const Line& line);
  void finish_panel(const Panel& panel);
  [[nodiscard]] Verdict judge(const Interval& interval) const;
  template <class T>
  [[nodiscard]] double settle(const T& interval, std::vector<T>& next);
  void set_tolerances(const Limits& limits);
  [[nodiscard]] int nodes_for(double length, double reach) const;
  [[nodiscard]] std::size_t rows(int nodes) const;
  [[nodiscard]] static double position(const GaussRule& rule, std::size_t row);
  [[nodiscard]] Vec3 point(double along, double across) const;
  [[nodiscard]] LineFrame frame(std::size_t axis) const;

  const SampledBox* box_ = nullptr;
  BoxModel model_;
  GraphAxes axes_;
  // f is not smooth on the scale of the box: nothing is trusted that can be checked.
  bool careful_ = false;
  bool refine_ = true;
  bool exhausted_ = false;
  double tolerance_ = 0.0;
  double kink_tolerance_ = 0.0;
  std::array<double, kMaxGaussNodes> least_reach_{};  // in half lengths, for each number of nodes
  double rounding_ = 0.0;
  double smooth_misfit_ = 0.0;
  double line_reach_ = 0.0;
  double panel_reach_ = 0.0;
  std::int64_t last_call_ = 0;
  double volume_ = 0.0;
  double error_ = 0.0;

  AxisRoots roots_;
  std::vector<Panel> panels_, next_panels_;
  std::vector<Column> columns_;
  std::vector<Line> lines_, next_lines_;
  std::vector<double> values_;
};

}  // namespace difmesh::detail
