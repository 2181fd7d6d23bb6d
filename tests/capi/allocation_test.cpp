// Every allocation of a call fails once, and every progress call cancels once: a status, nothing
// leaked.

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "handles.hpp"

namespace {

std::atomic<std::int64_t> live_allocations = 0;
std::atomic<std::int64_t> allocations = 0;
std::atomic<std::int64_t> failing_allocation = -1;       // number of the one that fails
std::atomic<std::size_t> largest_allocation = SIZE_MAX;  // larger ones fail

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (allocations++ == failing_allocation || bytes > largest_allocation) {
    throw std::bad_alloc();
  }
  void* memory =
      alignment > alignof(std::max_align_t)
          ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
          : std::malloc(bytes > 0 ? bytes : 1);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  ++live_allocations;
  return memory;
}

void release(void* memory) noexcept {
  if (memory != nullptr) {
    --live_allocations;
    std::free(memory);
  }
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocate(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}

namespace {

namespace test = difmesh::test;

// Fails the first allocation of a call, then the second, until it gets through. The call gives back
// what it made, so that all it allocated must be gone.
template <class Call>
void fail_each_allocation(const char* name, const Call& call) {
  INFO(std::string(name));
  REQUIRE(call() == DIF_OK);  // what is made once per program is there
  std::int64_t failures = 0;
  for (;; ++failures) {
    REQUIRE(failures < 100000);
    const std::int64_t live = live_allocations;
    allocations = 0;
    failing_allocation = failures;
    const dif_status status = call();
    failing_allocation = -1;
    const bool failed = allocations > failures;
    const std::int64_t leaked = live_allocations - live;
    if (leaked != 0 || status != (failed ? DIF_ERROR_OUT_OF_MEMORY : DIF_OK)) {
      INFO("allocation " << failures << ": " << std::string(dif_last_message()));
      CHECK(leaked == 0);
      CHECK(status == (failed ? DIF_ERROR_OUT_OF_MEMORY : DIF_OK));
    }
    if (!failed) {
      break;
    }
  }
  CHECK(failures > 0);
  MESSAGE(std::string(name) << ": " << failures << " allocations failed, one after the other");
}

struct Canceller {
  std::int64_t calls = 0;
  std::int64_t last = -1;  // the call that cancels

  static std::int32_t progress(void* user, double /*share_done*/) {
    auto& self = *static_cast<Canceller*>(user);
    return self.calls++ == self.last ? 1 : 0;
  }
};

template <class Call>
void cancel_each_time(const char* name, const Call& call) {
  INFO(std::string(name));
  Canceller whole;
  REQUIRE(call(whole) == DIF_OK);
  REQUIRE(whole.calls >= 3);
  for (std::int64_t n = 0; n < whole.calls; ++n) {
    const std::int64_t live = live_allocations;
    Canceller canceller{0, n};
    REQUIRE(call(canceller) == DIF_ERROR_CANCELLED);
    REQUIRE(canceller.calls == n + 1);
    REQUIRE(live_allocations == live);
  }
}

struct Fixture {
  test::OwnedField values = test::white_noise({5, 4, 3}, 17);
  dif_field field = test::c_field(values);
  dif_grid grid = test::c_grid(
      {.dims = {4, 4, 4}, .origin = {-1.5, -1.5, -1.5}, .spacing = {0.75, 0.75, 0.75}});
  std::vector<double> fractions = std::vector<double>(64);
  test::ShapeHandle shape;
  test::MeshHandle sphere;
  std::vector<double> planes = std::vector<double>(60);

  Fixture() {
    dif_shape* made = nullptr;
    REQUIRE(dif_shape_create(nullptr, &made) == DIF_OK);
    shape.reset(made);
    REQUIRE(dif_fractions_from_shape(&grid, made, nullptr, nullptr, fractions.data()) == DIF_OK);
    dif_field field_of_shape = test::c_field(fractions.data(), DIF_FLOAT64, {4, 4, 4});
    std::copy_n(grid.origin, 3, field_of_shape.origin);
    std::copy_n(grid.spacing, 3, field_of_shape.spacing);
    sphere = test::c_reconstruct(field_of_shape);
  }

  [[nodiscard]] dif_status reconstruct(const dif_options* options) const {
    dif_mesh* mesh = nullptr;
    const dif_status status = dif_reconstruct(&field, options, &mesh);
    CHECK((mesh == nullptr) == (status != DIF_OK));
    dif_mesh_free(mesh);
    return status;
  }
  [[nodiscard]] dif_status field_planes(const dif_options* options) {
    dif_plane_arrays arrays = test::prepared(dif_plane_arrays_init);
    arrays.offset = planes.data();
    arrays.strides[0] = 1;
    arrays.strides[1] = 5;
    arrays.strides[2] = 20;
    return dif_field_planes(&field, options, &arrays);
  }
  [[nodiscard]] dif_status cell_curvature(const dif_options* options) {
    return dif_cell_curvature(&field, options, planes.data(), nullptr);
  }
};

}  // namespace

TEST_CASE("a failed allocation anywhere is a status and leaks nothing") {
  Fixture f;
  dif_options options = test::prepared(dif_options_init);
  options.vertex_normals = 1;
  options.edge_ids = 1;
  for (const std::int32_t threads : {1, 2}) {
    options.threads = threads;
    fail_each_allocation("dif_reconstruct", [&] { return f.reconstruct(&options); });
    fail_each_allocation("dif_field_planes", [&] { return f.field_planes(&options); });
    fail_each_allocation("dif_cell_curvature", [&] { return f.cell_curvature(&options); });
    dif_function_options function_options = test::prepared(dif_function_options_init);
    function_options.threads = threads;
    fail_each_allocation("dif_fractions_from_shape", [&] {
      return dif_fractions_from_shape(&f.grid, f.shape.get(), &function_options, nullptr,
                                      f.fractions.data());
    });
    dif_triangle_options triangle_options = test::prepared(dif_triangle_options_init);
    triangle_options.threads = threads;
    fail_each_allocation("dif_fractions_from_mesh", [&] {
      return dif_fractions_from_mesh(&f.grid, f.sphere.get(), &triangle_options, nullptr,
                                     f.fractions.data());
    });
    dif_curvature_options curvature_options = test::prepared(dif_curvature_options_init);
    curvature_options.threads = threads;
    std::vector<double> mean(test::mesh_of(f.sphere.get()).positions.size());
    fail_each_allocation("dif_mesh_curvature", [&] {
      return dif_mesh_curvature(f.sphere.get(), &curvature_options, mean.data(), nullptr, nullptr,
                                nullptr);
    });
    dif_smoothing_options smoothing_options = test::prepared(dif_smoothing_options_init);
    smoothing_options.threads = threads;
    for (const std::int32_t kind : {DIF_SMOOTHING_TAUBIN, DIF_SMOOTHING_FLOW}) {
      smoothing_options.kind = kind;
      fail_each_allocation("dif_mesh_smooth", [&] {
        dif_mesh* mesh = nullptr;
        const dif_status status =
            dif_mesh_smooth(f.sphere.get(), nullptr, &smoothing_options, &mesh);
        dif_mesh_free(mesh);
        return status;
      });
    }
    dif_mollify_options mollify_options = test::prepared(dif_mollify_options_init);
    mollify_options.threads = threads;
    fail_each_allocation("dif_mollify",
                         [&] { return dif_mollify(&f.field, &mollify_options, f.planes.data()); });
  }
  fail_each_allocation("dif_mesh_measure", [&] {
    dif_measure measure = test::prepared(dif_measure_init);
    return dif_mesh_measure(f.sphere.get(), &measure);
  });
  fail_each_allocation("dif_shape_create", [] {
    dif_shape_options golf_ball = test::prepared(dif_shape_options_init);
    golf_ball.kind = DIF_SHAPE_GOLF_BALL;
    dif_shape* shape = nullptr;
    const dif_status status = dif_shape_create(&golf_ball, &shape);
    dif_shape_free(shape);
    return status;
  });
  // Not distances: Embree 3.13 damages its heap where an allocation of its own fails.
  if (dif_has(DIF_PART_FILES) == 1) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                         ("difmesh_allocation_" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder);
    for (const char* extension : {".ply", ".obj", ".off", ".stl"}) {
      const std::string path = folder / (std::string("sphere") + extension);
      fail_each_allocation("dif_mesh_write", [&] {
        return dif_mesh_write(f.sphere.get(), path.c_str(), nullptr, nullptr);
      });
      fail_each_allocation("dif_mesh_read", [&] {
        dif_mesh* mesh = nullptr;
        const dif_status status = dif_mesh_read(path.c_str(), &mesh);
        dif_mesh_free(mesh);
        return status;
      });
    }
    const std::vector<double> numbers(test::mesh_of(f.sphere.get()).positions.size());
    fail_each_allocation("dif_mesh_set_scalars", [&] {
      const dif_status status = dif_mesh_set_scalars(f.sphere.get(), "numbers", numbers.data());
      const dif_status removed = dif_mesh_set_scalars(f.sphere.get(), "numbers", nullptr);
      return status == DIF_OK ? removed : status;
    });
    for (const char* extension : {".npy", ".nrrd"}) {
      const std::string path = folder / (std::string("field") + extension);
      fail_each_allocation("dif_field_write",
                           [&] { return dif_field_write(&f.field, path.c_str(), nullptr); });
      fail_each_allocation("dif_field_read", [&] {
        dif_field_file* file = nullptr;
        const dif_status status = dif_field_read(path.c_str(), nullptr, &file);
        dif_field_file_free(file);
        return status;
      });
    }
    CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 6);
    std::filesystem::remove_all(folder);
  }
}

TEST_CASE("cancelling at any progress call is a status and leaks nothing") {
  Fixture f;
  cancel_each_time("dif_reconstruct", [&](Canceller& canceller) {
    dif_options options = test::prepared(dif_options_init);
    options.progress = Canceller::progress;
    options.progress_user = &canceller;
    return f.reconstruct(&options);
  });
  cancel_each_time("dif_field_planes", [&](Canceller& canceller) {
    dif_options options = test::prepared(dif_options_init);
    options.progress = Canceller::progress;
    options.progress_user = &canceller;
    return f.field_planes(&options);
  });
  cancel_each_time("dif_cell_curvature", [&](Canceller& canceller) {
    dif_options options = test::prepared(dif_options_init);
    options.progress = Canceller::progress;
    options.progress_user = &canceller;
    return f.cell_curvature(&options);
  });
  cancel_each_time("dif_fractions_from_shape", [&](Canceller& canceller) {
    dif_function_options options = test::prepared(dif_function_options_init);
    options.progress = Canceller::progress;
    options.progress_user = &canceller;
    return dif_fractions_from_shape(&f.grid, f.shape.get(), &options, nullptr, f.fractions.data());
  });
  cancel_each_time("dif_fractions_from_mesh", [&](Canceller& canceller) {
    dif_triangle_options options = test::prepared(dif_triangle_options_init);
    options.progress = Canceller::progress;
    options.progress_user = &canceller;
    return dif_fractions_from_mesh(&f.grid, f.sphere.get(), &options, nullptr, f.fractions.data());
  });
  if (dif_has(DIF_PART_DISTANCE) == 1) {
    cancel_each_time("dif_distance_to_mesh", [&](Canceller& canceller) {
      dif_distance_options options = test::prepared(dif_distance_options_init);
      options.progress = Canceller::progress;
      options.progress_user = &canceller;
      dif_distance there = test::prepared(dif_distance_init);
      dif_distance back = test::prepared(dif_distance_init);
      return dif_distance_to_mesh(f.sphere.get(), f.sphere.get(), &options, &there, &back);
    });
  }
}

namespace {

// A field of one number, that takes no memory itself.
struct ConstantField {
  double value = 0.5;
  std::int64_t calls = 0;
  double share_done = 0.0;

  dif_status reconstruct(const difmesh::Index3& dims) {
    dif_field field = test::c_field(&value, DIF_FLOAT64, dims);
    std::fill_n(field.strides, 3, 0);
    dif_options options = test::prepared(dif_options_init);
    options.progress_user = this;
    options.progress = [](void* user, double share) {
      auto& self = *static_cast<ConstantField*>(user);
      ++self.calls;
      self.share_done = share;
      return std::int32_t{0};
    };
    dif_mesh* mesh = nullptr;
    const dif_status status = dif_reconstruct(&field, &options, &mesh);
    dif_mesh_free(mesh);
    return status;
  }
};

}  // namespace

TEST_CASE("what is too large for the memory is told before it is read") {
  ConstantField rows;
  largest_allocation = 100'000'000;
  const dif_status of_rows = rows.reconstruct({1, 4000, 4000});
  largest_allocation = SIZE_MAX;
  CHECK(of_rows == DIF_ERROR_OUT_OF_MEMORY);
  // 4002 x 4002 rows: 8 bytes of bits and 14 more.
  CHECK(std::string(dif_last_message()) ==
        "out of memory: 1 x 4000 x 4000 cells need 0.352 GB for one bit each and some bytes per "
        "row");
  CHECK(rows.calls == 0);

  // The planes of a layer of interfacial cells along open sides: known as soon as too many are
  // seen.
  ConstantField layer;
  largest_allocation = 70'000'000;
  const dif_status of_layer = layer.reconstruct({4000, 4000, 1});
  const std::string message = dif_last_message();
  layer.value = 0.0;
  const dif_status of_empty_layer = layer.reconstruct({4000, 4000, 1});
  largest_allocation = SIZE_MAX;
  CHECK(of_layer == DIF_ERROR_OUT_OF_MEMORY);
  CHECK(message ==
        "out of memory: 4000 x 4000 x 1 cells need 0.0912 GB for planes of interfacial ones along "
        "open sides, or more");
  CHECK(of_empty_layer == DIF_OK);
}

TEST_CASE("a reconstruction without memory tells what for") {
  const Fixture f;
  const dif_options options = test::prepared(dif_options_init);
  std::set<std::string> messages;
  for (std::int64_t n = 0; n < 1000; ++n) {
    failing_allocation = n;
    allocations = 0;
    const dif_status status = f.reconstruct(&options);
    failing_allocation = -1;
    if (status == DIF_OK) {
      break;
    }
    messages.insert(dif_last_message());
  }
  const auto of = [](const std::string& what) {
    return "out of memory for " + what + " of 5 x 4 x 3 cells";
  };
  for (const char* const what :
       {"the inside bits", "the planes", "the counts", "the vertices", "the triangles"}) {
    CHECK(messages.count(of(what)) == 1);
  }
}
