#pragma once
// Planes of the cells that need one: those at an end of a crossed dual edge, and the interfacial
// ones along open sides, where the surface may run on to the domain face.

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
/// 1/2: its normal is taken along whichever edge is asked about. Four doubles: kernels read them so.
struct UnitPlane {
  Vec3 m{0.0, 0.0, 0.0};
  double a = 0.0;

  [[nodiscard]] bool has_normal() const { return m[0] != 0.0 || m[1] != 0.0 || m[2] != 0.0; }
  [[nodiscard]] static UnitPlane pure(bool inside) {
    return {{0.0, 0.0, 0.0}, inside ? 1.0 : -1.0};
  }
};

static_assert(sizeof(UnitPlane) == 4 * sizeof(double));

class PlaneTable {
 public:
  PlaneTable() = default;
  /// Takes the cells' flags and their number in each row; no planes yet.
  PlaneTable(NodeBits flags, std::vector<std::int64_t> row_counts);

  [[nodiscard]] const NodeBits& flags() const { return flags_; }
  [[nodiscard]] bool has(const Index3& node) const { return flags_.test(node); }
  /// \pre has(node)
  [[nodiscard]] const UnitPlane& at(const Index3& node) const {
    return planes_[static_cast<std::size_t>(rank(node))];
  }
  /// Number of the first plane of a row.
  [[nodiscard]] std::int64_t row_start(std::int64_t row) const {
    return row_start_[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] const UnitPlane& operator[](std::int64_t number) const {
    return planes_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] UnitPlane& operator[](std::int64_t number) {
    return planes_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] std::int64_t size() const { return row_start_.back(); }

  /// Planes of one row, for a walk along it: far cheaper than at().
  class Row {
   public:
    Row() = default;
    Row(const PlaneTable& table, std::int64_t j, std::int64_t k)
        : flags_(table.flags_.row(j, k)),
          planes_(table.planes_.data() + table.row_start(table.flags_.row_index(j, k))) {}

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

 private:
  [[nodiscard]] std::int64_t rank(const Index3& node) const;

  NodeBits flags_;
  std::vector<std::int64_t> row_start_{0};
  Array<UnitPlane> planes_;
};

/// Flags the cells, estimates their normals and fits their planes. Fills the report's facts about
/// them. row_ends: see ClassifiedNodes.
[[nodiscard]] PlaneTable make_planes(const BlockField& field, const NodeBits& nodes,
                                     const Array<std::uint8_t>& row_ends, const Options& options,
                                     Phases& phases, Report& report);

}  // namespace difmesh::detail
