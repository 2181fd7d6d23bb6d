#include "curved/axis_averages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace difmesh::detail {
namespace {

template <std::size_t kSize>
using Square = std::array<std::array<double, kSize>, kSize>;

// By Gauss and Jordan with the largest pivot of each column.
template <std::size_t kSize>
Square<kSize> inverse(Square<kSize> matrix) {
  Square<kSize> result{};
  for (std::size_t n = 0; n < kSize; ++n) {
    result[n][n] = 1.0;
  }
  for (std::size_t column = 0; column < kSize; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < kSize; ++row) {
      if (std::abs(matrix[row][column]) > std::abs(matrix[pivot][column])) {
        pivot = row;
      }
    }
    std::swap(matrix[column], matrix[pivot]);
    std::swap(result[column], result[pivot]);
    const double scale = 1.0 / matrix[column][column];
    for (std::size_t n = 0; n < kSize; ++n) {
      matrix[column][n] *= scale;
      result[column][n] *= scale;
    }
    for (std::size_t row = 0; row < kSize; ++row) {
      const double factor = matrix[row][column];
      if (row != column && factor != 0.0) {
        for (std::size_t n = 0; n < kSize; ++n) {
          matrix[row][n] -= factor * matrix[column][n];
          result[row][n] -= factor * result[column][n];
        }
      }
    }
  }
  return result;
}

// Of x^m over a cell: a polynomial in centre and width, without the difference of two powers.
std::array<double, kAcross> powers_over(double centre, double width) {
  const double c = centre * centre;
  const double w = width * width;
  return {1.0, centre, c + w / 12.0, centre * (c + w * 0.25), c * c + c * w * 0.5 + w * w / 80.0};
}

}  // namespace

AxisAverages::AxisAverages(const std::array<double, kAcross>& centre,
                           const std::array<double, kAcross>& width) {
  Square<kAcross> of_quartic{};
  Square<3> of_quadratic{};
  for (std::size_t cell = 0; cell < kAcross; ++cell) {
    const Row powers = powers_over(centre[cell], width[cell]);
    of_quartic[cell] = powers;
    for (std::size_t m = 0; m < kAcross; ++m) {
      averages_[m][cell] = powers[m];
    }
    if (cell >= 1 && cell <= 3) {
      std::copy_n(powers.begin(), 3, of_quadratic[cell - 1].begin());
    }
  }
  quartic_ = inverse(of_quartic);
  quadratic_ = inverse(of_quadratic);
}

const AxisAverages& AxisAverages::uniform() {
  static const AxisAverages averages({-2.0, -1.0, 0.0, 1.0, 2.0}, {1.0, 1.0, 1.0, 1.0, 1.0});
  return averages;
}

}  // namespace difmesh::detail
