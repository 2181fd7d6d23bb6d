#pragma once
// Polynomials along one axis from their averages over neighbouring cells.

#include <array>
#include <cstddef>

namespace difmesh::detail {

/// Cells on each side of the middle one across which heights are taken.
inline constexpr int kAcrossReach = 2;
inline constexpr std::size_t kAcross = 2 * kAcrossReach + 1;

/// What turns averages over five cells along an axis into the coefficients of polynomials in the
/// distance from the middle cell's centre.
class AxisAverages {
 public:
  /// \param centre,width of the cells at -2 to 2; those whose polynomials are asked for must be
  ///   numbers
  AxisAverages(const std::array<double, kAcross>& centre, const std::array<double, kAcross>& width);
  /// Cells of width 1.
  [[nodiscard]] static const AxisAverages& uniform();

  /// Average of the m-th power over the cell at a step.
  [[nodiscard]] double average(std::size_t m, int step) const {
    return averages_[m][static_cast<std::size_t>(step + kAcrossReach)];
  }
  /// Weight of the average over the cell at a step in the coefficient of the m-th power: of the
  /// quartic through five averages, and of the quadratic through the three in the middle.
  [[nodiscard]] double quartic(std::size_t m, int step) const {
    return quartic_[m][static_cast<std::size_t>(step + kAcrossReach)];
  }
  [[nodiscard]] double quadratic(std::size_t m, int step) const {
    return quadratic_[m][static_cast<std::size_t>(step + 1)];
  }

 private:
  using Row = std::array<double, kAcross>;
  std::array<Row, kAcross> averages_;  // [power][cell]
  std::array<Row, kAcross> quartic_;   // [power][cell]
  std::array<std::array<double, 3>, 3> quadratic_;
};

}  // namespace difmesh::detail
