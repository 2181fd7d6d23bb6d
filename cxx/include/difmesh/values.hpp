#pragma once
/// \file values.hpp
/// From the values of scanners and segmentations to fractions.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"

namespace difmesh {

/// Element types of values. The first four are those of ScalarType.
enum class ValueType : std::uint8_t {
  float32,
  float64,
  uint8,
  uint16,
  int8,
  int16,
  int32,
  uint32,
  int64,
  uint64
};

/// Bytes of one element.
[[nodiscard]] constexpr std::int64_t size_of(ValueType type) noexcept {
  constexpr std::array<std::int64_t, 10> bytes{4, 8, 1, 2, 1, 2, 4, 4, 8, 8};
  return bytes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_integer(ValueType type) noexcept {
  return type != ValueType::float32 && type != ValueType::float64;
}
[[nodiscard]] constexpr ValueType value_type_of(ScalarType type) noexcept {
  return static_cast<ValueType>(type);
}
/// What stands for 1 where nothing else is said: the largest value of an integer type, else 1.
[[nodiscard]] double largest_value(ValueType type) noexcept;
/// "float32", "int16" and so on.
[[nodiscard]] const char* name_of(ValueType type) noexcept;

/// Calls `action` with a value of the C++ type of a ValueType.
template <class Action>
void with_value_type(ValueType type, const Action& action) {
  switch (type) {
    case ValueType::float32:
      return action(float{});
    case ValueType::float64:
      return action(double{});
    case ValueType::uint8:
      return action(std::uint8_t{});
    case ValueType::uint16:
      return action(std::uint16_t{});
    case ValueType::int8:
      return action(std::int8_t{});
    case ValueType::int16:
      return action(std::int16_t{});
    case ValueType::int32:
      return action(std::int32_t{});
    case ValueType::uint32:
      return action(std::uint32_t{});
    case ValueType::int64:
      return action(std::int64_t{});
    case ValueType::uint64:
      return action(std::uint64_t{});
  }
}

/// A view of values in memory, laid out as that of fractions is; see FieldView.
struct ValueView {
  const void* data = nullptr;  ///< element of cell (0,0,0), aligned for its type
  ValueType type = ValueType::float64;
  Index3 dims{0, 0, 0};     ///< cells in x, y, z
  Index3 strides{0, 0, 0};  ///< elements from one cell to the next in x, y, z

  ValueView() = default;
  ValueView(const void* cells, ValueType value_type, const Index3& size, const Index3& steps)
      : data(cells), type(value_type), dims(size), strides(steps) {}
  explicit ValueView(const FieldView& field)
      : data(field.data),
        type(value_type_of(field.type)),
        dims(field.dims),
        strides(field.strides) {}
};

/// The values that stand for the fractions 0 and 1; between them fractions are linear. `full` may
/// be the smaller one.
struct ValueRange {
  double empty = 0.0;
  double full = 1.0;
  bool clamp = true;  ///< values beyond count as 0 or 1; otherwise their fractions are beyond [0,1]
};

/// Writes (value - empty) / (full - empty), one fraction per cell, x fastest. NaN stay NaN.
/// \throw Error invalid_argument for a view without data, values that are not finite or are equal;
///   invalid_grid for dims < 1. Cost: one pass. Thread safety: concurrent calls are safe.
void fractions_from_values(const ValueView& values, const ValueRange& range, double* fractions);
/// The same, rounded to the nearest float.
void fractions_from_values(const ValueView& values, const ValueRange& range, float* fractions);

/// Writes 255, that is 1, where a value is one of `labels`, else 0; one per cell, x fastest. Exact
/// for integers of all sizes; a float is a label where it is equal to it. Errors and cost:
/// likewise, and invalid_argument where there are no labels.
void fractions_from_labels(const ValueView& values, std::span<const std::int64_t> labels,
                           std::uint8_t* fractions);

struct ValueExtremes {
  double lowest = 0.0;
  double highest = 0.0;
};
/// Of all values but NaN; nothing where there are no others. Errors and cost: likewise.
[[nodiscard]] std::optional<ValueExtremes> extremes_of(const ValueView& values);

/// What reconstruct() names as the remedy of such a doubt.
inline constexpr std::string_view kScaleRemedy = "a full value or labels";
/// Says in a sentence that integers are hardly shares of the largest value of their type, which
/// counts as full where nothing else is said: "the highest value is 200, and 255 of uint8 counts as
/// full unless `remedy` are given". So it is where the largest value does not occur, some value is
/// above 0, and none reaches half of it or there are at most 16 different ones, as in masks and
/// segmentations. Otherwise, and for floats, "". Errors: likewise. Cost: one pass at most, which
/// ends at the first full cell.
[[nodiscard]] std::string doubt_of_scale(const ValueView& values,
                                         std::string_view remedy = kScaleRemedy);

}  // namespace difmesh
