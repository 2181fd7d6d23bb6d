#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "difmesh/cell_planes.hpp"
#include "difmesh/reconstruct.hpp"
#include "planes/kernels.hpp"
#include "support/fields.hpp"
#include "support/reports.hpp"

using namespace difmesh;
using difmesh::detail::Instructions;
using difmesh::test::OwnedField;
using difmesh::test::same_bits;

namespace {

// The instruction sets that this machine can be made to use, the baseline first.
std::vector<Instructions> instruction_sets() {
  std::vector<Instructions> sets;
  for (const Instructions set :
       {Instructions::baseline, Instructions::avx2, Instructions::avx512}) {
    if (detail::has_instructions(set)) {
      sets.push_back(set);
    }
  }
  return sets;
}

// Goes back in the end to what was chosen before.
class InstructionsGuard {
 public:
  InstructionsGuard() = default;
  InstructionsGuard(const InstructionsGuard&) = delete;
  InstructionsGuard& operator=(const InstructionsGuard&) = delete;
  ~InstructionsGuard() { detail::use_instructions(before_); }

 private:
  Instructions before_ = detail::instructions_in_use();
};

template <class T>
std::vector<T> converted(const OwnedField& field) {
  std::vector<T> values;
  for (const double value : field.values) {
    if constexpr (std::is_integral_v<T>) {
      values.push_back(static_cast<T>(value * std::numeric_limits<T>::max() + 0.5));
    } else {
      values.push_back(static_cast<T>(value));
    }
  }
  return values;
}

OwnedField blob_with_wisps(const Index3& dims) {
  OwnedField field = test::blob(dims);
  std::size_t n = 0;
  for (double& value : field.values) {
    const double wisp = static_cast<double>(n++ % 7) * 3e-8;
    value += n % 3 == 0 ? wisp : -wisp;
  }
  return field;
}

// Waves of planes that fill the domain and leave it through all sides.
OwnedField waves(const Index3& dims) {
  OwnedField field(dims);
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        const auto x = static_cast<double>(i);
        const auto y = static_cast<double>(j);
        const auto z = static_cast<double>(k);
        const double g = std::sin(0.31 * x) * std::cos(0.29 * y) +
                         std::sin(0.3 * y) * std::cos(0.33 * z) +
                         std::sin(0.28 * z) * std::cos(0.3 * x);
        field.at(i, j, k) = std::clamp(0.5 - 2.3 * g, 0.0, 1.0);
      }
    }
  }
  return field;
}

// A wavy film across the domain: all of it in a few layers of cells across the axis, about
// `middle`.
OwnedField film(const Index3& dims, std::size_t axis, double middle) {
  OwnedField field(dims);
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        const Index3 cell{i, j, k};
        const auto x = static_cast<double>(cell[(axis + 1) % 3]);
        const auto y = static_cast<double>(cell[(axis + 2) % 3]);
        const double level = middle + 0.4 * std::sin(0.3 * x) * std::cos(0.4 * y);
        field.at(i, j, k) = std::clamp(level - static_cast<double>(cell[axis]), 0.0, 1.0);
      }
    }
  }
  return field;
}

struct Case {
  std::string name;
  OwnedField field;
};

std::vector<Case> cases() {
  // Rows of more than one word of cells, and of fewer; noise that no stencil agrees with.
  return {{"blob", blob_with_wisps({70, 27, 25})},
          {"waves", waves({131, 15, 16})},
          {"noise", test::white_noise({33, 19, 12}, 5)},
          {"noise of halves", test::half_noise({66, 9, 8}, 6)},
          {"lying film", film({35, 27, 11}, 2, 5.5)},
          {"standing film", film({35, 11, 27}, 1, 5.5)},
          {"thin", test::white_noise({40, 1, 3}, 7)}};
}

template <class T>
void check_all_sets(const Case& each, const Options& options) {
  CAPTURE(each.name);
  CAPTURE(sizeof(T));
  const Grid grid{each.field.dims, {0.3, -1.0, 2.0}, {1.0, 0.7, 1.9}};
  const std::vector<T> values = converted<T>(each.field);
  const InstructionsGuard guard;
  std::vector<Reconstruction> results;
  for (const Instructions set : instruction_sets()) {
    for (const int threads : {1, 3}) {
      detail::use_instructions(set);
      Options with = options;
      with.threads = threads;
      // Where progress is asked for, one thread takes the field in portions too.
      with.progress = results.size() % 4 == 2 ? [](double) { return true; } : Progress{};
      results.push_back(reconstruct(FieldView::x_fastest(values.data(), grid.dims), grid, with));
      CAPTURE(static_cast<int>(set));
      CAPTURE(threads);
      CHECK(same_bits(results.front().mesh, results.back().mesh));
      CHECK(test::difference(results.front().report, results.back().report) == "");
    }
  }
}

}  // namespace

TEST_CASE("instruction sets: the same bits from each, on any number of threads") {
  MESSAGE("instruction sets: " << instruction_sets().size());
  for (const Case& each : cases()) {
    for (const Placement placement : {Placement::linear, Placement::manson, Placement::plic}) {
      for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
        Options options;
        options.placement = placement;
        options.boundary.fill(side);
        options.vertex_normals = true;
        options.edge_ids = true;
        check_all_sets<double>(each, options);
        check_all_sets<float>(each, options);
      }
    }
  }
}

TEST_CASE("instruction sets: the same bits for integers, and for all kinds of normals") {
  for (const Case& each : cases()) {
    for (const Normals normals :
         {Normals::youngs, Normals::myc, Normals::height_function, Normals::elvira}) {
      Options options;
      options.normals = normals;
      options.vertex_normals = true;
      check_all_sets<float>(each, options);
      if (each.name != "blob") {  // wisps below 0 are none of an integer's values
        check_all_sets<std::uint8_t>(each, options);
        check_all_sets<std::uint16_t>(each, options);
      }
    }
  }
}

// Cells whose neighbours along x do not lie next to each other in memory are taken one by one, by
// the general code.
TEST_CASE("kernels: the same bits as cell by cell") {
  for (const Case& each : cases()) {
    CAPTURE(each.name);
    const Index3& dims = each.field.dims;
    const Grid grid{dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    std::vector<double> apart(2 * each.field.values.size(),
                              std::numeric_limits<double>::quiet_NaN());
    for (std::size_t n = 0; n < each.field.values.size(); ++n) {
      apart[2 * n] = each.field.values[n];
    }
    FieldView view = FieldView::x_fastest(apart.data(), dims);
    view.strides = {2, 2 * dims[0], 2 * dims[0] * dims[1]};
    for (const Normals normals : {Normals::youngs, Normals::myc, Normals::height_function}) {
      Options options;
      options.normals = normals;
      options.vertex_normals = true;
      const Reconstruction together = reconstruct(each.field.view(), grid, options);
      const Reconstruction alone = reconstruct(view, grid, options);
      CHECK(same_bits(together.mesh, alone.mesh));
      CHECK(together.report.height_function_cells == alone.report.height_function_cells);
      CHECK(together.report.gradient_free_cells == alone.report.gradient_free_cells);
    }
  }
}

TEST_CASE("instruction sets: cell_planes gives the same bits from each") {
  const OwnedField field = waves({40, 30, 20});
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const Array<Index3> cells = interfacial_cells(field.view(), grid);
  REQUIRE(cells.size() > 1000);
  const InstructionsGuard guard;
  std::vector<std::vector<CellPlane>> results;
  for (const Instructions set : instruction_sets()) {
    detail::use_instructions(set);
    results.emplace_back(cells.size());
    cell_planes(field.view(), grid, cells, {}, results.back());
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const CellPlane& first = results.front()[n];
      const CellPlane& here = results.back()[n];
      REQUIRE(first.plane.normal == here.plane.normal);
      REQUIRE(first.plane.offset == here.plane.offset);
      REQUIRE(first.source == here.source);
    }
  }
}

#if defined(__linux__)
namespace {

// Memory that ends where no more may be read.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    size_ = (bytes + page - 1) / page * page + page;
    base_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    REQUIRE(base_ != MAP_FAILED);
    end_ = static_cast<char*>(base_) + size_ - page;
    REQUIRE(mprotect(end_, page, PROT_NONE) == 0);
  }
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;
  ~GuardedMemory() { munmap(base_, size_); }

  [[nodiscard]] char* last(std::size_t bytes) const { return end_ - bytes; }

 private:
  std::size_t size_ = 0;
  void* base_ = nullptr;
  char* end_ = nullptr;
};

template <class T>
void check_reads_within(const OwnedField& field) {
  const std::vector<T> values = converted<T>(field);
  const std::size_t bytes = values.size() * sizeof(T);
  const GuardedMemory memory(bytes);
  std::memcpy(memory.last(bytes), values.data(), bytes);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const auto in_vector = FieldView::x_fastest(values.data(), grid.dims);
  const auto at_end =
      FieldView::x_fastest(reinterpret_cast<const T*>(memory.last(bytes)), grid.dims);
  Options options;
  options.vertex_normals = true;
  CHECK(same_bits(reconstruct(at_end, grid, options).mesh,
                  reconstruct(in_vector, grid, options).mesh));
}

}  // namespace

TEST_CASE("kernels: read nothing beyond the field") {
  const InstructionsGuard guard;
  for (const Instructions set : instruction_sets()) {
    detail::use_instructions(set);
    // Films whose columns end with the field, shorter and longer along x than across.
    for (const Index3& dims : {Index3{19, 40, 11}, Index3{40, 19, 11}, Index3{11, 11, 11}}) {
      for (const std::size_t axis : {0U, 1U, 2U}) {
        const OwnedField field = film(dims, axis, static_cast<double>(dims[axis]) - 4.5);
        check_reads_within<float>(field);
        check_reads_within<double>(field);
        check_reads_within<std::uint8_t>(field);
        check_reads_within<std::uint16_t>(field);
      }
    }
    const OwnedField noise = test::white_noise({23, 31, 12}, 3);
    check_reads_within<float>(noise);
    check_reads_within<double>(noise);
  }
}
#endif
