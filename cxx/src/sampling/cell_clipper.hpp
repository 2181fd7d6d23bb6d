#pragma once
// Clips triangles to cells: first to a layer, then to its rows, then to the cells of each row.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "difmesh/grid.hpp"
#include "mesh/grid_mesh.hpp"
#include "sampling/clip_band.hpp"
#include "sampling/column_sums.hpp"
#include "sampling/piece_lists.hpp"
#include "sampling/triangle_bins.hpp"

namespace difmesh::detail {

/// Clips triangles to the cells of one block of rows.
class CellClipper {
 public:
  CellClipper(const RowBlocks::Rows& rows, std::int64_t cells_per_row, ColumnSums& sums,
              PieceLists& lists)
      : rows_(rows), cells_(cells_per_row), sums_(sums), lists_(lists) {}

  /// \param number of the triangle
  void add_triangle(std::uint32_t number, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 corners[3] = {a, b, c};
    triangle_ = number;
    const Extent z = extent<2>(corners, 3);
    const BandRange range = bands(z.low, z.high);
    if (range.first == range.last) {
      add_layer(range.first, corners, 3);
      return;
    }
    const std::int64_t last = std::min(range.last, rows_.end_k - 1);
    for (std::int64_t k = std::max(range.first, rows_.first_k); k <= last; ++k) {
      const auto low = static_cast<double>(k);
      clip_band<2>(corners, 3, low, low + 1.0, layer_);
      add_layer(k, layer_.corners.data(), layer_.size);
    }
  }

  [[nodiscard]] std::int64_t pieces() const noexcept { return pieces_; }

 private:
  void add_layer(std::int64_t k, const Vec3* corners, std::size_t size) {
    if (size < 3) {
      return;
    }
    const std::int64_t row = (k - rows_.first_k) * (rows_.end_j - rows_.first_j) - rows_.first_j;
    const Extent y = extent<1>(corners, size);
    const BandRange range = bands(y.low, y.high);
    if (range.first == range.last) {
      if (range.first >= rows_.first_j && range.first < rows_.end_j) {
        add_row(row + range.first, corners, size);
      }
      return;
    }
    const std::int64_t last = std::min(range.last, rows_.end_j - 1);
    for (std::int64_t j = std::max(range.first, rows_.first_j); j <= last; ++j) {
      const auto low = static_cast<double>(j);
      clip_band<1>(corners, size, low, low + 1.0, row_);
      add_row(row + j, row_.corners.data(), row_.size);
    }
  }

  /// \param row in the block
  void add_row(std::int64_t row, const Vec3* corners, std::size_t size) {
    if (size < 3) {
      return;
    }
    const Extent x = extent<0>(corners, size);
    const BandRange range = bands(x.low, x.high);
    // All that lies before the grid counts as one cell, and all after it.
    const std::int64_t first = std::clamp<std::int64_t>(range.first, -1, cells_);
    const std::int64_t last = std::clamp<std::int64_t>(range.last, -1, cells_);
    if (first == last) {
      add_piece(row, first, corners, size);
      return;
    }
    for (std::int64_t i = first; i <= last; ++i) {
      const double low = i < 0 ? -kGreatestCoordinate : static_cast<double>(i);
      const double high = i == cells_ ? kGreatestCoordinate : static_cast<double>(i + 1);
      clip_band<0>(corners, size, low, high, piece_);
      if (piece_.size >= 3) {
        add_piece(row, i, piece_.corners.data(), piece_.size);
      }
    }
  }

  void add_piece(std::int64_t row, std::int64_t i, const Vec3* corners, std::size_t size) {
    lists_.add(row, i + 1, triangle_);
    if (i < 0 || i >= cells_) {
      sums_.add(row, i < 0 ? 0 : cells_ + 1, piece_sums(corners, size, 0.0).area2 / 2.0, 0.0);
      return;
    }
    const PieceSums piece = piece_sums(corners, size, static_cast<double>(i + 1));
    sums_.add(row, i + 1, piece.area2 / 2.0, piece.beyond6 / 6.0);
    ++pieces_;
  }

  const RowBlocks::Rows rows_;
  const std::int64_t cells_;
  ColumnSums& sums_;
  PieceLists& lists_;
  std::uint32_t triangle_ = 0;
  std::int64_t pieces_ = 0;
  // Each clip at most doubles the corners.
  Polygon<6> layer_;
  Polygon<12> row_;
  Polygon<24> piece_;
};

}  // namespace difmesh::detail
