#include "difmesh/values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/names.hpp"
#include "grid/scale_doubt.hpp"

namespace difmesh {
namespace {

void check(const ValueView& values) {
  if (values.data == nullptr) {
    throw Error(ErrorCode::invalid_argument, "values: the field has no data");
  }
  for (const std::int64_t dim : values.dims) {
    if (dim < 1) {
      throw Error(ErrorCode::invalid_grid,
                  "values: " + std::to_string(dim) + " cells along an axis");
    }
  }
}

/// Calls action(value, n) for the cells in order, x fastest.
template <class T, class Action>
void for_each_value(const ValueView& values, const Action& action) {
  const T* const cells = static_cast<const T*>(values.data);
  std::int64_t n = 0;
  for (std::int64_t k = 0; k < values.dims[2]; ++k) {
    for (std::int64_t j = 0; j < values.dims[1]; ++j) {
      const T* const row = cells + j * values.strides[1] + k * values.strides[2];
      for (std::int64_t i = 0; i < values.dims[0]; ++i, ++n) {
        action(row[i * values.strides[0]], n);
      }
    }
  }
}

template <class Fraction>
void write_fractions(const ValueView& values, const ValueRange& range, Fraction* fractions) {
  const DefaultFloatEnvironment environment;
  check(values);
  const double width = range.full - range.empty;
  if (!std::isfinite(range.empty) || !std::isfinite(range.full) || !std::isfinite(width) ||
      width == 0.0) {
    throw Error(ErrorCode::invalid_argument,
                "the values of an empty and of a full cell must be finite and differ");
  }
  with_value_type(values.type, [&]<class T>(T) {
    for_each_value<T>(values, [&](T value, std::int64_t n) {
      const double fraction = (static_cast<double>(value) - range.empty) / width;
      // NaN passes the clamp.
      fractions[n] = static_cast<Fraction>(range.clamp ? std::clamp(fraction, 0.0, 1.0) : fraction);
    });
  });
}

/// The labels that a value of type T can have, ascending.
template <class T>
std::vector<T> labels_of_type(std::span<const std::int64_t> labels) {
  std::vector<T> possible;
  for (const std::int64_t label : labels) {
    const T value = static_cast<T>(label);
    if constexpr (std::is_integral_v<T>) {
      if (std::cmp_equal(value, label)) {
        possible.push_back(value);
      }
    } else if (static_cast<long double>(value) == static_cast<long double>(label)) {
      possible.push_back(value);
    }
  }
  std::sort(possible.begin(), possible.end());
  return possible;
}

}  // namespace

double largest_value(ValueType type) noexcept {
  double largest = 1.0;
  with_value_type(type, [&]<class T>(T) {
    if constexpr (std::is_integral_v<T>) {
      largest = static_cast<double>(std::numeric_limits<T>::max());
    }
  });
  return largest;
}

const char* name_of(ValueType type) noexcept {
  return name_of(kValueTypes, type).data();
}

void fractions_from_values(const ValueView& values, const ValueRange& range, double* fractions) {
  write_fractions(values, range, fractions);
}

void fractions_from_values(const ValueView& values, const ValueRange& range, float* fractions) {
  write_fractions(values, range, fractions);
}

void fractions_from_labels(const ValueView& values, std::span<const std::int64_t> labels,
                           std::uint8_t* fractions) {
  const DefaultFloatEnvironment environment;
  check(values);
  if (labels.empty()) {
    throw Error(ErrorCode::invalid_argument, "labels: there are none");
  }
  with_value_type(values.type, [&]<class T>(T) {
    const std::vector<T> inside = labels_of_type<T>(labels);
    for_each_value<T>(values, [&](T value, std::int64_t n) {
      // One label is the usual case. NaN, which has no place in the order, equals none.
      const bool is_inside =
          inside.size() == 1
              ? value == inside[0]
              : value == value && std::binary_search(inside.begin(), inside.end(), value);
      fractions[n] = is_inside ? 255 : 0;
    });
  });
}

std::optional<ValueExtremes> extremes_of(const ValueView& values) {
  const DefaultFloatEnvironment environment;
  check(values);
  std::optional<ValueExtremes> extremes;
  with_value_type(values.type, [&]<class T>(T) {
    const T* const first = static_cast<const T*>(values.data);
    T low = *first;
    T high = *first;
    for_each_value<T>(values, [&](T value, std::int64_t) {
      // True also for the first number after NaN.
      low = value < low || low != low ? value : low;
      high = value > high || high != high ? value : high;
    });
    if (low == low) {
      extremes = {static_cast<double>(low), static_cast<double>(high)};
    }
  });
  return extremes;
}

std::string doubt_of_scale(const ValueView& values, std::string_view remedy) {
  const DefaultFloatEnvironment environment;
  check(values);
  std::string sentence;
  with_value_type(values.type, [&]<class T>(T) {
    if constexpr (std::is_integral_v<T>) {
      detail::ScaleDoubt<T> doubt;
      doubt.add(values);
      sentence = doubt.sentence(values.type, remedy);
    }
  });
  return sentence;
}

}  // namespace difmesh
