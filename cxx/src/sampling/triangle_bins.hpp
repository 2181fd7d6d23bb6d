#pragma once
// A triangle mesh in grid units, sorted into blocks of rows of cells.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "sampling/clip_band.hpp"

namespace difmesh::detail {

/// Cuts the rows (j,k) of a grid, which run along x, into blocks of neighbours: some rows of one
/// layer k, or some whole layers. Blocks, and rows in them, come in the order of memory.
class RowBlocks {
 public:
  explicit RowBlocks(const Index3& dims) noexcept;

  /// Rows first_j..end_j - 1 of layers first_k..end_k - 1.
  struct Rows {
    std::int64_t first_j;
    std::int64_t end_j;
    std::int64_t first_k;
    std::int64_t end_k;
  };

  [[nodiscard]] std::int64_t count() const noexcept { return across_j_ * across_k_; }
  [[nodiscard]] std::int64_t rows_per_block() const noexcept { return rows_ * layers_; }
  [[nodiscard]] Rows rows(std::int64_t block) const noexcept;

  /// Calls visit(block) for all blocks whose rows a triangle with these corners may meet.
  template <class Visit>
  void for_blocks(const Vec3& a, const Vec3& b, const Vec3& c, const Visit& visit) const {
    const BandRange k = range<2>(a, b, c);
    const BandRange j = range<1>(a, b, c);
    if (k.first > k.last || j.first > j.last) {
      return;
    }
    for (std::int64_t layer = k.first / layers_; layer <= k.last / layers_; ++layer) {
      for (std::int64_t part = j.first / rows_; part <= j.last / rows_; ++part) {
        visit(layer * across_j_ + part);
      }
    }
  }

 private:
  template <std::size_t Axis>
  [[nodiscard]] BandRange range(const Vec3& a, const Vec3& b, const Vec3& c) const noexcept {
    const BandRange all =
        bands(std::min({a[Axis], b[Axis], c[Axis]}), std::max({a[Axis], b[Axis], c[Axis]}));
    return {std::max<std::int64_t>(all.first, 0), std::min(all.last, dims_[Axis] - 1)};
  }

  Index3 dims_;
  std::int64_t rows_;      ///< in each layer of a block
  std::int64_t layers_;    ///< more than 1 only where rows_ are all rows
  std::int64_t across_j_;  ///< blocks side by side in one layer
  std::int64_t across_k_;  ///< blocks on top of each other
};

/// For each block of rows, the triangles that may meet it, in no particular order.
class TriangleBins {
 public:
  /// \param corners positions in grid units
  TriangleBins(const RowBlocks& blocks, std::span<const Vec3> corners,
               std::span<const Triangle> triangles, Workers& workers);

  [[nodiscard]] std::span<const std::uint32_t> triangles(std::int64_t block) const noexcept {
    const auto b = static_cast<std::size_t>(block);
    return {triangles_.data() + begin_[b], triangles_.data() + begin_[b + 1]};
  }

 private:
  std::vector<std::uint64_t> begin_;  ///< one per block, and the end
  Array<std::uint32_t> triangles_;
};

}  // namespace difmesh::detail
