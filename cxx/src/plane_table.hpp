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
/// 1/2: its normal is taken along whichever edge is asked about.
struct UnitPlane {
  Vec3 m{0.0, 0.0, 0.0};
  double a = 0.0;

  [[nodiscard]] bool has_normal() const { return m[0] != 0.0 || m[1] != 0.0 || m[2] != 0.0; }
  [[nodiscard]] static UnitPlane pure(bool inside) {
    return {{0.0, 0.0, 0.0}, inside ? 1.0 : -1.0};
  }
};

class PlaneTable {
 public:
  PlaneTable() = default;
  /// Takes the cells' flags; no planes yet.
  explicit PlaneTable(NodeBits flags);

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

 private:
  [[nodiscard]] std::int64_t rank(const Index3& node) const;

  NodeBits flags_;
  std::vector<std::int64_t> row_start_{0};
  Array<UnitPlane> planes_;
};

/// Flags the cells, estimates their normals and fits their planes. Fills the report's facts about
/// them.
[[nodiscard]] PlaneTable make_planes(const BlockField& field, const NodeBits& nodes,
                                     const Options& options, Phases& phases, Report& report);

}  // namespace difmesh::detail
