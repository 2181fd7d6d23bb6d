// Programs compiled against older and newer headers have shorter and longer structs: both work.

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "handles.hpp"

namespace {

namespace test = difmesh::test;

// Memory of a caller whose struct has `size` bytes, with a guard behind it. The whole must be large
// enough for the struct, as the compiler may assume that where it sees the type.
class CallersStruct {
 public:
  explicit CallersStruct(std::size_t size) : size_(size), words_(kWords, kGuard) {}

  template <class Struct>
  Struct* as() {
    static_assert(sizeof(Struct) <= kWords * 8);
    return reinterpret_cast<Struct*>(words_.data());
  }
  [[nodiscard]] std::uint64_t word(std::size_t index) const { return words_[index]; }
  void set_word(std::size_t index, std::uint64_t value) { words_[index] = value; }
  [[nodiscard]] bool guard_is_whole() const {
    for (std::size_t word = size_ / 8; word < words_.size(); ++word) {
      if (words_[word] != kGuard) {
        return false;
      }
    }
    return true;
  }

  static constexpr std::uint64_t kGuard = 0xA5A5A5A5A5A5A5A5U;

 private:
  static constexpr std::size_t kWords = 64;
  std::size_t size_;
  std::vector<std::uint64_t> words_;
};

// _init of any release's struct: the known part as today's, zeros behind, nothing beyond the size.
template <class Struct, class Init>
void check_init(const char* name, const Init& init) {
  INFO(std::string(name));
  CallersStruct today(sizeof(Struct));
  REQUIRE(init(today.as<Struct>(), sizeof(Struct)) == DIF_OK);
  for (std::size_t size = 8; size <= sizeof(Struct) + 64; size += 8) {
    CallersStruct other(size);
    REQUIRE(init(other.as<Struct>(), size) == DIF_OK);
    CHECK(other.word(0) == size);
    CHECK(other.guard_is_whole());
    for (std::size_t word = 1; word < size / 8; ++word) {
      CHECK(other.word(word) == (word < sizeof(Struct) / 8 ? today.word(word) : 0));
    }
  }
  for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{7}, std::uint64_t{20},
                                   std::uint64_t{4104}, CallersStruct::kGuard}) {
    CallersStruct other(0);
    CHECK(init(other.as<Struct>(), size) == DIF_ERROR_STRUCT);
    CHECK(other.guard_is_whole());
  }
  CHECK(init(nullptr, sizeof(Struct)) == DIF_ERROR_INVALID_ARGUMENT);
}

// A call that reads a struct: its defaults in every length give DIF_OK, zeros of a longer one too,
// and something in its unknown tail is refused. Lengths below `least` lack what the call cannot do
// without.
template <class Struct, class Init, class Call>
void check_reading(const char* name, const Init& init, const Call& call, std::size_t least = 8) {
  INFO(std::string(name));
  for (std::size_t size = least; size <= sizeof(Struct) + 64; size += 8) {
    CallersStruct other(size);
    REQUIRE(init(other.as<Struct>(), size) == DIF_OK);
    INFO(size);
    CHECK(call(other.as<Struct>()) == DIF_OK);
    for (std::size_t word = sizeof(Struct) / 8; word < size / 8; ++word) {
      other.set_word(word, std::uint64_t{1} << 63);
      CHECK(call(other.as<Struct>()) == DIF_ERROR_STRUCT);
      CHECK(std::string(dif_last_message()).find("does not know") != std::string::npos);
      other.set_word(word, 0);
    }
  }
  CallersStruct garbage(sizeof(Struct));
  CHECK(call(garbage.as<Struct>()) == DIF_ERROR_STRUCT);
}

// A call that fills a struct, which has at least its size set.
template <class Struct, class Call>
void check_filling(const char* name, const Call& call) {
  INFO(std::string(name));
  for (std::size_t size = 8; size <= sizeof(Struct) + 64; size += 8) {
    CallersStruct other(size);
    other.set_word(0, size);
    CHECK(call(other.as<Struct>()) == DIF_OK);
    CHECK(other.word(0) == size);
    CHECK(other.guard_is_whole());
    for (std::size_t word = sizeof(Struct) / 8; word < size / 8; ++word) {
      CHECK(other.word(word) == 0);
    }
  }
}

const std::int64_t kDims[3] = {12, 12, 12};

}  // namespace

TEST_CASE("init functions serve structs of every length") {
  const double data = 0.0;
  check_init<dif_field>("field", [&](dif_field* field, std::uint64_t size) {
    return dif_field_init(field, size, &data, DIF_FLOAT64, kDims);
  });
  check_init<dif_grid>(
      "grid", [](dif_grid* grid, std::uint64_t size) { return dif_grid_init(grid, size, kDims); });
  check_init<dif_options>("options", dif_options_init);
  check_init<dif_report>("report", dif_report_init);
  check_init<dif_plane_arrays>("plane_arrays", dif_plane_arrays_init);
  check_init<dif_surface_arrays>("surface_arrays", dif_surface_arrays_init);
  check_init<dif_function_options>("function_options", dif_function_options_init);
  check_init<dif_function_report>("function_report", dif_function_report_init);
  check_init<dif_triangle_options>("triangle_options", dif_triangle_options_init);
  check_init<dif_triangle_report>("triangle_report", dif_triangle_report_init);
  check_init<dif_shape_options>("shape_options", dif_shape_options_init);
  check_init<dif_measure>("measure", dif_measure_init);
  check_init<dif_distance_options>("distance_options", dif_distance_options_init);
  check_init<dif_distance>("distance", dif_distance_init);
  check_init<dif_mesh_write_options>("mesh_write_options", dif_mesh_write_options_init);
  check_init<dif_mesh_write_report>("mesh_write_report", dif_mesh_write_report_init);
  check_init<dif_raw_layout>("raw_layout", dif_raw_layout_init);
  check_init<dif_mesh_read_options>("mesh_read_options", dif_mesh_read_options_init);
  check_init<dif_field_read_options>("field_read_options", dif_field_read_options_init);
  check_init<dif_field_write_options>("field_write_options", dif_field_write_options_init);
  check_init<dif_block>("block", dif_block_init);
  check_init<dif_curvature_options>("curvature_options", dif_curvature_options_init);
  check_init<dif_smoothing_options>("smoothing_options", dif_smoothing_options_init);
  check_init<dif_mollify_options>("mollify_options", dif_mollify_options_init);
}

TEST_CASE("calls read structs of every length") {
  const test::OwnedField blob = test::blob({12, 12, 12});
  const dif_field field = test::c_field(blob);
  const auto reconstruct = [](const dif_field* of, const dif_options* options) {
    dif_mesh* mesh = nullptr;
    const dif_status status = dif_reconstruct(of, options, &mesh);
    dif_mesh_free(mesh);
    return status;
  };
  check_reading<dif_options>("options", dif_options_init, [&](const dif_options* options) {
    return reconstruct(&field, options);
  });
  const test::MeshHandle surface = test::c_reconstruct(field);
  std::vector<double> numbers(12 * 12 * 12 + test::mesh_of(surface.get()).positions.size());
  check_reading<dif_curvature_options>(
      "curvature_options", dif_curvature_options_init, [&](const dif_curvature_options* options) {
        return dif_mesh_curvature(surface.get(), options, numbers.data(), nullptr, nullptr,
                                  nullptr);
      });
  check_reading<dif_smoothing_options>(
      "smoothing_options", dif_smoothing_options_init, [&](const dif_smoothing_options* options) {
        dif_mesh* mesh = nullptr;
        const dif_status status = dif_mesh_smooth(surface.get(), nullptr, options, &mesh);
        dif_mesh_free(mesh);
        return status;
      });
  check_reading<dif_mollify_options>("mollify_options", dif_mollify_options_init,
                                     [&](const dif_mollify_options* options) {
                                       return dif_mollify(&field, options, numbers.data());
                                     });
  check_reading<dif_field>(
      "field",
      [&](dif_field* of, std::uint64_t size) {
        return dif_field_init(of, size, blob.values.data(), DIF_FLOAT64, kDims);
      },
      [&](const dif_field* of) { return reconstruct(of, nullptr); }, sizeof(dif_field));

  const dif_grid grid =
      test::c_grid({.dims = blob.dims, .origin = {-2, -2, -2}, .spacing = {0.4, 0.4, 0.4}});
  dif_shape* made = nullptr;
  REQUIRE(dif_shape_create(nullptr, &made) == DIF_OK);
  const test::ShapeHandle shape(made);
  std::vector<double> fractions(12 * 12 * 12);
  check_reading<dif_grid>(
      "grid", [](dif_grid* of, std::uint64_t size) { return dif_grid_init(of, size, kDims); },
      [&](const dif_grid* of) {
        return dif_fractions_from_shape(of, made, nullptr, nullptr, fractions.data());
      },
      offsetof(dif_grid, origin));
  check_reading<dif_function_options>(
      "function_options", dif_function_options_init, [&](const dif_function_options* options) {
        return dif_fractions_from_shape(&grid, made, options, nullptr, fractions.data());
      });
  check_reading<dif_shape_options>("shape_options", dif_shape_options_init,
                                   [](const dif_shape_options* options) {
                                     dif_shape* other = nullptr;
                                     const dif_status status = dif_shape_create(options, &other);
                                     dif_shape_free(other);
                                     return status;
                                   });
  const auto mesh = test::c_reconstruct(field);
  check_reading<dif_triangle_options>(
      "triangle_options", dif_triangle_options_init, [&](const dif_triangle_options* options) {
        return dif_fractions_from_mesh(&grid, mesh.get(), options, nullptr, fractions.data());
      });
  if (dif_has(DIF_PART_DISTANCE) == 1) {
    dif_distance distance = test::prepared(dif_distance_init);
    check_reading<dif_distance_options>(
        "distance_options", dif_distance_options_init, [&](const dif_distance_options* options) {
          return dif_distance_to_shape(mesh.get(), made, options, &distance);
        });
    check_filling<dif_distance>("distance", [&](dif_distance* to) {
      return dif_distance_to_shape(mesh.get(), made, nullptr, to);
    });
  }
  check_filling<dif_report>(
      "report", [&](dif_report* report) { return dif_mesh_report(mesh.get(), report); });
  check_filling<dif_measure>(
      "measure", [&](dif_measure* measure) { return dif_mesh_measure(mesh.get(), measure); });
  check_filling<dif_function_report>("function_report", [&](dif_function_report* report) {
    return dif_fractions_from_shape(&grid, made, nullptr, report, fractions.data());
  });
  check_filling<dif_triangle_report>("triangle_report", [&](dif_triangle_report* report) {
    return dif_fractions_from_mesh(&grid, mesh.get(), nullptr, report, fractions.data());
  });
  if (dif_has(DIF_PART_FILES) == 1) {
    dif_mesh_write_options ply = test::prepared(dif_mesh_write_options_init);
    ply.format = "ply";
    check_filling<dif_mesh_write_report>("mesh_write_report", [&](dif_mesh_write_report* report) {
      return dif_mesh_write(mesh.get(), "/dev/null", &ply, report);
    });
  }
}

TEST_CASE("fields that a shorter struct lacks take their defaults") {
  const test::OwnedField noise = test::white_noise({12, 12, 12}, 4);
  const dif_field field = test::c_field(noise);
  dif_options options = test::prepared(dif_options_init);
  options.placement = DIF_PLACEMENT_LINEAR;
  options.purity_tolerance = -1.0;  // refused where it is seen
  dif_mesh* mesh = nullptr;
  CHECK(dif_reconstruct(&field, &options, &mesh) == DIF_ERROR_INVALID_ARGUMENT);
  options.struct_size = offsetof(dif_options, purity_tolerance);
  const auto seen = test::c_reconstruct(field, &options);
  dif_options wanted = test::prepared(dif_options_init);
  wanted.placement = DIF_PLACEMENT_LINEAR;
  CHECK(test::same_bits(test::mesh_of(seen.get()),
                        test::mesh_of(test::c_reconstruct(field, &wanted).get())));
}
