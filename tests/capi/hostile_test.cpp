// Every function against bad arguments: a status that says so, never a crash. The table must name
// every function that the library exports.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "handles.hpp"

namespace {

namespace test = difmesh::test;

constexpr dif_status kArgument = DIF_ERROR_INVALID_ARGUMENT;
constexpr dif_status kGrid = DIF_ERROR_INVALID_GRID;
constexpr dif_status kStruct = DIF_ERROR_STRUCT;
const double kNaN = std::nan("");
const double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kHuge = std::numeric_limits<std::int64_t>::max();

// What good calls need, and a place for results that must stay NULL.
struct Bench {
  test::OwnedField values = test::blob({9, 8, 7});
  dif_field field = test::c_field(values);
  dif_options options = test::prepared(dif_options_init);
  dif_grid grid =
      test::c_grid({.dims = {5, 5, 5}, .origin = {-1.5, -1.5, -1.5}, .spacing = {0.6, 0.6, 0.6}});
  test::MeshHandle mesh = test::c_reconstruct(field);
  test::ShapeHandle shape;
  dif_function_options function_options = test::prepared(dif_function_options_init);
  dif_triangle_options triangle_options = test::prepared(dif_triangle_options_init);
  dif_shape_options shape_options = test::prepared(dif_shape_options_init);
  dif_distance_options distance_options = test::prepared(dif_distance_options_init);
  dif_curvature_options curvature_options = test::prepared(dif_curvature_options_init);
  dif_smoothing_options smoothing_options = test::prepared(dif_smoothing_options_init);
  dif_mollify_options mollify_options = test::prepared(dif_mollify_options_init);
  dif_block block = test::prepared(dif_block_init);
  dif_plane_arrays arrays = test::prepared(dif_plane_arrays_init);
  dif_surface_arrays surface_arrays = test::prepared(dif_surface_arrays_init);
  std::int64_t strides[3] = {1, 9, 72};
  std::vector<double> numbers = std::vector<double>(3000, 0.5);
  std::vector<std::uint32_t> indices = std::vector<std::uint32_t>(3000, 0);
  std::int64_t cells[3] = {1, 2, 3};
  double spacing[3] = {1, 1, 1};
  dif_mesh* result = nullptr;
  const double* doubles = nullptr;
  const std::uint32_t* words = nullptr;
  const std::uint64_t* ids = nullptr;
  std::int64_t count = 0;
  const char* text = nullptr;
  dif_mesh_write_options write_options = test::prepared(dif_mesh_write_options_init);
  dif_mesh_write_report write_report = test::prepared(dif_mesh_write_report_init);
  std::vector<std::int16_t> raw_values = std::vector<std::int16_t>(64, 3);
  dif_field raw = values_of(raw_values);
  std::int64_t labels[2] = {3, -1};
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(64, 7);
  dif_field_read_options read_options = test::prepared(dif_field_read_options_init);
  dif_mesh_read_options mesh_options = test::prepared(dif_mesh_read_options_init);

  static dif_field values_of(const std::vector<std::int16_t>& values) {
    const std::int64_t dims[3] = {4, 4, 4};
    dif_field field{};
    REQUIRE(dif_field_init(&field, sizeof field, values.data(), DIF_INT16, dims) == DIF_OK);
    return field;
  }

  // Faces 0, 1, 2, third, 4, ...
  const double* faces(double third) {
    std::iota(numbers.begin(), numbers.end(), 0.0);
    numbers[3] = third;
    return numbers.data();
  }

  Bench() {
    dif_shape* made = nullptr;
    REQUIRE(dif_shape_create(nullptr, &made) == DIF_OK);
    shape.reset(made);
    block.dims[0] = 9;
    block.dims[1] = 8;
    block.dims[2] = 7;
    arrays.offset = numbers.data();
    arrays.strides[0] = 1;
    arrays.strides[1] = 9;
    arrays.strides[2] = 72;
  }
};

struct Case {
  std::string function;
  std::string what;
  dif_status expected;
  std::function<dif_status(Bench&)> call;
};

std::int32_t plus_one(void*, std::int64_t count, const double*, double* values) {
  std::fill_n(values, count, 1.0);
  return 0;
}
std::int32_t no_number(void*, std::int64_t count, const double*, double* values) {
  std::fill_n(values, count, std::nan(""));
  return 0;
}
std::int32_t stop(void*, std::int64_t, const double*, double*) {
  return 1;
}

dif_status reconstruct(Bench& b) {
  b.result = reinterpret_cast<dif_mesh*>(&b);
  const dif_status status = dif_reconstruct(&b.field, &b.options, &b.result);
  CHECK(b.result == nullptr);
  return status;
}

dif_status from_shape(Bench& b) {
  return dif_fractions_from_shape(&b.grid, b.shape.get(), &b.function_options, nullptr,
                                  b.numbers.data());
}
dif_status from_mesh(Bench& b) {
  return dif_fractions_from_mesh(&b.grid, b.mesh.get(), &b.triangle_options, nullptr,
                                 b.numbers.data());
}
dif_status create_shape(Bench& b) {
  dif_shape* shape = reinterpret_cast<dif_shape*>(&b);
  const dif_status status = dif_shape_create(&b.shape_options, &shape);
  CHECK(shape == nullptr);
  return status;
}
dif_status field_planes(Bench& b) {
  return dif_field_planes(&b.field, &b.options, &b.arrays);
}
dif_status cell_surfaces(Bench& b) {
  return dif_cell_surfaces(&b.field, &b.options, DIF_SURFACES_FOR_CURVATURE, 1, b.cells,
                           &b.surface_arrays);
}
dif_status interfacial_cells(Bench& b) {
  return dif_interfacial_cells(&b.field, &b.options, 0, nullptr, &b.count);
}
dif_status cell_curvature(Bench& b) {
  return dif_cell_curvature(&b.field, &b.options, b.numbers.data(), b.strides);
}
dif_status reconstruct_block(Bench& b) {
  dif_grid whole = test::c_grid({.dims = {9, 8, 7}});
  return dif_reconstruct_block(&b.field, &b.block, &whole, &b.options, &b.result);
}

// `name` of a struct of the bench is changed so that `call` must refuse.
#define CHANGED(function, change, expected, call)             \
  {                                                           \
    function, #change, expected, [](Bench& b) -> dif_status { \
      b.change;                                               \
      return call(b);                                         \
    }                                                         \
  }
#define CALL(function, expression, expected)                      \
  {                                                               \
    function, #expression, expected, [](Bench& b) -> dif_status { \
      static_cast<void>(b);                                       \
      return expression;                                          \
    }                                                             \
  }

std::vector<Case> field_cases() {
  const char* const f = "dif_reconstruct";
  return {
      CALL("dif_field_init", dif_field_init(nullptr, sizeof b.field, &b, DIF_FLOAT64, b.cells),
           kArgument),
      CALL("dif_field_init",
           dif_field_init(&b.field, sizeof b.field, nullptr, DIF_FLOAT64, b.cells), kArgument),
      CALL("dif_field_init", dif_field_init(&b.field, sizeof b.field, &b, DIF_FLOAT64, nullptr),
           kArgument),
      CALL("dif_field_init", dif_field_init(&b.field, sizeof b.field, &b, 0, b.cells), kArgument),
      CALL("dif_field_init", dif_field_init(&b.field, sizeof b.field, &b, 5, b.cells), kArgument),
      CALL("dif_field_init", dif_field_init(&b.field, sizeof b.field, &b, -1, b.cells), kArgument),
      CALL("dif_field_init", dif_field_init(&b.field, 12, &b, DIF_UINT8, b.cells), kStruct),
      CALL("dif_options_init", dif_options_init(nullptr, 96), kArgument),
      CALL("dif_report_init", dif_report_init(nullptr, 168), kArgument),
      CALL(f, dif_reconstruct(nullptr, nullptr, &b.result), kArgument),
      CALL(f, dif_reconstruct(&b.field, nullptr, nullptr), kArgument),
      CHANGED(f, field.struct_size = 0, kStruct, reconstruct),
      CHANGED(f, field.data = nullptr, kArgument, reconstruct),
      CHANGED(f, field.data = reinterpret_cast<const char*>(b.values.values.data()) + 1, kArgument,
              reconstruct),
      CHANGED(f, field.type = 99, kArgument, reconstruct),
      CHANGED(f, field.type = std::numeric_limits<std::int32_t>::min(), kArgument, reconstruct),
      CHANGED(f, field.reserved = 1, kArgument, reconstruct),
      CHANGED(f, field.dims[1] = 0, kGrid, reconstruct),
      CHANGED(f, field.dims[1] = -5, kGrid, reconstruct),
      CHANGED(f, field.dims[2] = kHuge, kGrid, reconstruct),
      CHANGED(f, field.strides[0] = kHuge, kArgument, reconstruct),
      CHANGED(f, field.strides[2] = std::numeric_limits<std::int64_t>::min(), kArgument,
              reconstruct),
      CHANGED(f, field.spacing[0] = 0.0, kGrid, reconstruct),
      CHANGED(f, field.spacing[0] = -1.0, kGrid, reconstruct),
      CHANGED(f, field.spacing[1] = kNaN, kGrid, reconstruct),
      CHANGED(f, field.spacing[1] = kInfinity, kGrid, reconstruct),
      CHANGED(f, field.spacing[1] = 1e-309, kGrid, reconstruct),
      CHANGED(f, field.spacing[1] = 1e91, kGrid, reconstruct),
      CHANGED(f, field.origin[2] = kNaN, kGrid, reconstruct),
      CHANGED(f, field.origin[2] = 1e300, kGrid, reconstruct),
      CHANGED(f, field.faces_x = b.numbers.data(), kGrid, reconstruct),
      CHANGED(f, field.faces_z = b.faces(kNaN), kGrid, reconstruct),
      CHANGED(f, field.faces_z = b.faces(kInfinity), kGrid, reconstruct),
      CHANGED(f, field.faces_z = b.faces(2.0), kGrid, reconstruct),
      CHANGED(f, field.faces_z = b.faces(4.0), kGrid, reconstruct),
      CHANGED(f, field.faces_z = b.faces(2.0 + 1e-13), kGrid, reconstruct),
      CHANGED(f, values.values[77] = kNaN, DIF_ERROR_INVALID_VALUE, reconstruct),
      CHANGED(f, values.values[77] = -kInfinity, DIF_ERROR_INVALID_VALUE, reconstruct),
      CHANGED(f, values.values[77] = 1.2, DIF_ERROR_INVALID_VALUE, reconstruct),
      CHANGED(f, options.struct_size = 4, kStruct, reconstruct),
      CHANGED(f, options.placement = 6, kArgument, reconstruct),
      CHANGED(f, options.placement = -1, kArgument, reconstruct),
      CHANGED(f, options.normals = 6, kArgument, reconstruct),
      CHANGED(f, options.boundary[3] = 6, kArgument, reconstruct),
      CHANGED(f, options.boundary[5] = -2, kArgument, reconstruct),
      CHANGED(f, options.boundary[0] = DIF_SIDE_PERIODIC, kArgument, reconstruct),
      CHANGED(f, options.vertex_normals = 2, kArgument, reconstruct),
      CHANGED(f, options.edge_ids = -1, kArgument, reconstruct),
      CHANGED(f, options.purity_tolerance = kNaN, kArgument, reconstruct),
      CHANGED(f, options.overshoot_bound = -0.1, kArgument, reconstruct),
      CHANGED(f, options.clearance = 0.5, kArgument, reconstruct),
      CHANGED(f, options.threads = -1, kArgument, reconstruct),
      CHANGED(f, options.reserved = 7, kArgument, reconstruct),
  };
}

std::vector<Case> mesh_cases() {
  return {
      CALL("dif_mesh_positions", dif_mesh_positions(nullptr, &b.doubles, &b.count), kArgument),
      CALL("dif_mesh_positions", dif_mesh_positions(b.mesh.get(), nullptr, &b.count), kArgument),
      CALL("dif_mesh_positions", dif_mesh_positions(b.mesh.get(), &b.doubles, nullptr), kArgument),
      CALL("dif_mesh_triangles", dif_mesh_triangles(nullptr, &b.words, &b.count), kArgument),
      CALL("dif_mesh_triangles", dif_mesh_triangles(b.mesh.get(), nullptr, &b.count), kArgument),
      CALL("dif_mesh_triangles", dif_mesh_triangles(b.mesh.get(), &b.words, nullptr), kArgument),
      CALL("dif_mesh_normals", dif_mesh_normals(nullptr, &b.doubles, &b.count), kArgument),
      CALL("dif_mesh_normals", dif_mesh_normals(b.mesh.get(), nullptr, &b.count), kArgument),
      CALL("dif_mesh_normals", dif_mesh_normals(b.mesh.get(), &b.doubles, nullptr), kArgument),
      CALL("dif_mesh_edge_ids", dif_mesh_edge_ids(nullptr, &b.ids, &b.count), kArgument),
      CALL("dif_mesh_edge_ids", dif_mesh_edge_ids(b.mesh.get(), nullptr, &b.count), kArgument),
      CALL("dif_mesh_edge_ids", dif_mesh_edge_ids(b.mesh.get(), &b.ids, nullptr), kArgument),
      CALL("dif_mesh_report", dif_mesh_report(nullptr, nullptr), kArgument),
      CALL("dif_mesh_report", dif_mesh_report(b.mesh.get(), nullptr), kArgument),
      CALL("dif_mesh_from_arrays", dif_mesh_from_arrays(nullptr, 3, b.indices.data(), 1, &b.result),
           kArgument),
      CALL("dif_mesh_from_arrays", dif_mesh_from_arrays(b.numbers.data(), 3, nullptr, 1, &b.result),
           kArgument),
      CALL("dif_mesh_from_arrays",
           dif_mesh_from_arrays(b.numbers.data(), 3, b.indices.data(), 1, nullptr), kArgument),
      CALL("dif_mesh_from_arrays",
           dif_mesh_from_arrays(b.numbers.data(), -3, b.indices.data(), 1, &b.result), kArgument),
      CALL("dif_mesh_from_arrays",
           dif_mesh_from_arrays(b.numbers.data(), 3, b.indices.data(), -1, &b.result), kArgument),
      CALL("dif_mesh_from_arrays",
           dif_mesh_from_arrays(b.numbers.data(), 0, b.indices.data(), 1, &b.result), kArgument),
      CALL("dif_mesh_from_arrays",
           dif_mesh_from_arrays(b.numbers.data(), kHuge, b.indices.data(), 1, &b.result),
           DIF_ERROR_TOO_LARGE),
      CALL("dif_mesh_set_normals", dif_mesh_set_normals(nullptr, b.numbers.data()), kArgument),
      CALL("dif_mesh_set_edge_ids", dif_mesh_set_edge_ids(nullptr, nullptr), kArgument),
      CALL("dif_mesh_set_scalars", dif_mesh_set_scalars(nullptr, "a", b.numbers.data()), kArgument),
      CALL("dif_mesh_set_scalars", dif_mesh_set_scalars(b.mesh.get(), nullptr, b.numbers.data()),
           kArgument),
      CALL("dif_mesh_set_scalars", dif_mesh_set_scalars(b.mesh.get(), "", b.numbers.data()),
           kArgument),
      CALL("dif_mesh_set_scalars", dif_mesh_set_scalars(b.mesh.get(), "a b", b.numbers.data()),
           kArgument),
      CALL("dif_mesh_set_scalars", dif_mesh_set_scalars(b.mesh.get(), "\xC3\xA4", nullptr),
           kArgument),
      CALL("dif_mesh_scalars_name", dif_mesh_scalars_name(nullptr, 0, &b.text), kArgument),
      CALL("dif_mesh_scalars_name", dif_mesh_scalars_name(b.mesh.get(), -1, &b.text), kArgument),
      CALL("dif_mesh_scalars_name", dif_mesh_scalars_name(b.mesh.get(), 0, nullptr), kArgument),
      CALL("dif_mesh_warning", dif_mesh_warning(nullptr, 0, &b.text), kArgument),
      CALL("dif_mesh_warning", dif_mesh_warning(b.mesh.get(), -1, &b.text), kArgument),
      CALL("dif_mesh_warning", dif_mesh_warning(b.mesh.get(), 0, nullptr), kArgument),
      CALL("dif_mesh_scalars", dif_mesh_scalars(nullptr, "a", &b.doubles, &b.count), kArgument),
      CALL("dif_mesh_scalars", dif_mesh_scalars(b.mesh.get(), nullptr, &b.doubles, &b.count),
           kArgument),
      CALL("dif_mesh_scalars", dif_mesh_scalars(b.mesh.get(), "a", nullptr, &b.count), kArgument),
      CALL("dif_mesh_scalars", dif_mesh_scalars(b.mesh.get(), "a", &b.doubles, nullptr), kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(nullptr, DIF_FLOAT64, 3, 3000, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_FLOAT64, 3, 3000, nullptr), kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_FLOAT64, 2, 3000, b.numbers.data()),
           kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_FLOAT64, kHuge, 3000, b.numbers.data()),
           kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_FLOAT64, 3, 5, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_FLOAT64, 3, -5, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_positions",
           dif_mesh_copy_positions(b.mesh.get(), DIF_UINT8, 3, 3000, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_normals",
           dif_mesh_copy_normals(nullptr, DIF_FLOAT64, 3, 3000, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_normals",
           dif_mesh_copy_normals(b.mesh.get(), DIF_FLOAT64, 3, 3000, b.numbers.data()), kArgument),
      CALL("dif_mesh_copy_triangles",
           dif_mesh_copy_triangles(nullptr, DIF_INT32, 0, 3, 3000, b.indices.data()), kArgument),
      CALL("dif_mesh_copy_triangles",
           dif_mesh_copy_triangles(b.mesh.get(), DIF_FLOAT32, 0, 3, 3000, b.indices.data()),
           kArgument),
      CALL("dif_mesh_copy_triangles",
           dif_mesh_copy_triangles(b.mesh.get(), DIF_INT32, -1, 3, 3000, b.indices.data()),
           kArgument),
      CALL("dif_mesh_copy_triangles",
           dif_mesh_copy_triangles(b.mesh.get(), DIF_INT64, kHuge, 3, 3000, b.numbers.data()),
           DIF_ERROR_TOO_LARGE),
      CALL("dif_mesh_copy_triangles",
           dif_mesh_copy_triangles(b.mesh.get(), DIF_INT32, 0, 3, 0, b.indices.data()), kArgument),
      CALL("dif_measure_init", dif_measure_init(nullptr, 168), kArgument),
      CALL("dif_mesh_measure", dif_mesh_measure(b.mesh.get(), nullptr), kArgument),
      {"dif_mesh_measure", "of NULL, and of a mesh with NaN", kArgument,
       [](Bench& b) {
         dif_measure measure = test::prepared(dif_measure_init);
         CHECK(dif_mesh_measure(nullptr, &measure) == kArgument);
         b.numbers[4] = kNaN;
         REQUIRE(dif_mesh_from_arrays(b.numbers.data(), 2, nullptr, 0, &b.result) == DIF_OK);
         const test::MeshHandle handle(b.result);
         return dif_mesh_measure(b.result, &measure);
       }},
  };
}

dif_status smooth(Bench& b) {
  b.result = reinterpret_cast<dif_mesh*>(&b);
  const dif_status status = dif_mesh_smooth(b.mesh.get(), &b.grid, &b.smoothing_options, &b.result);
  CHECK(b.result == nullptr);
  return status;
}
dif_status curve(Bench& b) {
  return dif_mesh_curvature(b.mesh.get(), &b.curvature_options, b.numbers.data(), nullptr, nullptr,
                            nullptr);
}
dif_status mollify(Bench& b) {
  return dif_mollify(&b.field, &b.mollify_options, b.numbers.data());
}

std::vector<Case> smoothing_cases() {
  const char* const s = "dif_mesh_smooth";
  const char* const c = "dif_mesh_curvature";
  const char* const m = "dif_mollify";
  return {
    CALL("dif_curvature_options_init", dif_curvature_options_init(nullptr, 32), kArgument),
        CALL(c, dif_mesh_curvature(nullptr, nullptr, b.numbers.data(), nullptr, nullptr, nullptr),
             kArgument),
        CHANGED(c, curvature_options.struct_size = 3, kStruct, curve),
        CHANGED(c, curvature_options.rings = 0, kArgument, curve),
        CHANGED(c, curvature_options.rings = 9, kArgument, curve),
        CHANGED(c, curvature_options.threads = -1, kArgument, curve),
        CALL("dif_smoothing_options_init", dif_smoothing_options_init(nullptr, 96), kArgument),
        CALL(s, dif_mesh_smooth(nullptr, nullptr, nullptr, &b.result), kArgument),
        CALL(s, dif_mesh_smooth(b.mesh.get(), nullptr, nullptr, nullptr), kArgument),
        CHANGED(s, smoothing_options.struct_size = 0, kStruct, smooth),
        CHANGED(s, smoothing_options.kind = 5, kArgument, smooth),
        CHANGED(s, smoothing_options.kind = -1, kArgument, smooth),
        CHANGED(s, smoothing_options.steps = -1, kArgument, smooth),
        CHANGED(s, smoothing_options.boundary = 3, kArgument, smooth),
        CHANGED(s, smoothing_options.threads = -1, kArgument, smooth),
        CHANGED(s, smoothing_options.lambda = kNaN, kArgument, smooth),
        CHANGED(s, smoothing_options.pass_band = -0.1, kArgument, smooth),
        CHANGED(s, smoothing_options.kind = DIF_SMOOTHING_LAPLACIAN;
                b.smoothing_options.factor = 2.0, kArgument, smooth),
        CHANGED(s, smoothing_options.kind = DIF_SMOOTHING_FLOW;
                b.smoothing_options.time = kInfinity, kArgument, smooth),
        CHANGED(s, smoothing_options.kind = DIF_SMOOTHING_FLOW;
                b.smoothing_options.residual = 0.0, kArgument, smooth),
        CHANGED(s, smoothing_options.kind = DIF_SMOOTHING_CONSTRAINED, kArgument, smooth),
        CALL(s,
             (b.smoothing_options.kind = DIF_SMOOTHING_CONSTRAINED,
              dif_mesh_smooth(b.mesh.get(), nullptr, &b.smoothing_options, &b.result)),
             kArgument),
        CALL("dif_mollify_options_init", dif_mollify_options_init(nullptr, 64), kArgument),
        CALL(m, dif_mollify(nullptr, nullptr, b.numbers.data()), kArgument),
        CALL(m, dif_mollify(&b.field, nullptr, nullptr), kArgument),
        CHANGED(m, mollify_options.struct_size = 5, kStruct, mollify),
        CHANGED(m, mollify_options.radius = 0.5, kArgument, mollify),
        CHANGED(m, mollify_options.radius = kNaN, kArgument, mollify),
        CHANGED(m, mollify_options.boundary[2] = 6, kArgument, mollify),
        CHANGED(m, mollify_options.boundary[2] = DIF_SIDE_PERIODIC, kArgument, mollify),
        CHANGED(m, mollify_options.threads = -1, kArgument, mollify),
        CHANGED(m, mollify_options.reserved = 1, kArgument, mollify),
        CHANGED(m, field.dims[0] = 0, kGrid, mollify),
        CHANGED(m, field.faces_z = b.faces(3.1), kArgument, mollify),
        CHANGED(m, values.values[33] = kNaN, DIF_ERROR_INVALID_VALUE, mollify),
  };
}

std::vector<Case> plane_cases() {
  const char* const f = "dif_field_planes";
  return {
      CALL("dif_plane_fraction",
           dif_plane_fraction(nullptr, 1, b.numbers.data(), b.numbers.data(), b.numbers.data()),
           kArgument),
      CALL("dif_plane_fraction",
           dif_plane_fraction(b.spacing, 1, nullptr, b.numbers.data(), b.numbers.data()),
           kArgument),
      CALL("dif_plane_fraction",
           dif_plane_fraction(b.spacing, 1, b.numbers.data(), nullptr, b.numbers.data()),
           kArgument),
      CALL("dif_plane_fraction",
           dif_plane_fraction(b.spacing, 1, b.numbers.data(), b.numbers.data(), nullptr),
           kArgument),
      CALL("dif_plane_fraction",
           dif_plane_fraction(b.spacing, -1, b.numbers.data(), b.numbers.data(), b.numbers.data()),
           kArgument),
      CHANGED("dif_plane_fraction", spacing[1] = 0.0, kGrid,
              [](Bench& c) {
                return dif_plane_fraction(c.spacing, 1, c.numbers.data(), c.numbers.data(),
                                          c.numbers.data());
              }),
      CHANGED("dif_plane_fraction", numbers[1] = kNaN, kArgument,
              [](Bench& c) {
                return dif_plane_fraction(c.spacing, 1, c.numbers.data(), c.spacing,
                                          c.numbers.data());
              }),
      CHANGED("dif_plane_fraction", spacing[0] = kInfinity, kGrid,
              [](Bench& c) {
                return dif_plane_fraction(c.spacing, 1, c.numbers.data(), c.numbers.data(),
                                          c.numbers.data());
              }),
      CHANGED("dif_plane_fraction", numbers.assign(3000, 0.0), kArgument,
              [](Bench& c) {
                return dif_plane_fraction(c.spacing, 1, c.numbers.data(), c.numbers.data(),
                                          c.numbers.data());
              }),
      CALL("dif_plane_offset",
           dif_plane_offset(nullptr, 1, b.numbers.data(), b.numbers.data(), b.numbers.data()),
           kArgument),
      CALL("dif_plane_offset",
           dif_plane_offset(b.spacing, 1, nullptr, b.numbers.data(), b.numbers.data()), kArgument),
      CALL("dif_plane_offset",
           dif_plane_offset(b.spacing, 1, b.numbers.data(), nullptr, b.numbers.data()), kArgument),
      CALL("dif_plane_offset",
           dif_plane_offset(b.spacing, 1, b.numbers.data(), b.numbers.data(), nullptr), kArgument),
      CALL("dif_plane_offset",
           dif_plane_offset(b.spacing, 1, b.numbers.data(), &kNaN, b.numbers.data()), kArgument),
      CALL("dif_plane_arrays_init", dif_plane_arrays_init(nullptr, 72), kArgument),
      CALL("dif_cell_planes",
           dif_cell_planes(nullptr, nullptr, 1, b.cells, b.numbers.data(), nullptr, nullptr),
           kArgument),
      CALL("dif_cell_planes",
           dif_cell_planes(&b.field, nullptr, 1, nullptr, b.numbers.data(), nullptr, nullptr),
           kArgument),
      CALL("dif_cell_planes",
           dif_cell_planes(&b.field, nullptr, -1, b.cells, b.numbers.data(), nullptr, nullptr),
           kArgument),
      CHANGED("dif_cell_planes", cells[2] = 7, kArgument,
              [](Bench& c) {
                return dif_cell_planes(&c.field, nullptr, 1, c.cells, nullptr, nullptr, nullptr);
              }),
      CHANGED("dif_cell_planes", cells[0] = -1, kArgument,
              [](Bench& c) {
                return dif_cell_planes(&c.field, nullptr, 1, c.cells, nullptr, nullptr, nullptr);
              }),
      CHANGED("dif_cell_planes", options.normals = 9, kArgument,
              [](Bench& c) {
                return dif_cell_planes(&c.field, &c.options, 1, c.cells, nullptr, nullptr, nullptr);
              }),
      CALL(f, dif_field_planes(nullptr, nullptr, &b.arrays), kArgument),
      CALL(f, dif_field_planes(&b.field, nullptr, nullptr), kArgument),
      CHANGED(f, arrays.struct_size = 1, kStruct, field_planes),
      CHANGED(f, arrays.strides[1] = 0, kArgument, field_planes),
      CHANGED(f, arrays.strides[1] = kHuge, kArgument, field_planes),
      CHANGED(f, values.values[3] = kNaN, DIF_ERROR_INVALID_VALUE, field_planes),
  };
}

std::vector<Case> surface_cases() {
  const char* const s = "dif_cell_surfaces";
  const char* const i = "dif_interfacial_cells";
  const char* const c = "dif_cell_curvature";
  return {
      CALL("dif_surface_arrays_init", dif_surface_arrays_init(nullptr, 104), kArgument),
      CALL("dif_surface_arrays_init", dif_surface_arrays_init(&b.surface_arrays, 4), kStruct),
      CALL(s, dif_cell_surfaces(nullptr, nullptr, 1, 1, b.cells, &b.surface_arrays), kArgument),
      CALL(s, dif_cell_surfaces(&b.field, nullptr, 1, 1, nullptr, &b.surface_arrays), kArgument),
      CALL(s, dif_cell_surfaces(&b.field, nullptr, 1, -1, b.cells, &b.surface_arrays), kArgument),
      CALL(s, dif_cell_surfaces(&b.field, nullptr, 1, 1, b.cells, nullptr), kArgument),
      CALL(s, dif_cell_surfaces(&b.field, nullptr, 2, 1, b.cells, &b.surface_arrays), kArgument),
      CALL(s, dif_cell_surfaces(&b.field, nullptr, -1, 1, b.cells, &b.surface_arrays), kArgument),
      CHANGED(s, surface_arrays.struct_size = 1, kStruct, cell_surfaces),
      CHANGED(s, cells[2] = 7, kArgument, cell_surfaces),
      CHANGED(s, cells[0] = -1, kArgument, cell_surfaces),
      CHANGED(s, cells[1] = kHuge, kArgument, cell_surfaces),
      CHANGED(s, options.boundary[3] = 9, kArgument, cell_surfaces),
      CHANGED(s, options.purity_tolerance = kNaN, kArgument, cell_surfaces),
      CHANGED(s, field.spacing[1] = 0.0, kGrid, cell_surfaces),
      CALL(i, dif_interfacial_cells(nullptr, nullptr, 0, nullptr, &b.count), kArgument),
      CALL(i, dif_interfacial_cells(&b.field, nullptr, 0, nullptr, nullptr), kArgument),
      CALL(i, dif_interfacial_cells(&b.field, nullptr, 1, nullptr, &b.count), kArgument),
      CALL(i, dif_interfacial_cells(&b.field, nullptr, -1, b.cells, &b.count), kArgument),
      CALL(i, dif_interfacial_cells(&b.field, nullptr, 1, b.cells, &b.count), kArgument),
      CHANGED(i, options.struct_size = 1, kStruct, interfacial_cells),
      CHANGED(i, values.values[3] = kNaN, DIF_ERROR_INVALID_VALUE, interfacial_cells),
      CALL(c, dif_cell_curvature(nullptr, nullptr, b.numbers.data(), nullptr), kArgument),
      CALL(c, dif_cell_curvature(&b.field, nullptr, nullptr, nullptr), kArgument),
      CHANGED(c, strides[1] = 0, kArgument, cell_curvature),
      CHANGED(c, strides[2] = kHuge, kArgument, cell_curvature),
      CHANGED(c, options.struct_size = 1, kStruct, cell_curvature),
      CHANGED(c, field.dims[0] = 0, kGrid, cell_curvature),
      CHANGED(c, values.values[3] = kNaN, DIF_ERROR_INVALID_VALUE, cell_curvature),
      CHANGED(c, field.faces_z = b.faces(2.0), kGrid, cell_curvature),
  };
}

std::vector<Case> fraction_cases() {
  const char* const f = "dif_fractions_from_shape";
  const char* const m = "dif_fractions_from_mesh";
  const char* const s = "dif_shape_create";
  return {
      CALL("dif_grid_init", dif_grid_init(nullptr, 80, b.cells), kArgument),
      CALL("dif_grid_init", dif_grid_init(&b.grid, 80, nullptr), kArgument),
      CHANGED("dif_grid_init", cells[0] = 0, kGrid,
              [](Bench& c) { return dif_grid_init(&c.grid, 80, c.cells); }),
      CALL("dif_function_options_init", dif_function_options_init(nullptr, 72), kArgument),
      CALL("dif_function_report_init", dif_function_report_init(nullptr, 88), kArgument),
      CALL("dif_triangle_options_init", dif_triangle_options_init(nullptr, 48), kArgument),
      CALL("dif_triangle_report_init", dif_triangle_report_init(nullptr, 72), kArgument),
      CALL("dif_shape_options_init", dif_shape_options_init(nullptr, 144), kArgument),
      CALL("dif_fractions_from_function",
           dif_fractions_from_function(nullptr, plus_one, nullptr, nullptr, nullptr,
                                       b.numbers.data()),
           kArgument),
      CALL("dif_fractions_from_function",
           dif_fractions_from_function(&b.grid, nullptr, nullptr, nullptr, nullptr,
                                       b.numbers.data()),
           kArgument),
      CALL("dif_fractions_from_function",
           dif_fractions_from_function(&b.grid, plus_one, nullptr, nullptr, nullptr, nullptr),
           kArgument),
      CALL("dif_fractions_from_function",
           dif_fractions_from_function(&b.grid, no_number, nullptr, nullptr, nullptr,
                                       b.numbers.data()),
           DIF_ERROR_INVALID_VALUE),
      CALL("dif_fractions_from_function",
           dif_fractions_from_function(&b.grid, stop, nullptr, nullptr, nullptr, b.numbers.data()),
           DIF_ERROR_CANCELLED),
      CALL(f, dif_fractions_from_shape(&b.grid, nullptr, nullptr, nullptr, b.numbers.data()),
           kArgument),
      CALL(f, dif_fractions_from_shape(&b.grid, b.shape.get(), nullptr, nullptr, nullptr),
           kArgument),
      CHANGED(f, grid.struct_size = 3, kStruct, from_shape),
      CHANGED(f, grid.dims[0] = kHuge, kGrid, from_shape),
      CHANGED(f, grid.spacing[2] = kNaN, kGrid, from_shape),
      CHANGED(f, grid.faces_y = b.faces(4.0), kGrid, from_shape),
      CHANGED(f, function_options.tolerance = 0.0, kArgument, from_shape),
      CHANGED(f, function_options.kink_tolerance = kNaN, kArgument, from_shape),
      CHANGED(f, function_options.max_calls_per_cell = 1, kArgument, from_shape),
      CHANGED(f, function_options.threads = -2, kArgument, from_shape),
      CHANGED(f, function_options.reserved = 1, kArgument, from_shape),
      CHANGED(f, function_options.gradient = plus_one, kArgument, from_shape),
      CALL(m, dif_fractions_from_mesh(nullptr, b.mesh.get(), nullptr, nullptr, b.numbers.data()),
           kArgument),
      CALL(m, dif_fractions_from_mesh(&b.grid, nullptr, nullptr, nullptr, b.numbers.data()),
           kArgument),
      CALL(m, dif_fractions_from_mesh(&b.grid, b.mesh.get(), nullptr, nullptr, nullptr), kArgument),
      CHANGED(m, triangle_options.flip = 3, kArgument, from_mesh),
      CHANGED(m, triangle_options.flip = 1, kArgument, from_mesh),
      CHANGED(m, triangle_options.check_edges = -3, kArgument, from_mesh),
      CHANGED(m, triangle_options.tolerance = kNaN, kArgument, from_mesh),
      CHANGED(m, triangle_options.threads = -1, kArgument, from_mesh),
      CHANGED(m, triangle_options.overlaps = 4, kArgument, from_mesh),
      CHANGED(m, triangle_options.overlaps = -1, kArgument, from_mesh),
      CALL(s, dif_shape_create(nullptr, nullptr), kArgument),
      CHANGED(s, shape_options.struct_size = 9, kStruct, create_shape),
      CHANGED(s, shape_options.kind = 0, kArgument, create_shape),
      CHANGED(s, shape_options.kind = 7, kArgument, create_shape),
      CHANGED(s, shape_options.reserved = 7, kArgument, create_shape),
      CHANGED(s, shape_options.radius = -1.0, kArgument, create_shape),
      CHANGED(s, shape_options.centre[1] = kNaN, kArgument, create_shape),
      CHANGED(s, shape_options.rotation_degrees[0] = kInfinity, kArgument, create_shape),
      CALL("dif_shape_bounds", dif_shape_bounds(nullptr, b.spacing, b.spacing), kArgument),
      CALL("dif_shape_bounds", dif_shape_bounds(b.shape.get(), nullptr, b.spacing), kArgument),
      CALL("dif_shape_bounds", dif_shape_bounds(b.shape.get(), b.spacing, nullptr), kArgument),
      CALL("dif_shape_volume", dif_shape_volume(nullptr, b.spacing), kArgument),
      CALL("dif_shape_volume", dif_shape_volume(b.shape.get(), nullptr), kArgument),
      CALL("dif_shape_distances", dif_shape_distances(nullptr, 1, b.spacing, b.numbers.data()),
           kArgument),
      CALL("dif_shape_distances", dif_shape_distances(b.shape.get(), 1, nullptr, b.numbers.data()),
           kArgument),
      CALL("dif_shape_distances", dif_shape_distances(b.shape.get(), 1, b.spacing, nullptr),
           kArgument),
      CALL("dif_shape_distances", dif_shape_distances(b.shape.get(), -1, b.spacing, b.spacing),
           kArgument),
  };
}

std::vector<Case> block_cases() {
  const char* const f = "dif_reconstruct_block";
  return {
      CALL("dif_block_init", dif_block_init(nullptr, 104), kArgument),
      CALL(f, dif_reconstruct_block(nullptr, &b.block, &b.grid, nullptr, &b.result), kArgument),
      CALL(f, dif_reconstruct_block(&b.field, nullptr, &b.grid, nullptr, &b.result), kArgument),
      CALL(f, dif_reconstruct_block(&b.field, &b.block, nullptr, nullptr, &b.result), kArgument),
      CALL(f, dif_reconstruct_block(&b.field, &b.block, &b.grid, nullptr, nullptr), kArgument),
      CALL(f, dif_reconstruct_block(&b.field, &b.block, &b.grid, nullptr, &b.result), kArgument),
      CHANGED(f, block.struct_size = 2, kStruct, reconstruct_block),
      CHANGED(f, block.dims[0] = 0, kArgument, reconstruct_block),
      CHANGED(f, block.dims[0] = kHuge, kArgument, reconstruct_block),
      CHANGED(f, block.offset[0] = -1, kArgument, reconstruct_block),
      CHANGED(f, block.offset[0] = kHuge, kArgument, reconstruct_block),
      CHANGED(f, block.ghost_low[1] = kHuge, kArgument, reconstruct_block),
      CHANGED(f, block.ghost_high[1] = -1, kArgument, reconstruct_block),
      {f, "ghosts beyond 64 bits at a periodic side", kArgument,
       [](Bench& b) {
         b.options.boundary[0] = b.options.boundary[1] = DIF_SIDE_PERIODIC;
         b.block.ghost_low[0] = kHuge;
         b.block.ghost_high[0] = kHuge;
         return reconstruct_block(b);
       }},
      CALL("dif_mesh_weld", dif_mesh_weld(nullptr, 1, &b.grid, &b.result), kArgument),
      CALL("dif_mesh_weld", dif_mesh_weld(nullptr, -1, &b.grid, &b.result), kArgument),
      CALL("dif_mesh_weld", dif_mesh_weld(nullptr, 0, nullptr, &b.result), kArgument),
      CALL("dif_mesh_weld", dif_mesh_weld(nullptr, 0, &b.grid, nullptr), kArgument),
      {"dif_mesh_weld", "a mesh that is NULL or has no edge ids", kArgument,
       [](Bench& b) {
         const dif_mesh* meshes[2] = {nullptr, nullptr};
         CHECK(dif_mesh_weld(meshes, 2, &b.grid, &b.result) == kArgument);
         meshes[0] = b.mesh.get();
         return dif_mesh_weld(meshes, 1, &b.grid, &b.result);
       }},
  };
}

std::vector<Case> distance_cases() {
  const dif_status bad = dif_has(DIF_PART_DISTANCE) == 1 ? kArgument : DIF_ERROR_UNSUPPORTED;
  const char* const f = "dif_distance_to_shape";
  std::vector<Case> cases{
      CALL("dif_distance_options_init", dif_distance_options_init(nullptr, 40), kArgument),
      CALL("dif_distance_init", dif_distance_init(nullptr, 208), kArgument),
      CALL(f, dif_distance_to_shape(b.mesh.get(), b.shape.get(), nullptr, nullptr), bad),
      CALL("dif_distance_to_function",
           dif_distance_to_function(b.mesh.get(), plus_one, nullptr, nullptr, nullptr), bad),
      CALL("dif_distance_to_mesh",
           dif_distance_to_mesh(b.mesh.get(), b.mesh.get(), nullptr, nullptr, nullptr), bad),
  };
  cases.push_back(
      {f, "each argument and option", bad, [](Bench& b) -> dif_status {
         if (dif_has(DIF_PART_DISTANCE) == 0) {
           return DIF_ERROR_UNSUPPORTED;
         }
         dif_distance d = test::prepared(dif_distance_init);
         dif_distance back = test::prepared(dif_distance_init);
         const dif_mesh* mesh = b.mesh.get();
         CHECK(dif_distance_to_shape(nullptr, b.shape.get(), nullptr, &d) == kArgument);
         CHECK(dif_distance_to_shape(mesh, nullptr, nullptr, &d) == kArgument);
         CHECK(dif_distance_to_function(nullptr, plus_one, nullptr, nullptr, &d) == kArgument);
         CHECK(dif_distance_to_function(mesh, nullptr, nullptr, nullptr, &d) == kArgument);
         CHECK(dif_distance_to_function(mesh, no_number, nullptr, nullptr, &d) ==
               DIF_ERROR_INVALID_VALUE);
         CHECK(dif_distance_to_function(mesh, stop, nullptr, nullptr, &d) == DIF_ERROR_CANCELLED);
         CHECK(dif_distance_to_mesh(nullptr, mesh, nullptr, &d, &back) == kArgument);
         CHECK(dif_distance_to_mesh(mesh, nullptr, nullptr, &d, &back) == kArgument);
         back.struct_size = 1;
         CHECK(dif_distance_to_mesh(mesh, mesh, nullptr, &d, &back) == kStruct);
         b.distance_options.with_sign = 4;
         CHECK(dif_distance_to_mesh(mesh, mesh, &b.distance_options, &d, nullptr) == kArgument);
         b.distance_options.with_sign = 1;
         b.distance_options.facet_spacing = kNaN;
         CHECK(dif_distance_to_mesh(mesh, mesh, &b.distance_options, &d, nullptr) == kArgument);
         b.distance_options.facet_spacing = 0.0;
         b.distance_options.threads = -4;
         return dif_distance_to_mesh(mesh, mesh, &b.distance_options, &d, nullptr);
       }});
  return cases;
}

dif_status write_mesh_to(Bench& b, const char* path) {
  if (dif_has(DIF_PART_FILES) == 0) {
    CHECK(dif_mesh_write(b.mesh.get(), path, &b.write_options, nullptr) == DIF_ERROR_UNSUPPORTED);
    return kArgument;
  }
  const dif_status status = dif_mesh_write(b.mesh.get(), path, &b.write_options, nullptr);
  const bool has_all = dif_has(DIF_PART_GLTF) == 1 && dif_has(DIF_PART_DRACO) == 1;
  return status == DIF_ERROR_UNSUPPORTED && !has_all ? kArgument : status;
}
dif_status write_glb(Bench& b) {
  return write_mesh_to(b, "/nowhere/x.glb");
}
dif_status write_draco(Bench& b) {
  b.write_options.draco = 1;
  return write_mesh_to(b, "/nowhere/x.glb");
}
dif_status write_drc(Bench& b) {
  return write_mesh_to(b, "/nowhere/x.drc");
}
dif_status write_colored(Bench& b) {
  REQUIRE(dif_mesh_set_scalars(b.mesh.get(), "height", b.numbers.data()) == DIF_OK);
  b.write_options.color_by = "height";
  return write_mesh_to(b, "/nowhere/x.glb");
}
dif_status write_ply(Bench& b) {
  return write_mesh_to(b, "/nowhere/x.ply");
}

dif_status write_reported(Bench& b) {
  return dif_mesh_write(b.mesh.get(), "/nowhere/x.ply", nullptr, &b.write_report);
}

std::vector<Case> write_cases() {
  const char* const f = "dif_mesh_write";
  return {
    CHANGED(f, write_options.format = "doc", kArgument, write_ply),
        CHANGED(f, write_options.normals = 2, kArgument, write_ply),
        CHANGED(f, write_options.edge_ids = -1, kArgument, write_ply),
        CHANGED(f, write_options.scalars = 2, kArgument, write_ply),
        CHANGED(f, write_options.draco = 1, kArgument, write_ply),
        CHANGED(f, write_options.color_by = "height", kArgument, write_ply),
        CHANGED(f, write_options.up = DIF_UP_Z, kArgument, write_ply),
        CHANGED(f, write_options.metres_per_unit = 0.001, kArgument, write_ply),
        CHANGED(f, write_options.most_vertices = 65535, kArgument, write_ply),
        CHANGED(f, write_options.name = "drop", kArgument, write_ply),
        CHANGED(f, write_options.has_local_origin = 1, kArgument, write_ply),
        CHANGED(f, write_options.draco = 2, kArgument, write_glb),
        CHANGED(f, write_options.color_by = "height", kArgument, write_glb),
        CHANGED(f, write_options.up = 3, kArgument, write_glb),
        CHANGED(f, write_options.metres_per_unit = kNaN, kArgument, write_glb),
        CHANGED(f, write_options.metres_per_unit = 0.0, kArgument, write_glb),
        CHANGED(f, write_options.has_local_origin = 2, kArgument, write_glb),
        CHANGED(f, write_options.has_local_origin = 1;
                b.write_options.local_origin[1] = kInfinity, kArgument, write_glb),
        CHANGED(f, write_options.most_vertices = 2, kArgument, write_glb),
        CHANGED(f, write_options.most_vertices = std::numeric_limits<std::int64_t>::min(),
                kArgument, write_glb),
        CHANGED(f, write_options.draco_method = 3, kArgument, write_draco),
        CHANGED(f, write_options.draco_speed = 11, kArgument, write_draco),
        CHANGED(f, write_options.position_bits = 25, kArgument, write_draco),
        CHANGED(f, write_options.position_bits = -1, kArgument, write_drc),
        CHANGED(f, write_options.normal_bits = 1, kArgument, write_draco),
        CHANGED(f, write_options.generic_bits = 0, kArgument, write_draco),
        CHANGED(f, write_options.cell_size = -1.0, kArgument, write_draco),
        CHANGED(f, write_options.cell_size = kNaN, kArgument, write_drc),
        CHANGED(f, write_options.color_map = 3, kArgument, write_colored),
        CHANGED(f, write_options.color_range[0] = kNaN, kArgument, write_colored),
        CHANGED(f, write_options.color_range[0] = 1.0, kArgument, write_colored),
  };
}

dif_status from_values(Bench& b) {
  return dif_fractions_from_values(&b.raw, 0.0, 6.0, b.numbers.data());
}
dif_status from_labels(Bench& b) {
  return dif_fractions_from_labels(&b.raw, 2, b.labels, b.mask.data());
}
dif_status extremes(Bench& b) {
  return dif_value_extremes(&b.raw, b.numbers.data(), b.numbers.data() + 1);
}

std::vector<Case> value_cases() {
  const char* const v = "dif_fractions_from_values";
  const char* const l = "dif_fractions_from_labels";
  const char* const e = "dif_value_extremes";
  return {
      CALL("dif_reconstruct", dif_reconstruct(&b.raw, nullptr, &b.result), kArgument),
      CALL(v, dif_fractions_from_values(nullptr, 0.0, 1.0, b.numbers.data()), kArgument),
      CALL(v, dif_fractions_from_values(&b.raw, 0.0, 1.0, nullptr), kArgument),
      CALL(v, dif_fractions_from_values(&b.raw, 2.0, 2.0, b.numbers.data()), kArgument),
      CALL(v, dif_fractions_from_values(&b.raw, kNaN, 2.0, b.numbers.data()), kArgument),
      CALL(v, dif_fractions_from_values(&b.raw, 0.0, kInfinity, b.numbers.data()), kArgument),
      CHANGED(v, raw.type = 0, kArgument, from_values),
      CHANGED(v, raw.type = 5, kArgument, from_values),
      CHANGED(v, raw.type = 17, kArgument, from_values),
      CHANGED(v, raw.data = nullptr, kArgument, from_values),
      CHANGED(v, raw.dims[1] = 0, kGrid, from_values),
      CHANGED(v, raw.strides[2] = kHuge, kArgument, from_values),
      CHANGED(v, raw.struct_size = 12, kStruct, from_values),
      CALL(l, dif_fractions_from_labels(nullptr, 2, b.labels, b.mask.data()), kArgument),
      CALL(l, dif_fractions_from_labels(&b.raw, 2, nullptr, b.mask.data()), kArgument),
      CALL(l, dif_fractions_from_labels(&b.raw, -2, b.labels, b.mask.data()), kArgument),
      CALL(l, dif_fractions_from_labels(&b.raw, 0, b.labels, b.mask.data()), kArgument),
      CALL(l, dif_fractions_from_labels(&b.raw, 2, b.labels, nullptr), kArgument),
      CHANGED(l, raw.dims[0] = -1, kGrid, from_labels),
      CALL(e, dif_value_extremes(nullptr, b.numbers.data(), b.numbers.data()), kArgument),
      CALL(e, dif_value_extremes(&b.raw, nullptr, b.numbers.data()), kArgument),
      CALL(e, dif_value_extremes(&b.raw, b.numbers.data(), nullptr), kArgument),
      CHANGED(e, raw.type = -1, kArgument, extremes),
  };
}

dif_status read_with(Bench& b) {
  dif_field_file* file = reinterpret_cast<dif_field_file*>(&b);
  const dif_status status = dif_field_read_with("/dev/null.npy", nullptr, &b.read_options, &file);
  CHECK(file == nullptr);
  return status;
}

dif_status read_mesh_with(Bench& b) {
  b.result = reinterpret_cast<dif_mesh*>(&b);
  const dif_status status = dif_mesh_read_with("/nowhere/x.gltf", &b.mesh_options, &b.result);
  CHECK(b.result == nullptr);
  return status;
}

std::vector<Case> field_reading_cases() {
  const bool has_files = dif_has(DIF_PART_FILES) == 1;
  const auto or_unsupported = [&](dif_status status) {
    return has_files ? status : DIF_ERROR_UNSUPPORTED;
  };
  const char* const f = "dif_field_read_with";
  const dif_status argument = or_unsupported(kArgument);
  return {
      CALL("dif_mesh_read_options_init", dif_mesh_read_options_init(nullptr, 16), kArgument),
      CALL("dif_mesh_read_with", read_mesh_with(b), or_unsupported(DIF_ERROR_FILE_MISSING)),
      CALL("dif_mesh_read_with", dif_mesh_read_with(nullptr, nullptr, &b.result), argument),
      CALL("dif_mesh_read_with", dif_mesh_read_with("x.ply", nullptr, nullptr), argument),
      CHANGED("dif_mesh_read_with", mesh_options.outside_files = 2, argument, read_mesh_with),
      CHANGED("dif_mesh_read_with", mesh_options.reserved = 1, argument, read_mesh_with),
      CHANGED("dif_mesh_read_with", mesh_options.struct_size = 12, or_unsupported(kStruct),
              read_mesh_with),
      CALL("dif_field_read_options_init", dif_field_read_options_init(nullptr, 104), kArgument),
      CALL("dif_field_read_options_init", dif_field_read_options_init(&b.read_options, 7), kStruct),
      CALL("dif_field_file_warning", dif_field_file_warning(nullptr, 0, &b.text), argument),
      CALL("dif_field_file_type", dif_field_file_type(nullptr, nullptr), argument),
      CALL(f, read_with(b), or_unsupported(DIF_ERROR_FILE_MISSING)),
      CALL(f, dif_field_read_with("x.npy", nullptr, &b.read_options, nullptr), argument),
      CHANGED(f, read_options.struct_size = 3, or_unsupported(kStruct), read_with),
      CHANGED(f, read_options.has_origin = 2, argument, read_with),
      CHANGED(f, read_options.has_spacing = -1, argument, read_with),
      CHANGED(f, read_options.has_full_value = 2, argument, read_with),
      CHANGED(f, read_options.outside_files = 2, argument, read_with),
      CHANGED(f, read_options.label_count = -1, argument, read_with),
      CHANGED(f, read_options.label_count = 1, argument, read_with),
      {f, "a spacing of 0", argument,
       [](Bench& b) {
         b.read_options.has_spacing = 1;
         b.read_options.spacing[1] = 0.0;
         return read_with(b);
       }},
      {f, "an origin that is no number", argument,
       [](Bench& b) {
         b.read_options.has_origin = 1;
         b.read_options.origin[2] = kNaN;
         return read_with(b);
       }},
      {f, "a full value as the empty one", argument,
       [](Bench& b) {
         b.read_options.has_full_value = 1;
         b.read_options.full_value = 0.0;
         return read_with(b);
       }},
      {f, "labels and a full value", argument,
       [](Bench& b) {
         b.read_options.has_full_value = 1;
         b.read_options.label_count = 1;
         b.read_options.labels = b.labels;
         return read_with(b);
       }},
  };
}

std::vector<Case> file_cases() {
  const bool has_files = dif_has(DIF_PART_FILES) == 1;
  const auto or_unsupported = [&](dif_status status) {
    return has_files ? status : DIF_ERROR_UNSUPPORTED;
  };
  std::vector<Case> cases{
      CALL("dif_mesh_write_options_init", dif_mesh_write_options_init(nullptr, 24), kArgument),
      CALL("dif_mesh_write_report_init", dif_mesh_write_report_init(nullptr, 80), kArgument),
      CALL("dif_raw_layout_init", dif_raw_layout_init(nullptr, 48), kArgument),
      CALL("dif_field_write_options_init", dif_field_write_options_init(nullptr, 24), kArgument),
      CALL("dif_mesh_write", dif_mesh_write(nullptr, "x.ply", nullptr, nullptr),
           or_unsupported(kArgument)),
      CALL("dif_mesh_write", dif_mesh_write(b.mesh.get(), nullptr, nullptr, nullptr),
           or_unsupported(kArgument)),
      CALL("dif_mesh_write", dif_mesh_write(b.mesh.get(), "x.doc", nullptr, nullptr),
           or_unsupported(kArgument)),
      CALL("dif_mesh_write", dif_mesh_write(b.mesh.get(), "/nowhere/x.ply", nullptr, nullptr),
           or_unsupported(DIF_ERROR_FILE_WRITE)),
      CALL("dif_mesh_write", dif_mesh_write(nullptr, "x.ply", nullptr, &b.write_report),
           or_unsupported(kArgument)),
      CALL("dif_mesh_write", dif_mesh_write(b.mesh.get(), nullptr, nullptr, &b.write_report),
           or_unsupported(kArgument)),
      CALL("dif_mesh_write", dif_mesh_write(b.mesh.get(), "/nowhere/x.ply", nullptr, nullptr),
           or_unsupported(DIF_ERROR_FILE_WRITE)),
      CHANGED("dif_mesh_write", write_report.struct_size = 4, or_unsupported(kStruct),
              write_reported),
      CHANGED("dif_mesh_write", write_report.struct_size = 1U << 20U, or_unsupported(kStruct),
              write_reported),
      CALL("dif_mesh_read", dif_mesh_read(nullptr, &b.result), or_unsupported(kArgument)),
      CALL("dif_mesh_read", dif_mesh_read("x.ply", nullptr), or_unsupported(kArgument)),
      CALL("dif_mesh_read", dif_mesh_read("/nowhere/x.ply", &b.result),
           or_unsupported(DIF_ERROR_FILE_MISSING)),
      CALL("dif_mesh_read", dif_mesh_read("/dev/null", &b.result),
           or_unsupported(DIF_ERROR_FILE_FORMAT)),
      CALL("dif_field_read", dif_field_read("x.npy", nullptr, nullptr), or_unsupported(kArgument)),
      CALL("dif_field_write", dif_field_write(nullptr, "x.npy", nullptr),
           or_unsupported(kArgument)),
      CALL("dif_field_write", dif_field_write(&b.field, nullptr, nullptr),
           or_unsupported(kArgument)),
      CALL("dif_field_write", dif_field_write(&b.field, "/nowhere/x.npy", nullptr),
           or_unsupported(DIF_ERROR_FILE_WRITE)),
      CALL("dif_field_file_field", dif_field_file_field(nullptr, &b.field),
           or_unsupported(kArgument)),
  };
  cases.push_back({"dif_field_read", "paths and layouts", or_unsupported(kArgument), [](Bench& b) {
                     dif_field_file* file = reinterpret_cast<dif_field_file*>(&b);
                     dif_raw_layout layout = test::prepared(dif_raw_layout_init);
                     if (dif_has(DIF_PART_FILES) == 0) {
                       return dif_field_read("x.npy", nullptr, &file);
                     }
                     CHECK(dif_field_read("/nowhere/x.npy", nullptr, &file) ==
                           DIF_ERROR_FILE_MISSING);
                     CHECK(file == nullptr);
                     CHECK(dif_field_read(nullptr, nullptr, &file) == kArgument);
                     CHECK(dif_field_read("/dev/null", &layout, &file) == kArgument);
                     layout.dims[0] = layout.dims[1] = layout.dims[2] = kHuge;
                     CHECK(dif_field_read("/dev/null", &layout, &file) == DIF_ERROR_FILE_FORMAT);
                     layout.type = 0;
                     CHECK(dif_field_read("/dev/null", &layout, &file) == kArgument);
                     layout.type = DIF_UINT8;
                     layout.big_endian = 2;
                     CHECK(dif_field_read("/dev/null", &layout, &file) == kArgument);
                     dif_mesh_write_options mesh = test::prepared(dif_mesh_write_options_init);
                     mesh.format = "xyz";
                     CHECK(dif_mesh_write(b.mesh.get(), "x.ply", &mesh, nullptr) == kArgument);
                     dif_field_write_options field = test::prepared(dif_field_write_options_init);
                     field.format = -1;
                     CHECK(dif_field_write(&b.field, "x.npy", &field) == kArgument);
                     field.format = 2;
                     field.gzip_level = 11;
                     CHECK(dif_field_write(&b.field, "x.npy", &field) == kArgument);
                     field.gzip_level = 6;
                     field.type = 17;
                     return dif_field_write(&b.field, "x.npy", &field);
                   }});
  return cases;
}

}  // namespace

TEST_CASE("bad arguments give a status and a message at every function") {
  std::set<std::string> seen;
  std::size_t count = 0;
  for (const auto& cases : {field_cases(), mesh_cases(), smoothing_cases(), plane_cases(),
                            surface_cases(), fraction_cases(), block_cases(), distance_cases(),
                            file_cases(), write_cases(), value_cases(), field_reading_cases()}) {
    for (const Case& one : cases) {
      Bench bench;
      INFO(one.function << ": " << one.what);
      const dif_status status = one.call(bench);
      INFO(std::string(dif_last_message()));
      CHECK(status == one.expected);
      CHECK(std::strlen(dif_last_message()) > 8);
      seen.insert(one.function);
      ++count;
    }
  }
  CHECK(count > 230);

  // Those that cannot fail.
  dif_mesh_free(nullptr);
  dif_shape_free(nullptr);
  dif_field_file_free(nullptr);
  for (const char* name : {"dif_mesh_free", "dif_shape_free", "dif_field_file_free", "dif_version",
                           "dif_version_text", "dif_has", "dif_last_message", "dif_status_name"}) {
    seen.insert(name);
  }
  std::ifstream list(DIFMESH_SOURCE_DIR "/tests/capi/exported.txt");
  REQUIRE(list);
  std::set<std::string> exported;
  for (std::string line; std::getline(list, line);) {
    exported.insert(line);
  }
  CHECK(seen == exported);
}
