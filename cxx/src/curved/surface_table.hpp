#pragma once
// The surfaces of the interfacial cells in and around a block.

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "curved/neighbourhood.hpp"
#include "curved/position_graph.hpp"
#include "difmesh/array.hpp"
#include "grid/block_field.hpp"

namespace difmesh::detail {

/// Distance between the centres of a cell and one some steps along an axis, in the grid's unit.
[[nodiscard]] double centre_distance(const BlockField& field, std::size_t axis, std::int64_t index,
                                     std::int64_t steps);

/// The surface that a cell of the table owns: the mean of its graphs' functions, in the cell's unit
/// of length. Behind a mirror it is seen mirrored.
struct OwnedSurface {
  std::span<const PositionGraph> graphs;
  Vec3 sense{1.0, 1.0, 1.0};  ///< by axis, -1 behind a mirror
  double bend = 0.0;  ///< largest principal curvature, by size, of the level through the centre
  bool is_kinked = false;

  [[nodiscard]] double function(const Vec3& x) const;
  [[nodiscard]] FunctionJet jet(const Vec3& x) const;
};

/// What the table knows of a place of the grid.
enum class Ownership : std::uint8_t {
  beyond,  ///< an open side
  pure,    ///< as good as empty or full, or beyond such a side
  bare,    ///< interfacial, but without a surface
  owned,
};
struct SurfaceAt {
  Ownership ownership = Ownership::beyond;
  OwnedSurface surface;
};

/// Layers of cells around a block whose surfaces it needs: the side of a node next to it depends on
/// whether its neighbours are kinked, and that on the surfaces around these.
inline constexpr std::int64_t kSurfaceLayers = 3;

/// Thread safety: const calls are safe.
class SurfaceTable {
 public:
  /// Makes the surfaces of all interfacial cells of the block and kSurfaceLayers beyond, and finds
  /// the kinked ones: see kinks.hpp.
  SurfaceTable(const BlockField& field, Phases& phases, double weight);

  /// Of a cell by its global index, which may be beyond the sides.
  [[nodiscard]] SurfaceAt at(const Index3& cell) const;
  /// Notes that a cell's surface puts its centre on another side than its fraction does, and says
  /// where that is so.
  void note_moved(const Index3& cell);
  [[nodiscard]] bool is_moved(const Index3& cell) const;
  [[nodiscard]] const BlockField& field() const { return field_; }
  /// Cube root of a cell's volume.
  [[nodiscard]] double length(const Index3& cell) const {
    return field_.is_stretched ? unit_length(field_, cell) : uniform_length_;
  }

  /// Calls visit(cell, surface) for the cells of a row of the table that own one.
  template <class Visit>
  void for_each_owner(std::int64_t row, const Visit& visit) const {
    const Index3 start = start_of(row);
    for (std::int64_t n = starts_[static_cast<std::size_t>(row)];
         n < starts_[static_cast<std::size_t>(row) + 1]; ++n) {
      const Entry& entry = entries_[static_cast<std::size_t>(n)];
      if (entry.graph_count > 0) {
        visit(Index3{start[0] + entry.place, start[1], start[2]}, surface_of(entry));
      }
    }
  }
  [[nodiscard]] std::int64_t rows() const { return dims_[1] * dims_[2]; }
  /// Cells of the block itself that own one.
  [[nodiscard]] std::int64_t own_surfaces() const { return own_surfaces_; }

 private:
  // An interfacial cell.
  struct Entry {
    std::int32_t place = 0;  // in its row
    std::uint8_t graph_count = 0;
    bool is_kinked = false;
    bool is_moved = false;
    std::int64_t first_graph = 0;
    double bend = 0.0;
  };

  [[nodiscard]] Index3 start_of(std::int64_t row) const {
    return {low_[0], low_[1] + row % dims_[1], low_[2] + row / dims_[1]};
  }
  /// A place of the grid, seen through the sides.
  struct Place {
    Index3 cell{0, 0, 0};
    Vec3 sense{1.0, 1.0, 1.0};
    bool is_constant = false;
    bool is_elsewhere = false;  ///< beyond an open side, or further away than anything asks
  };
  [[nodiscard]] Place place_of_cell(const Index3& cell) const;
  [[nodiscard]] const Entry* find(const Index3& cell) const;
  [[nodiscard]] OwnedSurface surface_of(const Entry& entry) const;
  void make(Phases& phases, double weight);
  void find_kinks(Phases& phases, double weight);

  const BlockField& field_;
  double uniform_length_;
  Index3 low_{};  // first cell of the table
  Index3 dims_{};
  std::vector<std::int64_t> starts_;  // entries before each row; one more
  Array<Entry> entries_;
  Array<PositionGraph> graphs_;
  std::int64_t own_surfaces_ = 0;
};

}  // namespace difmesh::detail
