#pragma once
// A box with f at 27 points: what can be told about the surface in it.

#include <array>
#include <cstddef>
#include <cstdint>

#include "sampling/sampled_function.hpp"

namespace difmesh::detail {

/// Samples at (i,j,k) / 2 of the box, i, j, k = 0, 1, 2, at index i + 3 j + 9 k.
struct SampledBox {
  Vec3 low{};
  Vec3 size{};
  double share = 1.0;  ///< volume over that of the cell
  int depth = 0;       ///< bisections since the cell
  std::array<double, 27> f{};
};

inline constexpr std::array<std::size_t, 3> kSampleStep{1, 3, 9};

/// The box of a cell whose corner values (x fastest) are known; evaluates f at the other 19 points.
[[nodiscard]] SampledBox sample_cell(SampledFunction& f, const Vec3& low, const Vec3& size,
                                     const std::array<double, 8>& corners);

/// The two halves of a box; evaluates f at 18 points.
[[nodiscard]] std::array<SampledBox, 2> bisect(SampledFunction& f, const SampledBox& box,
                                               std::size_t axis);

/// The derivative of f along an axis, times the size of the box, over lines through the samples.
struct SlopeRange {
  double low = 0.0;  ///< least and greatest at the ends of the lines, by parabolas
  double high = 0.0;
  double bend = 0.0;  ///< greatest second difference

  [[nodiscard]] double largest() const;
  /// Least slope if all have one sign, else 0.
  [[nodiscard]] double steadiest() const;
  void include(double before, double middle, double after);
};

/// Over all nine lines along each axis.
[[nodiscard]] std::array<SlopeRange, 3> slope_ranges(const SampledBox& box);

/// Along `axis`, over the three lines in the face of the box with coordinate `face_axis` = 0 or 1.
[[nodiscard]] SlopeRange face_slope_range(const SampledBox& box, std::size_t axis,
                                          std::size_t face_axis, std::size_t face);

/// Whether f keeps its sign between samples.
/// \param low, high least and greatest sample
/// \param bend second differences over the samples' spacing, summed over the axes
[[nodiscard]] bool one_signed(double low, double high, double bend);

enum class Filling : std::uint8_t { empty, full, mixed, doubtful };

/// `mixed`: samples of both signs; `doubtful`: of one sign, but f may cross 0 between them, with
/// more than a `negligible` share of the cell beyond. May evaluate f once more.
[[nodiscard]] Filling filling(SampledFunction& f, const SampledBox& box,
                              const std::array<SlopeRange, 3>& slopes, double negligible);

/// How the surface in a box lies: as a height along `height` over the plane of `along` and
/// `across`. On faces across `height` that the surface may cut, the cut is in turn a height along
/// `across`.
struct GraphAxes {
  std::size_t along = 0;
  std::size_t across = 1;
  std::size_t height = 2;
  bool rising = true;  ///< f rises with the height axis
  double bend = 0.0;   ///< greatest second difference over the least slope along the height axis
};

/// What to do with a mixed box.
struct BoxPlan {
  bool is_graph = false;
  GraphAxes axes;
  std::size_t split_axis = 0;  ///< where it is no graph
};

/// The axis along which a box is best bisected: where f bends most, the longest one if it bends
/// nowhere.
[[nodiscard]] std::size_t worst_bend(const SampledBox& box,
                                     const std::array<SlopeRange, 3>& slopes);

/// \param negligible share of the cell that a bulge through a face may have without being looked at
[[nodiscard]] BoxPlan plan_box(SampledFunction& f, const SampledBox& box,
                               std::array<SlopeRange, 3> slopes, double negligible);

/// A rough share of {f < 0}, for boxes too small to matter or too hard to resolve.
[[nodiscard]] double rough_fraction(const SampledBox& box, const std::array<SlopeRange, 3>& slopes);

}  // namespace difmesh::detail
