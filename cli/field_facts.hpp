#pragma once
/// \file field_facts.hpp
/// What a field holds, good or bad. reconstruct() stops at the first bad cell; this looks on.

#include <cstdint>
#include <optional>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"

namespace difmesh::cli {

/// Counts of cells, and extremes. Fractions of integer types are value / largest value. NaN are
/// counted and take no part in the rest; infinities count as outside [0, 1].
struct FieldFacts {
  std::int64_t cells = 0;
  std::optional<double> lowest;  ///< none where all are NaN
  std::optional<double> highest;
  double fraction_volume = 0.0;   ///< Σγ|K|, γ clamped to [0, 1]
  std::int64_t interfacial = 0;   ///< tolerance < γ < 1 - tolerance
  std::int64_t nearly_empty = 0;  ///< 0 < |γ| <= tolerance
  std::int64_t nearly_full = 0;   ///< 1 - tolerance <= γ < 1
  std::int64_t empty = 0;         ///< γ = 0 exactly
  std::int64_t full = 0;          ///< γ = 1 exactly
  std::int64_t outside = 0;       ///< γ < 0 or γ > 1
  double largest_overshoot = 0.0;
  std::optional<Index3> largest_overshoot_cell;
  std::int64_t nan = 0;
  std::optional<Index3> first_nan_cell;  ///< in the order z, y, x
};

/// One pass over the field, in the order z, y, x.
[[nodiscard]] FieldFacts look_at_field(const FieldView& field, const Grid& grid,
                                       double purity_tolerance);

}  // namespace difmesh::cli
