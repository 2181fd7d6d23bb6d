#include "field_facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace difmesh::cli {
namespace {

template <class T>
double fraction_of(T value) {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max());
  } else {
    return static_cast<double>(value);
  }
}

class Looker {
 public:
  Looker(const Grid& grid, double tolerance) : grid_(grid), tolerance_(tolerance) {}

  template <class T>
  FieldFacts look(const FieldView& field) {
    const T* const cells = static_cast<const T*>(field.data);
    const bool is_uniform = grid_.is_uniform();
    double sum = 0.0;
    for (std::int64_t k = 0; k < field.dims[2]; ++k) {
      for (std::int64_t j = 0; j < field.dims[1]; ++j) {
        const T* const row = cells + j * field.strides[1] + k * field.strides[2];
        row_sum_ = 0.0;
        for (std::int64_t i = 0; i < field.dims[0]; ++i) {
          take(fraction_of(row[i * field.strides[0]]), {i, j, k},
               is_uniform ? 1.0 : grid_.width(0, i));
        }
        sum += row_sum_ * (is_uniform ? 1.0 : grid_.width(1, j) * grid_.width(2, k));
      }
    }
    facts_.fraction_volume = is_uniform ? sum * grid_.cell_volume() : sum;
    facts_.cells = field.dims[0] * field.dims[1] * field.dims[2];
    return facts_;
  }

 private:
  void take(double fraction, const Index3& cell, double weight) {
    if (std::isnan(fraction)) {
      ++facts_.nan;
      facts_.first_nan_cell = facts_.first_nan_cell.value_or(cell);
      return;
    }
    facts_.lowest = std::min(facts_.lowest.value_or(fraction), fraction);
    facts_.highest = std::max(facts_.highest.value_or(fraction), fraction);
    row_sum_ += weight * std::clamp(fraction, 0.0, 1.0);
    facts_.empty += fraction == 0.0 ? 1 : 0;
    facts_.full += fraction == 1.0 ? 1 : 0;
    facts_.interfacial += fraction > tolerance_ && fraction < 1.0 - tolerance_ ? 1 : 0;
    facts_.nearly_empty += fraction != 0.0 && std::abs(fraction) <= tolerance_ ? 1 : 0;
    facts_.nearly_full += fraction >= 1.0 - tolerance_ && fraction < 1.0 ? 1 : 0;
    const double overshoot = std::max(-fraction, fraction - 1.0);
    if (overshoot > 0.0) {
      ++facts_.outside;
      if (overshoot > facts_.largest_overshoot) {
        facts_.largest_overshoot = overshoot;
        facts_.largest_overshoot_cell = cell;
      }
    }
  }

  const Grid& grid_;
  double tolerance_;
  double row_sum_ = 0.0;
  FieldFacts facts_;
};

}  // namespace

FieldFacts look_at_field(const FieldView& field, const Grid& grid, double purity_tolerance) {
  Looker looker(grid, purity_tolerance);
  switch (field.type) {
    case ScalarType::float32:
      return looker.look<float>(field);
    case ScalarType::float64:
      return looker.look<double>(field);
    case ScalarType::uint8:
      return looker.look<std::uint8_t>(field);
    case ScalarType::uint16:
      break;
  }
  return looker.look<std::uint16_t>(field);
}

}  // namespace difmesh::cli
