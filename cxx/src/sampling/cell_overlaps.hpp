#pragma once
// Resolves how often the parts of a cell are covered where sums alone cannot tell.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sampling/covered_prism.hpp"
#include "sampling/piece_lists.hpp"
#include "sampling/sheet_test.hpp"
#include "sampling/triangle_bins.hpp"

namespace difmesh::detail {

/// Judges the cells of blocks of rows, one after another.
class CellOverlaps {
 public:
  /// \param sign see CoveredBox
  CellOverlaps(const NamedMesh& mesh, double sign) : mesh_(mesh), sign_(sign), sheets_(mesh) {}

  /// \param lists the triangles of the block with these rows
  void begin_block(const RowBlocks::Rows& rows, const PieceLists& lists) {
    rows_ = rows;
    lists_ = &lists;
  }

  /// Whether the winding number takes but two neighbouring values in the cell of this slot.
  [[nodiscard]] bool is_plain(std::int64_t row, std::int64_t slot);

  /// A run of slots up to a cell, before which the winding number is `base` all over the column.
  struct Run {
    std::int64_t row = 0;  ///< in the block
    std::int64_t first = 0;
    std::int64_t slot = 0;  ///< of the cell
    double base = 0.0;
  };

  /// Cuts the cell into boxes that hold a single sheet or few pieces. Exact to about 1e-14 unless
  /// more than kMostPieces pieces meet within 1/64 of the cell: there the box of that size counts
  /// as if its winding number took two values.
  [[nodiscard]] Covered resolve(const Run& run);

  static constexpr std::size_t kFewPieces = 6;
  static constexpr std::size_t kMostPieces = 24;

 private:
  void append_pieces(const Run& run, std::int64_t slot, std::vector<CellPiece>& pieces);
  void resolve_box(CoveredBox&& box, int cuts);
  void bisect(CoveredBox&& box, int cuts);

  NamedMesh mesh_;
  double sign_;
  RowBlocks::Rows rows_{};
  const PieceLists* lists_ = nullptr;
  SheetTest sheets_;
  std::vector<std::uint32_t> triangles_;
  Covered total_;
};

}  // namespace difmesh::detail
