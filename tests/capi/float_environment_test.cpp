// Callers with floating-point settings of their own: traps, rounding, subnormal numbers as 0,
// raised flags. Every job gives the same bits, no trap is sprung, and all is left as it was.

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "handles.hpp"
#ifdef DIFMESH_TEST_FILES
#include "io/files.hpp"
#endif
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace {

namespace c = difmesh::test;
using difmesh::Index3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What a caller can set, and see again.
struct Settings {
  int rounding = FE_TONEAREST;
  int traps = 0;
  int flags = 0;
  unsigned subnormals = 0;  // of MXCSR: flush to zero, and denormals are zero

  bool operator==(const Settings&) const = default;
};
constexpr unsigned kSubnormalsAreZero = 0x8040;

Settings settings() {
  Settings result;
  result.rounding = std::fegetround();
  result.flags = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__GLIBC__)
  result.traps = fegetexcept();
#endif
#if defined(__x86_64__)
  result.subnormals = _mm_getcsr() & kSubnormalsAreZero;
#endif
  return result;
}

void set(const Settings& wanted) {
  std::fesetenv(FE_DFL_ENV);
  std::feraiseexcept(wanted.flags);
  std::fesetround(wanted.rounding);
#if defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() | wanted.subnormals);
#endif
#if defined(__GLIBC__)
  feenableexcept(wanted.traps);
#endif
}

std::vector<Settings> all_settings() {
  std::vector<Settings> result{{.flags = FE_OVERFLOW | FE_INEXACT}};
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    result.push_back({.rounding = rounding});
  }
#if defined(__x86_64__)
  result.push_back({.subnormals = kSubnormalsAreZero});
#endif
#if defined(__GLIBC__)
  constexpr int traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  result.push_back({.traps = traps});
  result.push_back({.traps = traps | FE_UNDERFLOW});
  result.push_back({.rounding = FE_UPWARD, .traps = traps, .flags = FE_INEXACT});
#endif
  return result;
}

// What calls gave, by name; and whether they left the settings alone.
class Results {
 public:
  explicit Results(const Settings& wanted) : wanted_(wanted) {}

  /// Makes a call with the settings, and notes its status and what it leaves behind.
  template <class Call>
  dif_status call(const std::string& name, const Call& call) {
    set(wanted_);
    const dif_status status = call();
    const Settings found = settings();
    std::fesetenv(FE_DFL_ENV);
    if (found != wanted_) {
      disturbed_.push_back(name);
    }
    add(name + ": status", &status, sizeof status);
    return status;
  }
  void add(const std::string& name, const void* data, std::size_t bytes) {
    const auto* first = static_cast<const unsigned char*>(data);
    found_[name].assign(first, first + bytes);
  }
  template <class T>
  void add(const std::string& name, const std::vector<T>& values) {
    add(name, values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void add(const std::string& name, const difmesh::Array<T>& values) {
    add(name, values.data(), values.size() * sizeof(T));
  }
  void add(const std::string& name, const dif_mesh* handle) {
    const difmesh::Mesh mesh = c::mesh_of(handle);
    add(name + ": positions", mesh.positions);
    add(name + ": triangles", mesh.triangles);
    add(name + ": normals", mesh.normals);
  }

  [[nodiscard]] const std::vector<std::string>& disturbed() const { return disturbed_; }
  [[nodiscard]] std::vector<std::string> differences(const Results& other) const {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : found_) {
      const auto place = other.found_.find(name);
      if (place == other.found_.end() || place->second != bytes) {
        names.push_back(name);
      }
    }
    return names;
  }
  [[nodiscard]] std::size_t size() const { return found_.size(); }

 private:
  Settings wanted_;
  std::vector<std::string> disturbed_;
  std::map<std::string, std::vector<unsigned char>> found_;
};

// Values that solvers leave, and subnormal numbers.
c::OwnedField ugly(const Index3& dims, std::uint64_t seed) {
  constexpr std::array values{0.0, 1.0,  0.5,      0.5 - 0x1p-54, 0.5 + 0x1p-53, 1e-6, 1e-7,
                              0.3, 0.99, 1 - 1e-6, 1e-310,        5e-324,        1.05, -0.05};
  c::OwnedField field(dims);
  std::mt19937_64 random(seed);
  for (double& value : field.values) {
    value = values[random() % values.size()];
  }
  return field;
}

// Called with the settings of the caller, on whatever thread; computes with the default, so that
// what it gives depends on nothing.
struct Probe {
  Settings wanted;
  std::atomic<int> calls = 0;
  std::atomic<int> strangers = 0;  // calls that found other settings

  void look() {
    Settings found = settings();
    found.flags = wanted.flags;  // those of another thread are its own
    ++calls;
    strangers += found == wanted ? 0 : 1;
  }
};

std::int32_t on_progress(void* user, double share_done) {
  auto& probe = *static_cast<Probe*>(user);
  probe.look();
  const double spacing[3] = {1, 1, 1};
  const double normal[3] = {0.3, 0.7, 0.1};
  double offset = 0.1;
  double fraction = 0.0;
  const dif_status status = dif_plane_fraction(spacing, 1, normal, &offset, &fraction);
  probe.look();
  return status == DIF_OK && share_done <= 1.0 ? 0 : 1;
}

std::int32_t ball(void* user, std::int64_t count, const double* points, double* values) {
  static_cast<Probe*>(user)->look();
  std::fenv_t before;
  std::feholdexcept(&before);
  std::fesetenv(FE_DFL_ENV);
  for (std::int64_t n = 0; n < count; ++n) {
    const double* const p = points + 3 * n;
    values[n] = std::sqrt(p[0] * p[0] + 1.1 * p[1] * p[1] + p[2] * p[2]) - 1.2;
  }
  std::fesetenv(&before);
  return 0;
}

void reconstruct(Results& results, Probe& probe, const std::string& name, const dif_field& field,
                 const dif_options& given) {
  dif_options options = given;
  options.progress = on_progress;
  options.progress_user = &probe;
  dif_mesh* mesh = nullptr;
  if (results.call(name, [&] { return dif_reconstruct(&field, &options, &mesh); }) == DIF_OK) {
    results.add(name, mesh);
    dif_report report = c::prepared(dif_report_init);
    results.call(name + ", report", [&] { return dif_mesh_report(mesh, &report); });
    results.add(name + ", report", &report, offsetof(dif_report, seconds_classify));
  }
  dif_mesh_free(mesh);
}

void reconstruct_all(Results& results, Probe& probe) {
  const c::OwnedField fields[] = {ugly({9, 8, 7}, 1), c::white_noise({41, 40, 39}, 2),
                                  c::OwnedField({5, 5, 5}, 1e-40), ugly({1, 9, 30}, 3)};
  const double spacings[][3] = {
      {1, 1e-3, 1e3}, {1, 1, 1}, {0x1p-300, 0x1p-300, 0x1p-300}, {1, 1, 1}};
  for (std::size_t f = 0; f < 4; ++f) {
    dif_field field = c::c_field(fields[f]);
    std::copy_n(spacings[f], 3, field.spacing);
    for (std::int32_t placement = 1; placement <= 5; ++placement) {
      if (f == 1 && placement == DIF_PLACEMENT_CURVED) {
        continue;  // surfaces for 64,000 cells of noise take minutes under sanitizers
      }
      for (std::int32_t normals = 1; normals <= (f == 1 ? 3 : 5); ++normals) {
        dif_options options = c::prepared(dif_options_init);
        options.placement = placement;
        options.normals = normals;
        options.vertex_normals = 1;
        options.edge_ids = 1;
        options.boundary[0] = DIF_SIDE_EMPTY;
        options.boundary[3] = DIF_SIDE_MIRROR;
        options.boundary[4] = options.boundary[5] = DIF_SIDE_PERIODIC;
        reconstruct(results, probe,
                    "field " + std::to_string(f) + ", placement " + std::to_string(placement) +
                        ", normals " + std::to_string(normals),
                    field, options);
      }
    }
  }
  for (const double bad : {std::nan(""), kInfinity, 7.0}) {
    c::OwnedField field = ugly({4, 5, 6}, 4);
    field.at(2, 3, 4) = bad;
    reconstruct(results, probe, "a field with " + std::to_string(bad), c::c_field(field),
                c::prepared(dif_options_init));
  }
  dif_options options = c::prepared(dif_options_init);
  options.clearance = std::nan("");
  reconstruct(results, probe, "a clearance of NaN", c::c_field(fields[0]), options);
}

void planes(Results& results, Probe& probe) {
  const c::OwnedField values = ugly({12, 11, 10}, 5);
  const dif_field field = c::c_field(values);
  dif_options options = c::prepared(dif_options_init);
  options.progress = on_progress;
  options.progress_user = &probe;
  std::vector<double> offsets(values.values.size());
  dif_plane_arrays arrays = c::prepared(dif_plane_arrays_init);
  arrays.offset = offsets.data();
  arrays.strides[0] = 1;
  arrays.strides[1] = 12;
  arrays.strides[2] = 132;
  results.call("field planes", [&] { return dif_field_planes(&field, &options, &arrays); });
  results.add("field planes", offsets);
  std::vector<double> numbers(10, 0.1);
  const std::vector<std::int64_t> cells{1, 2, 3, 0, 0, 0, 11, 10, 9};
  results.call("cell planes", [&] {
    return dif_cell_planes(&field, &options, 3, cells.data(), numbers.data(), nullptr, nullptr);
  });
  results.add("cell planes", numbers);
  results.call("cell curvature",
               [&] { return dif_cell_curvature(&field, &options, offsets.data(), nullptr); });
  results.add("cell curvature", offsets);
  const double spacing[3] = {0.1, 0.3, 0.7};
  const double normals[9] = {0.36, -0.48, 0.8, 1e-310, 1, 1e-200, 1e-9, 1e-9, 1};
  const double shares[3] = {0.3, 1e-310, 1};
  results.call("plane offset",
               [&] { return dif_plane_offset(spacing, 3, normals, shares, numbers.data()); });
  results.call("plane fraction", [&] {
    return dif_plane_fraction(spacing, 3, normals, numbers.data(), numbers.data() + 3);
  });
  results.add("plane fraction", numbers);
  const double bad[3] = {std::nan(""), 1, 0};
  results.call("a normal of NaN",
               [&] { return dif_plane_offset(spacing, 1, bad, shares, numbers.data()); });
}

void make_fields(Results& results, Probe& probe, const dif_mesh* mesh) {
  const dif_grid grid = c::c_grid(
      {.dims = {20, 19, 18}, .origin = {-1.5, -1.5, -1.5}, .spacing = {0.15, 0.16, 0.17}});
  std::vector<double> fractions(20 * 19 * 18);
  dif_function_options options = c::prepared(dif_function_options_init);
  options.progress = on_progress;
  options.progress_user = &probe;
  results.call("fractions from function", [&] {
    return dif_fractions_from_function(&grid, ball, &probe, &options, nullptr, fractions.data());
  });
  results.add("fractions from function", fractions);
  for (std::int32_t kind = DIF_SHAPE_SPHERE; kind <= DIF_SHAPE_GOLF_BALL; ++kind) {
    const std::string name = "shape " + std::to_string(kind);
    dif_shape_options shape_options = c::prepared(dif_shape_options_init);
    shape_options.kind = kind;
    shape_options.dimples = 9;
    shape_options.rotation_degrees[0] = 33;
    dif_shape* shape = nullptr;
    REQUIRE(results.call(name, [&] { return dif_shape_create(&shape_options, &shape); }) == DIF_OK);
    const c::ShapeHandle handle(shape);
    const double points[9] = {0.3, 0.2, 0.1, 0, 0, 0, 3, 1e-310, -2};
    double numbers[10] = {};
    results.call(name + ", distances",
                 [&] { return dif_shape_distances(shape, 3, points, numbers); });
    results.call(name + ", bounds",
                 [&] { return dif_shape_bounds(shape, numbers + 3, numbers + 6); });
    results.call(name + ", volume", [&] { return dif_shape_volume(shape, numbers + 9); });
    results.add(name, numbers, sizeof numbers);
    results.call(name + ", fractions", [&] {
      return dif_fractions_from_shape(&grid, shape, &options, nullptr, fractions.data());
    });
    results.add(name + ", fractions", fractions);
    dif_distance distance = c::prepared(dif_distance_init);
    results.call(name + ", distance",
                 [&] { return dif_distance_to_shape(mesh, shape, nullptr, &distance); });
    results.add(name + ", distance", &distance, sizeof distance);
  }
  dif_triangle_options triangle_options = c::prepared(dif_triangle_options_init);
  triangle_options.progress = on_progress;
  triangle_options.progress_user = &probe;
  dif_grid around = c::c_grid({.dims = {20, 19, 18}});
  results.call("fractions from mesh", [&] {
    return dif_fractions_from_mesh(&around, mesh, &triangle_options, nullptr, fractions.data());
  });
  results.add("fractions from mesh", fractions);
  const c::OwnedField values = ugly({20, 19, 18}, 6);
  const dif_field field = c::c_field(values);
  results.call("mollify", [&] { return dif_mollify(&field, nullptr, fractions.data()); });
  results.add("mollify", fractions);
}

void measure(Results& results, Probe& probe, const dif_mesh* mesh, const dif_grid& grid) {
  dif_measure facts = c::prepared(dif_measure_init);
  results.call("measure", [&] { return dif_mesh_measure(mesh, &facts); });
  results.add("measure", &facts, sizeof facts);
  const auto vertices = static_cast<std::size_t>(facts.vertices);
  std::vector<double> mean(vertices);
  std::vector<double> gaussian(vertices);
  results.call("curvature", [&] {
    return dif_mesh_curvature(mesh, nullptr, mean.data(), gaussian.data(), nullptr, nullptr);
  });
  results.add("mean curvature", mean);
  results.add("Gaussian curvature", gaussian);
  for (std::int32_t kind = 1; kind <= 4; ++kind) {
    dif_smoothing_options options = c::prepared(dif_smoothing_options_init);
    options.kind = kind;
    options.progress = on_progress;
    options.progress_user = &probe;
    dif_mesh* smooth = nullptr;
    const std::string name = "smoothing " + std::to_string(kind);
    REQUIRE(results.call(name, [&] { return dif_mesh_smooth(mesh, &grid, &options, &smooth); }) ==
            DIF_OK);
    dif_distance there = c::prepared(dif_distance_init);
    dif_distance back = c::prepared(dif_distance_init);
    results.call(name + ", distance",
                 [&] { return dif_distance_to_mesh(mesh, smooth, nullptr, &there, &back); });
    results.add(name + ", distance", &there, sizeof there);
    results.add(name + ", distance back", &back, sizeof back);
    results.add(name, smooth);
    dif_mesh_free(smooth);
  }
  dif_distance distance = c::prepared(dif_distance_init);
  results.call("distance to function",
               [&] { return dif_distance_to_function(mesh, ball, &probe, nullptr, &distance); });
  results.add("distance to function", &distance, sizeof distance);
}

void blocks(Results& results) {
  const c::OwnedField values = ugly({8, 7, 14}, 7);
  const dif_grid grid = c::c_grid({.dims = {8, 7, 14}, .spacing = {0.1, 0.7, 0.3}});
  dif_mesh* parts[2] = {nullptr, nullptr};
  for (std::int64_t part = 0; part < 2; ++part) {
    dif_block block = c::prepared(dif_block_init);
    const std::int64_t offset[3] = {0, 0, 7 * part};
    const std::int64_t dims[3] = {8, 7, 7};
    std::copy_n(offset, 3, block.offset);
    std::copy_n(dims, 3, block.dims);
    block.ghost_low[2] = 7 * part;
    block.ghost_high[2] = 7 - 7 * part;
    const dif_field field = c::c_field(values);
    REQUIRE(results.call("block", [&] {
      return dif_reconstruct_block(&field, &block, &grid, nullptr, &parts[part]);
    }) == DIF_OK);
  }
  dif_mesh* whole = nullptr;
  REQUIRE(results.call("weld", [&] { return dif_mesh_weld(parts, 2, &grid, &whole); }) == DIF_OK);
  results.add("weld", whole);
  dif_mesh_free(whole);
  dif_mesh_free(parts[0]);
  dif_mesh_free(parts[1]);
}

#ifdef DIFMESH_TEST_FILES
void files(Results& results, const dif_mesh* mesh) {
  const test::TempFolder folder;
  for (const std::string name : {"m.ply", "m.obj", "m.off", "m.stl", "m.glb", "m.gltf", "m.drc"}) {
    const auto path = folder / name;
    if (results.call("write " + name, [&] {
          return dif_mesh_write(mesh, path.c_str(), nullptr, nullptr);
        }) != DIF_OK) {
      continue;
    }
    dif_mesh* read = nullptr;
    REQUIRE(results.call("read " + name, [&] { return dif_mesh_read(path.c_str(), &read); }) ==
            DIF_OK);
    results.add("read " + name, read);
    dif_mesh_free(read);
  }
  const c::OwnedField values = ugly({8, 7, 6}, 8);
  const dif_field field = c::c_field(values);
  for (const std::string name : {"f.npy", "f.nrrd"}) {
    dif_field_write_options options = c::prepared(dif_field_write_options_init);
    options.type = DIF_FLOAT32;
    const auto path = folder / name;
    REQUIRE(results.call("write " + name, [&] {
      return dif_field_write(&field, path.c_str(), &options);
    }) == DIF_OK);
    dif_field_file* file = nullptr;
    REQUIRE(results.call("read " + name,
                         [&] { return dif_field_read(path.c_str(), nullptr, &file); }) == DIF_OK);
    const c::FieldFileHandle handle(file);
    dif_field found{};
    found.struct_size = sizeof found;
    REQUIRE(results.call("field " + name, [&] { return dif_field_file_field(file, &found); }) ==
            DIF_OK);
    results.add("read " + name, found.data, values.values.size() * sizeof(float));
  }
}
#endif

Results everything(const Settings& wanted) {
  Results results(wanted);
  Probe probe{.wanted = wanted};
  reconstruct_all(results, probe);
  planes(results, probe);
  blocks(results);
  const c::OwnedField values = c::blob({20, 19, 18});
  const dif_field field = c::c_field(values);
  const dif_grid grid = c::c_grid({.dims = {20, 19, 18}});
  dif_options options = c::prepared(dif_options_init);
  options.edge_ids = 1;
  const c::MeshHandle mesh = c::c_reconstruct(field, &options);
  make_fields(results, probe, mesh.get());
  measure(results, probe, mesh.get(), grid);
#ifdef DIFMESH_TEST_FILES
  files(results, mesh.get());
#endif
  CHECK(probe.calls > 1000);
  CHECK(probe.strangers == 0);
  return results;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += name + "; ";
  }
  return text;
}

}  // namespace

TEST_CASE("results and the caller's floating-point settings do not depend on each other") {
  const Results expected = everything({});
  CHECK(expected.size() > 300);
  CHECK(joined(expected.disturbed()) == "");
  for (const Settings& wanted : all_settings()) {
    CAPTURE(wanted.rounding);
    CAPTURE(wanted.traps);
    CAPTURE(wanted.flags);
    CAPTURE(wanted.subnormals);
    const Results found = everything(wanted);
    CHECK(joined(found.disturbed()) == "");
    CHECK(joined(expected.differences(found)) == "");
  }
}

TEST_CASE("what a callback does to the settings of its own thread stays") {
  const c::OwnedField values = ugly({20, 19, 18}, 9);
  const dif_field field = c::c_field(values);
  dif_options options = c::prepared(dif_options_init);
  options.progress = [](void*, double) {
    std::feraiseexcept(FE_DIVBYZERO);
    std::fesetround(FE_DOWNWARD);
    return std::int32_t{0};
  };
  std::fesetenv(FE_DFL_ENV);
  dif_mesh* mesh = nullptr;
  const dif_status status = dif_reconstruct(&field, &options, &mesh);
  const Settings after = settings();
  std::fesetenv(FE_DFL_ENV);
  const c::MeshHandle handle(mesh);
  CHECK(status == DIF_OK);
  CHECK(after == Settings{.rounding = FE_DOWNWARD, .flags = FE_DIVBYZERO});
}
