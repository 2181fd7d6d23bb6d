#pragma once
// Resolves how often the parts of a cell are covered where sums alone cannot tell.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sampling/covered_prism.hpp"
#include "sampling/piece_lists.hpp"
#include "sampling/sheet_test.hpp"
#include "sampling/triangle_bins.hpp"

namespace difmesh::detail {

/// Judges the cells of blocks of rows, one after another.
class CellOverlaps {
 public:
  /// Steps that a cell may take for each of its pieces, about 10 ns each. Surfaces that cross take
  /// some thousand.
  static constexpr std::int64_t kStepsPerPiece = 1000000;

  /// \param sign see CoveredBox
  CellOverlaps(const NamedMesh& mesh, double sign, std::int64_t steps_per_piece = kStepsPerPiece)
      : mesh_(mesh), sign_(sign), steps_per_piece_(steps_per_piece), sheets_(mesh) {}

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

  /// Cuts the cell into boxes that hold a single sheet or few pieces. Exact but for rounding, about
  /// 1e-15 for each piece, and for what is undecided: boxes that still hold more when the effort
  /// that is granted for each piece is spent. They count as if the winding number took two values.
  [[nodiscard]] Covered resolve(const Run& run);

 private:
  /// How a box came about.
  struct Descent {
    int cuts = 0;
    std::size_t pieces = 0;  ///< in the box that was cut last along all three axes
    std::int64_t keep = 0;   ///< what of the effort is for other boxes
  };

  void append_pieces(const Run& run, std::int64_t slot, std::vector<CellPiece>& pieces);
  void resolve_box(CoveredBox&& box, Descent descent);
  [[nodiscard]] std::optional<Covered> arrange(const CoveredBox& box, std::size_t pieces,
                                               const Descent& descent);
  void bisect(CoveredBox&& box, const Descent& descent);

  NamedMesh mesh_;
  double sign_;
  std::int64_t steps_per_piece_;
  RowBlocks::Rows rows_{};
  const PieceLists* lists_ = nullptr;
  SheetTest sheets_;
  std::vector<std::uint32_t> triangles_;
  std::int64_t effort_ = 0;  ///< left for the cell
  Covered total_;
};

}  // namespace difmesh::detail
