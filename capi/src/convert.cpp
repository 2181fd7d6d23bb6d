#include "convert.hpp"

namespace difmesh::capi {
namespace {

constexpr char kAxisNames[] = "xyz";
// Three sums of offsets this large stay below 2^63.
constexpr std::int64_t kMostOffset = std::int64_t{1} << 60;

/// The C constants of the value types, in their order.
constexpr std::array<std::int32_t, 10> kElementTypes{
    DIF_FLOAT32, DIF_FLOAT64, DIF_UINT8,  DIF_UINT16, DIF_INT8,
    DIF_INT16,   DIF_INT32,   DIF_UINT32, DIF_INT64,  DIF_UINT64};
constexpr std::ptrdiff_t kScalarTypes = 4;  // the first of them

dif_field read_field_struct(const dif_field* field) {
  required(field, "field");
  dif_field defaults{};
  std::fill_n(defaults.spacing, 3, 1.0);
  const dif_field given = read_struct(field, defaults, "field");
  require_zero(given.reserved, "field");
  return given;
}

/// \pre the dims are valid
ValueView to_values(const dif_field& given) {
  const ValueType type = to_value_type(given.type);
  if (given.data == nullptr) {
    fail_argument("field: data is NULL");
  }
  if (reinterpret_cast<std::uintptr_t>(given.data) % static_cast<std::uintptr_t>(size_of(type)) !=
      0) {
    fail_argument("field: data is not aligned for elements of " + std::to_string(size_of(type)) +
                  " bytes");
  }
  const ValueView view(given.data, type, to_index(given.dims), to_index(given.strides));
  check_strides(view.dims, view.strides, size_of(type), "field");
  return view;
}

/// Likewise.
FieldView to_view(const dif_field& given) {
  const ScalarType type = to_scalar_type(given.type);
  const ValueView values = to_values(given);
  return {values.data, type, values.dims, values.strides};
}

}  // namespace

bool to_bool(std::int32_t value, const char* name) {
  if (value != 0 && value != 1) {
    fail_argument(std::string(name) + " is " + std::to_string(value) + "; 0 and 1 are possible");
  }
  return value == 1;
}

void require_zero(std::int32_t reserved, const char* struct_name) {
  if (reserved != 0) {
    fail_argument(std::string(struct_name) + ": reserved must be 0, got " +
                  std::to_string(reserved));
  }
}

ScalarType to_scalar_type(std::int32_t type) {
  const auto known = std::find(kElementTypes.begin(), kElementTypes.end(), type);
  if (known != kElementTypes.end() && known - kElementTypes.begin() >= kScalarTypes) {
    fail_argument("type is " + std::to_string(type) + ", that of values, of which " +
                  "dif_fractions_from_values() and dif_fractions_from_labels() make fractions");
  }
  if (known == kElementTypes.end()) {
    fail_argument("type is " + std::to_string(type) +
                  "; DIF_FLOAT32, DIF_FLOAT64, DIF_UINT8 and DIF_UINT16 are possible");
  }
  return static_cast<ScalarType>(known - kElementTypes.begin());
}

std::int32_t from_scalar_type(ScalarType type) {
  return kElementTypes[static_cast<std::size_t>(type)];
}

ValueType to_value_type(std::int32_t type) {
  const auto known = std::find(kElementTypes.begin(), kElementTypes.end(), type);
  if (known == kElementTypes.end()) {
    fail_argument("type is " + std::to_string(type) +
                  "; DIF_FLOAT32, DIF_FLOAT64, DIF_INT8 to DIF_INT64 and DIF_UINT8 to DIF_UINT64 "
                  "are possible");
  }
  return static_cast<ValueType>(known - kElementTypes.begin());
}

std::int32_t from_value_type(ValueType type) {
  return kElementTypes[static_cast<std::size_t>(type)];
}

Progress to_progress(dif_progress progress, void* user) {
  if (progress == nullptr) {
    return {};
  }
  return with_callers_settings(
      [progress, user](double share_done) { return progress(user, share_done) == 0; });
}

Index3 to_index(const std::int64_t (&from)[3]) {
  return {from[0], from[1], from[2]};
}

Vec3 to_vec(const double (&from)[3]) {
  return {from[0], from[1], from[2]};
}

std::span<const Vec3> to_points(const double* numbers, std::int64_t count) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const Vec3*>(numbers), to_size(count)};
}

std::size_t to_size(std::int64_t count) {
  return static_cast<std::size_t>(count);
}

void check_strides(const Index3& dims, const Index3& strides, std::int64_t element_bytes,
                   const char* name) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t most = kMostOffset / element_bytes / dims[axis];
    if (strides[axis] > most || strides[axis] < -most) {
      fail_argument(std::string(name) + ": the stride in " + kAxisNames[axis] + ", " +
                    std::to_string(strides[axis]) + ", leads beyond any memory");
    }
  }
}

void check_result_strides(const Index3& dims, const Index3& strides, std::int64_t element_bytes,
                          const char* name) {
  check_strides(dims, strides, element_bytes, name);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (dims[axis] > 1 && strides[axis] == 0) {
      fail_argument(std::string(name) + ": the stride in " + kAxisNames[axis] +
                    " is 0: cells would overwrite each other");
    }
  }
}

namespace {

/// Of dif_field or dif_grid.
template <class Given>
Grid grid_of(const Given& given) {
  Grid grid{to_index(given.dims), to_vec(given.origin), to_vec(given.spacing)};
  validate(Grid{.dims = grid.dims});
  const double* const faces[3] = {given.faces_x, given.faces_y, given.faces_z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (faces[axis] != nullptr) {
      grid.faces[axis].assign(faces[axis], faces[axis] + grid.dims[axis] + 1);
    }
  }
  validate(grid);
  return grid;
}

}  // namespace

Field to_field(const dif_field* field) {
  const dif_field given = read_field_struct(field);
  const Grid grid = grid_of(given);
  return {to_view(given), grid};
}

void require_uniform(const dif_field* field, const char* why) {
  const dif_field given = read_field_struct(field);
  if (given.faces_x != nullptr || given.faces_y != nullptr || given.faces_z != nullptr) {
    fail_argument("field: the axes must be uniform, " + std::string(why));
  }
}

FieldView to_view(const dif_field* field) {
  const dif_field given = read_field_struct(field);
  validate(Grid{.dims = to_index(given.dims)});
  return to_view(given);
}

ValueView to_values(const dif_field* values) {
  const dif_field given = read_field_struct(values);
  validate(Grid{.dims = to_index(given.dims)});
  return to_values(given);
}

Grid to_grid(const dif_grid* grid) {
  required(grid, "grid");
  dif_grid defaults{};
  std::fill_n(defaults.spacing, 3, 1.0);
  const dif_grid given = read_struct(grid, defaults, "grid");
  return grid_of(given);
}

Boundary to_boundary(const std::int32_t (&from)[6]) {
  Boundary boundary{};
  for (std::size_t side = 0; side < 6; ++side) {
    boundary[side] =
        to_choice(from[side], Side::open, kSides, "boundary[" + std::to_string(side) + "]");
  }
  return boundary;
}

Options to_options(const dif_options* options) {
  dif_options defaults{};
  dif_options_init(&defaults, sizeof defaults);
  const dif_options given = read_struct(options, defaults, "options");
  require_zero(given.reserved, "options");
  Options result;
  result.boundary = to_boundary(given.boundary);
  result.placement = to_choice(given.placement, result.placement, kPlacements, "placement");
  result.normals = to_choice(given.normals, result.normals, kNormals, "normals");
  result.vertex_normals = to_bool(given.vertex_normals, "vertex_normals");
  result.edge_ids = to_bool(given.edge_ids, "edge_ids");
  result.purity_tolerance = given.purity_tolerance;
  result.overshoot_bound = given.overshoot_bound;
  result.clearance = given.clearance;
  result.threads = given.threads;
  result.progress = to_progress(given.progress, given.progress_user);
  return result;
}

}  // namespace difmesh::capi
