#pragma once
// From the structs of C, checked, to those of C++.

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "boundary.hpp"
#include "difmesh/error.hpp"
#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/names.hpp"
#include "difmesh/options.hpp"
#include "difmesh/values.hpp"

namespace difmesh::capi {

/// \throw Error invalid_argument, naming the option
[[nodiscard]] bool to_bool(std::int32_t value, const char* name);
/// The C++ constant of a C one: 0 is the default, the others follow from 1 on in the order of their
/// names.
/// \throw Error invalid_argument, naming the option
template <class Enum, std::size_t count>
[[nodiscard]] Enum to_choice(std::int32_t value, Enum default_value,
                             const std::array<Named<Enum>, count>& choices,
                             const std::string& name) {
  if (value == 0) {
    return default_value;
  }
  if (value < 0 || value > static_cast<std::int32_t>(count)) {
    fail_argument(name + " is " + std::to_string(value) + "; 0 to " + std::to_string(count) +
                  " are possible");
  }
  return choices[static_cast<std::size_t>(value - 1)].value;
}
void require_zero(std::int32_t reserved, const char* struct_name);
[[nodiscard]] ScalarType to_scalar_type(std::int32_t type);
[[nodiscard]] std::int32_t from_scalar_type(ScalarType type);
[[nodiscard]] ValueType to_value_type(std::int32_t type);
[[nodiscard]] std::int32_t from_value_type(ValueType type);
[[nodiscard]] Progress to_progress(dif_progress progress, void* user);

[[nodiscard]] Index3 to_index(const std::int64_t (&from)[3]);
[[nodiscard]] Vec3 to_vec(const double (&from)[3]);
/// Three numbers each, as many as `count` says. \pre checked by required_array()
[[nodiscard]] std::span<const Vec3> to_points(const double* numbers, std::int64_t count);

/// A field and the grid that it covers.
struct Field {
  FieldView view;
  Grid grid;
};
/// Checks the struct; the grid, and strides whose offsets would overflow. \throw Error, Failure
[[nodiscard]] Field to_field(const dif_field* field);
/// Refuses faces of stretched axes. \throw Error, Failure
void require_uniform(const dif_field* field, const char* why);
/// As to_field() without origin and spacing.
[[nodiscard]] FieldView to_view(const dif_field* field);
/// The same of values, whose type may be any.
[[nodiscard]] ValueView to_values(const dif_field* values);
[[nodiscard]] Grid to_grid(const dif_grid* grid);
[[nodiscard]] Boundary to_boundary(const std::int32_t (&from)[6]);
[[nodiscard]] Options to_options(const dif_options* options);

/// Strides whose offsets, in bytes, do not fit into 62 bits are refused.
void check_strides(const Index3& dims, const Index3& strides, std::int64_t element_bytes,
                   const char* name);
/// The same of arrays to be written: strides of 0 along axes of more than one cell are refused too.
void check_result_strides(const Index3& dims, const Index3& strides, std::int64_t element_bytes,
                          const char* name);

/// \pre not negative
[[nodiscard]] std::size_t to_size(std::int64_t count);

}  // namespace difmesh::capi
