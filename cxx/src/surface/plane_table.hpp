#pragma once
// Planes of the cells that need one: those at an end of a crossed dual edge, and the interfacial
// ones along open sides, where the surface may run on to the domain face. Those in the outermost
// layers of the block are kept in a table, as what lies beyond may ask for any of them; the others:
// see plane_slabs.hpp.

#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "curved/surface_table.hpp"
#include "difmesh/array.hpp"
#include "difmesh/report.hpp"
#include "grid/block_field.hpp"
#include "grid/node_bits.hpp"
#include "planes/unit_plane.hpp"

namespace difmesh::detail {

class PlaneTable {
 public:
  PlaneTable() = default;
  /// Makes room for flags and planes; no memory to speak of where there are none.
  /// \param row_counts planes of each row of nodes
  PlaneTable(const NodeBits& nodes, const std::vector<std::uint32_t>& row_counts);

  [[nodiscard]] bool has(const Index3& node) const {
    const std::int64_t row = row_of(node);
    return !is_empty(row) && (flags(row)[node[0] / 64] >> (node[0] % 64) & 1) != 0;
  }
  /// \pre has(node)
  [[nodiscard]] const UnitPlane& at(const Index3& node) const {
    return planes_[static_cast<std::size_t>(rank(node))];
  }
  [[nodiscard]] bool is_empty(std::int64_t row) const {
    const auto n = static_cast<std::size_t>(row);
    return starts_.empty() || starts_[n].planes == starts_[n + 1].planes;
  }
  [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(planes_.size()); }

  /// Words of bits, and the planes of their cells. \pre the row is not empty
  [[nodiscard]] const std::uint64_t* flags(std::int64_t row) const {
    return flags_.data() + starts_[static_cast<std::size_t>(row)].flags;
  }
  [[nodiscard]] const UnitPlane* planes(std::int64_t row) const {
    return planes_.data() + starts_[static_cast<std::size_t>(row)].planes;
  }
  [[nodiscard]] std::uint64_t* flags(std::int64_t row) {
    return flags_.data() + starts_[static_cast<std::size_t>(row)].flags;
  }
  [[nodiscard]] UnitPlane* planes(std::int64_t row) {
    return planes_.data() + starts_[static_cast<std::size_t>(row)].planes;
  }

 private:
  // Of one row.
  struct Starts {
    std::int64_t planes = 0;
    std::int64_t flags = 0;
  };

  [[nodiscard]] std::int64_t row_of(const Index3& node) const {
    return node[2] * row_length_ + node[1];
  }
  [[nodiscard]] std::int64_t rank(const Index3& node) const;

  std::int64_t row_length_ = 0;
  std::vector<Starts> starts_;
  Array<std::uint64_t> flags_;
  Array<UnitPlane> planes_;
};

/// What earlier phases know of the cells.
struct PlaneHints {
  const Array<std::uint8_t>& row_ends;  ///< see ClassifiedNodes
  const SurfaceTable* surfaces;         ///< null where cells own none
};

/// Flags the outermost cells, estimates their normals and fits their planes. Adds the facts about
/// them to the report.
[[nodiscard]] PlaneTable make_planes(const BlockField& field, const NodeBits& nodes,
                                     const PlaneHints& hints, const Options& options,
                                     Phases& phases, Report& report);

}  // namespace difmesh::detail
