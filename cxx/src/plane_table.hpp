#pragma once
// Planes of the cells that need one: those at an end of a crossed dual edge, and the interfacial
// ones along open sides, where the surface may run on to the domain face. Those in the outermost layers of the block
// are kept in a table, as what lies beyond may ask for any of them; the others: see plane_slabs.hpp.

#include <cstdint>
#include <vector>

#include "block_field.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/reconstruct.hpp"
#include "node_bits.hpp"
#include "parallel.hpp"

namespace difmesh::detail {

/// The plane m·u = a of a cell in the unit cube about its centre; the material is m·u <= a. A cell
/// that is full or empty has m = 0 and a = 1 or -1. One without a gradient has m = 0 and a = γ -
/// 1/2: its normal is taken along whichever edge is asked about. The centre is inside the material,
/// a >= 0, exactly where γ >= 1/2: see offset_of_share(). Four doubles: kernels read them so.
struct UnitPlane {
  Vec3 m{0.0, 0.0, 0.0};
  double a = 0.0;

  [[nodiscard]] bool has_normal() const { return m[0] != 0.0 || m[1] != 0.0 || m[2] != 0.0; }
  /// The one test for the side on which the centre, or what trace() made of it, lies.
  [[nodiscard]] bool is_centre_inside() const { return a >= 0.0; }
  [[nodiscard]] static UnitPlane pure(bool inside) {
    return {{0.0, 0.0, 0.0}, inside ? 1.0 : -1.0};
  }
};

static_assert(sizeof(UnitPlane) == 4 * sizeof(double));

/// Planes of one row, for a walk along it.
class PlaneRow {
 public:
  PlaneRow() = default;
  /// \param flags words of bits: the cells that have planes
  PlaneRow(const std::uint64_t* flags, const UnitPlane* planes) : flags_(flags), planes_(planes) {}

  /// Must be called for words 0, 1, 2 … in turn.
  void enter_word(std::int64_t w) {
    planes_ += in_word_;
    word_ = flags_[w];
    in_word_ = word_ != 0 ? count_bits(word_) : 0;
  }
  /// \pre the node at this bit of the word has a plane
  [[nodiscard]] const UnitPlane& at(int bit) const {
    return planes_[count_bits(word_ & below(bit))];
  }
  /// \pre the first node of the next word has a plane
  [[nodiscard]] const UnitPlane& first_of_next() const { return planes_[in_word_]; }

 private:
  const std::uint64_t* flags_ = nullptr;
  const UnitPlane* planes_ = nullptr;
  std::uint64_t word_ = 0;
  std::int64_t in_word_ = 0;
};

/// Flags the ends of the crossed edges in a row of nodes: those that differ from a neighbour.
class EdgeEnds {
 public:
  EdgeEnds(const NodeBits& nodes, std::int64_t j, std::int64_t k);

  /// True if there are none, as far as that is known without a look at the bits.
  [[nodiscard]] bool are_none() const { return are_none_; }
  [[nodiscard, gnu::always_inline]] std::uint64_t word(std::int64_t w) const {
    const std::uint64_t here = here_[w];
    const std::uint64_t across =
        ((here ^ south_[w]) | (here ^ north_[w])) | ((here ^ below_[w]) | (here ^ above_[w]));
    const std::uint64_t crossed = nodes_->crossed_x(here_, w);
    const std::uint64_t from_west = w > 0 ? (here_[w - 1] >> 63 ^ here) & 1 : 0;
    return across | crossed | crossed << 1 | from_west;
  }

 private:
  const NodeBits* nodes_;
  const std::uint64_t* here_;
  const std::uint64_t* south_;
  const std::uint64_t* north_;
  const std::uint64_t* below_;
  const std::uint64_t* above_;
  bool are_none_;
};

/// The cells of a block that are cells of their own, by local index: 1 to last, the next block's first layer
/// included. The outermost ones are 1, dims and last.
struct BlockCells {
  Index3 dims;
  Index3 last;

  explicit BlockCells(const BlockField& field);
  [[nodiscard]] bool is_row(std::int64_t j, std::int64_t k) const {
    return j >= 1 && k >= 1 && j <= last[1] && k <= last[2];
  }
  /// True if all cells of the row are outermost ones.
  [[nodiscard]] bool is_outermost(std::int64_t j, std::int64_t k) const {
    return j == 1 || k == 1 || j >= dims[1] || k >= dims[2];
  }
  /// Bits of the cells between the outermost ones.
  [[nodiscard]] std::uint64_t inner(std::int64_t w) const {
    return NodeBits::range(w, 2, dims[0] - 1);
  }
};

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

/// Flags the outermost cells, estimates their normals and fits their planes. Adds the facts about
/// them to the report. row_ends: see ClassifiedNodes.
[[nodiscard]] PlaneTable make_planes(const BlockField& field, const NodeBits& nodes,
                                     const Array<std::uint8_t>& row_ends, const Options& options,
                                     Phases& phases, Report& report);

}  // namespace difmesh::detail
