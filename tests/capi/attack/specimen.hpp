#pragma once
/// \file specimen.hpp
/// An ugly field with all that goes with it: how it lies in space and in memory, the options, and
/// the blocks that it is cut into.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "difmesh/difmesh.h"

namespace difmesh::attack {

using Index3 = std::array<std::int64_t, 3>;

/// What else to compare with or ask, as bits of Specimen::variants; see Trial.
enum Variant : unsigned {
  kWithoutGaps = 1,
  kWithoutNormals = 2,
  kMeasured = 4,
  kWithProgress = 8,
  kOpenFaces = 16,
  kInFloat64 = 32,
  kOtherFloats = 64,
};

struct Specimen {
  std::uint64_t seed = 0;
  Index3 dims{1, 1, 1};
  std::vector<double> values;  ///< of the elements, x fastest; integers from 0 to their largest
  std::int32_t type = DIF_FLOAT64;
  std::array<std::size_t, 3> memory_order{0, 1, 2};  ///< axes from the fastest in memory on
  std::array<int, 3> gaps{1, 1, 1};  ///< elements per element along an axis; negative: backwards
  std::array<double, 3> origin{0.0, 0.0, 0.0};
  std::array<double, 3> spacing{1.0, 1.0, 1.0};
  dif_options options{};
  std::array<std::vector<std::int64_t>, 3> cuts;  ///< where blocks meet, ascending
  std::int64_t more_ghosts = 0;                   ///< than a block needs
  std::int32_t other_threads = 2;  ///< what the result is compared with; see trial.hpp
  unsigned variants = 0;           ///< of Variant; from bit 8 on, which instruction sets

  [[nodiscard]] std::size_t element(const Index3& cell) const {
    return static_cast<std::size_t>((cell[2] * dims[1] + cell[1]) * dims[0] + cell[0]);
  }
  /// Of a cell, in [0, 1].
  [[nodiscard]] double fraction(const Index3& cell) const;
  [[nodiscard]] bool is_side(std::size_t axis, bool high, std::int32_t kind) const {
    const std::int32_t side = options.boundary[2 * axis + (high ? 1 : 0)];
    return side == kind || (side == DIF_SIDE_DEFAULT && kind == DIF_SIDE_OPEN);
  }
  [[nodiscard]] bool is_periodic(std::size_t axis) const {
    return is_side(axis, false, DIF_SIDE_PERIODIC);
  }
};

/// The specimen of a seed.
[[nodiscard]] Specimen make_specimen(std::uint64_t seed);

/// The specimen in the words of C, to be read and to be replayed by hand.
[[nodiscard]] std::string dump(const Specimen& specimen);

/// Elements of a specimen in memory, in its type and order, with gaps that hold no number.
class Elements {
 public:
  /// Describes the cells [from, from + size), of a field that is repeated beyond its sides.
  [[nodiscard]] dif_field lay_out(const Specimen& specimen, const Index3& from, const Index3& size);
  /// All of them, without gaps and x fastest.
  [[nodiscard]] dif_field lay_out_plainly(const Specimen& specimen);

 private:
  template <class T>
  void* fill(const Specimen& specimen, const Index3& from, const dif_field& field);

  std::vector<std::byte> memory_;
};

}  // namespace difmesh::attack
