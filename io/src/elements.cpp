#include "elements.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "difmesh/error.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Calls `action` with a value of the C++ type behind a ScalarType.
template <class Action>
void with_type(ScalarType type, const Action& action) {
  switch (type) {
    case ScalarType::float32:
      return action(float{});
    case ScalarType::float64:
      return action(double{});
    case ScalarType::uint8:
      return action(std::uint8_t{});
    case ScalarType::uint16:
      return action(std::uint16_t{});
  }
}

template <class T>
double fraction_of(T element) {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<double>(element) / static_cast<double>(std::numeric_limits<T>::max());
  } else {
    return static_cast<double>(element);
  }
}

template <class T>
T element_of(double fraction, const Index3& cell) {
  if constexpr (std::is_integral_v<T>) {
    if (std::isnan(fraction)) {
      throw Error(ErrorCode::invalid_value,
                  "write_field: cell (" + std::to_string(cell[0]) + "," + std::to_string(cell[1]) +
                      "," + std::to_string(cell[2]) + ") is NaN, which no integer can hold");
    }
    const auto largest = static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<T>(std::lround(std::clamp(fraction, 0.0, 1.0) * largest));
  } else {
    return static_cast<T>(fraction);
  }
}

/// Copies the row of cells (.., j, k) to elements of type `to`, in the machine's byte order.
void copy_row(const FieldView& field, std::int64_t j, std::int64_t k, ScalarType to,
              std::byte* row) {
  const std::int64_t start = j * field.strides[1] + k * field.strides[2];
  const std::int64_t size = size_of(to);
  with_type(field.type, [&]<class From>(From) {
    const From* const cells = static_cast<const From*>(field.data) + start;
    if (field.type == to && field.strides[0] == 1) {
      std::memcpy(row, cells, static_cast<std::size_t>(field.dims[0] * size));
      return;
    }
    with_type(to, [&]<class To>(To) {
      for (std::int64_t i = 0; i < field.dims[0]; ++i) {
        const From cell = cells[i * field.strides[0]];
        To element{};
        if constexpr (std::is_same_v<From, To>) {
          element = cell;
        } else {
          element = element_of<To>(fraction_of(cell), {i, j, k});
        }
        std::memcpy(row + i * size, &element, sizeof element);
      }
    });
  });
}

}  // namespace

std::string to_text(const Index3& dims) {
  return std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
         std::to_string(dims[2]);
}

std::int64_t bytes_promised(const std::filesystem::path& path, const Index3& dims,
                            std::int64_t element_bytes) {
  std::int64_t bytes = element_bytes;
  for (const std::int64_t dim : dims) {
    if (dim < 1) {
      fail_format(path, "a field of " + to_text(dims) + " cells has no cells");
    }
    if (__builtin_mul_overflow(bytes, dim, &bytes)) {
      throw Error(ErrorCode::too_large,
                  quoted(path) + ": the size of " + to_text(dims) + " cells overflows 63 bits");
    }
  }
  return bytes;
}

void swap_bytes(std::byte* elements, std::int64_t bytes, std::int64_t element_bytes) {
  for (std::int64_t at = 0; element_bytes > 1 && at < bytes; at += element_bytes) {
    std::reverse(elements + at, elements + at + element_bytes);
  }
}

void write_elements(const FieldView& field, ScalarType to, const ByteSink& sink) {
  std::vector<std::byte> row(static_cast<std::size_t>(field.dims[0] * size_of(to)));
  for (std::int64_t k = 0; k < field.dims[2]; ++k) {
    for (std::int64_t j = 0; j < field.dims[1]; ++j) {
      copy_row(field, j, k, to, row.data());
      if constexpr (kBigEndianHost) {
        swap_bytes(row.data(), static_cast<std::int64_t>(row.size()), size_of(to));
      }
      sink(row.data(), row.size());
    }
  }
}

}  // namespace difmesh::detail
