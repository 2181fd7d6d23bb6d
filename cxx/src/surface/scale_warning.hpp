#pragma once
// Whether integers may be a mask or a segmentation that was taken for fractions.

#include <cstdint>
#include <string>
#include <string_view>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/options.hpp"
#include "difmesh/report.hpp"
#include "difmesh/values.hpp"
#include "grid/scale_doubt.hpp"

namespace difmesh::detail {

/// A body of some size has more full cells than interfacial ones, which settles it without a pass:
/// no cell that is not full counts for more than 1, nor for anything where it is not interfacial.
[[nodiscard]] inline bool may_lack_full_cells(ScalarType type, const Grid& grid,
                                              const Options& options, const Report& report) {
  if (type != ScalarType::uint8 && type != ScalarType::uint16) {
    return false;
  }
  const bool all_seen = options.purity_tolerance * largest_value(value_type_of(type)) < 1.0;
  const auto interfacial = static_cast<double>(report.interfacial_cells);
  return !all_seen || !grid.is_uniform() ||
         (interfacial > 0.0 && report.fraction_volume <= interfacial * grid.cell_volume());
}

/// doubt_of_scale() of a field whose slabs come one by one.
class SlabDoubt {
 public:
  void add(const FieldView& slab) {
    if (slab.type == ScalarType::uint8) {
      bytes_.add(ValueView(slab));
    } else if (slab.type == ScalarType::uint16) {
      words_.add(ValueView(slab));
    }
  }
  /// Empty where there is no doubt.
  [[nodiscard]] std::string sentence(ScalarType type, std::string_view remedy) const {
    return type == ScalarType::uint8 ? bytes_.sentence(value_type_of(type), remedy)
                                     : words_.sentence(value_type_of(type), remedy);
  }

 private:
  ScaleDoubt<std::uint8_t> bytes_;
  ScaleDoubt<std::uint16_t> words_;
};

}  // namespace difmesh::detail
