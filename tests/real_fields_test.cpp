// Fields from three flow solvers: see the README beside the data. Where the data is absent, the
// tests say so and do nothing.

#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "difmesh/io/field_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/blocks.hpp"
#include "support/reports.hpp"
#include "support/slabs.hpp"

using namespace difmesh;

namespace {

struct RealField {
  test::OwnedField cells{{0, 0, 0}};
  Grid grid;
};

std::optional<RealField> load(const std::string& name, const Vec3& origin, const Vec3& spacing) {
  const std::filesystem::path path = std::filesystem::path(DIFMESH_SHARED_DATA) / (name + ".npy");
  if (!std::filesystem::exists(path)) {
    MESSAGE("skipped: no " << path.string());
    return std::nullopt;
  }
  const FieldFile file = read_field(path);
  REQUIRE(file.type == ScalarType::float64);
  RealField field{test::OwnedField(file.dims), {file.dims, origin, spacing}};
  const FieldView view = file.view();
  const auto* first = static_cast<const double*>(view.data);
  for (std::int64_t k = 0; k < file.dims[2]; ++k) {
    for (std::int64_t j = 0; j < file.dims[1]; ++j) {
      for (std::int64_t i = 0; i < file.dims[0]; ++i) {
        field.cells.at(i, j, k) =
            first[i * view.strides[0] + j * view.strides[1] + k * view.strides[2]];
      }
    }
  }
  return field;
}

std::optional<RealField> load_drops() {
  return load("gerris_drops64_t0.45", {-0.5, -0.5, -0.5}, {0.015625, 0.015625, 0.015625});
}
std::optional<RealField> load_dam_break() {
  return load("interfoam_dambreak_64x40x80_t0.3", {0.0, 0.0, 0.0}, {0.015625, 0.025, 0.0125});
}
std::optional<RealField> load_vortex() {
  return load("isofoam_vortex64_t1.5", {0.0, 0.0, 0.0}, {0.015625, 0.015625, 0.015625});
}

Reconstruction run(const RealField& field, Side side, Placement placement = Placement::plic) {
  Options options;
  options.boundary.fill(side);
  options.placement = placement;
  return reconstruct(field.cells.view(), field.grid, options);
}

double volume_error(const Reconstruction& result) {
  return result.report.enclosed_volume / result.report.fraction_volume - 1.0;
}

// Volume of the cells below 1/2 without a neighbour, over faces, edges or corners, of at least 1/2:
// no dual cell around them has a node inside, so that no contour at 1/2 can hold them.
double out_of_reach(const RealField& field) {
  const Index3& dims = field.grid.dims;
  double sum = 0.0;
  for (std::int64_t n = 0; n < field.grid.cell_count(); ++n) {
    const Index3 cell{n % dims[0], n / dims[0] % dims[1], n / dims[0] / dims[1]};
    bool reached = false;
    for (int m = 0; m < 27 && !reached; ++m) {
      Index3 other{cell[0] + m % 3 - 1, cell[1] + m / 3 % 3 - 1, cell[2] + m / 9 - 1};
      bool there = true;
      for (std::size_t a = 0; a < 3; ++a) {
        there = there && other[a] >= 0 && other[a] < dims[a];
      }
      reached = there && field.cells.values[static_cast<std::size_t>(
                             (other[2] * dims[1] + other[1]) * dims[0] + other[0])] >= 0.5;
    }
    sum += reached ? 0.0 : field.cells.values[static_cast<std::size_t>(n)];
  }
  return sum * field.grid.cell_volume();
}

}  // namespace

TEST_CASE("real fields: merged drops keep their volume") {
  if (const auto field = load_drops()) {
    const Reconstruction drops = run(*field, Side::empty);
    const Measure facts = measure(drops.mesh);
    CHECK(facts.closed);
    CHECK(facts.manifold);
    CHECK(facts.euler_number == 2);
    CHECK(drops.report.fraction_volume == doctest::Approx(0.02284479571901324).epsilon(1e-12));
    CHECK(std::abs(volume_error(drops)) < 0.01);
    // The drops end far from the sides: these make no difference.
    CHECK(test::same_bits(run(*field, Side::open).mesh, drops.mesh));
    CHECK(test::same_bits(run(*field, Side::periodic).mesh, drops.mesh));
  }
}

TEST_CASE("real fields: a dam break meets the walls on the domain faces") {
  if (const auto field = load_dam_break()) {
    const Reconstruction closed = run(*field, Side::empty);
    CHECK(measure(closed.mesh).manifold);
    CHECK(closed.report.closed);
    CHECK(std::abs(volume_error(closed)) < 0.01);
    CHECK(closed.report.clamped_cells > 100000);

    const Mesh open = run(*field, Side::open).mesh;
    CHECK(measure(open).manifold);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : open.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto ends = std::minmax(t[c], t[(c + 1) % 3]);
        ++edges[{ends.first, ends.second}];
      }
    }
    std::array<int, 6> on_side{};
    for (const auto& [ends, count] : edges) {
      if (count == 2) {
        continue;
      }
      int sides = 0;
      for (std::size_t s = 0; s < 6; ++s) {
        const std::size_t a = s / 2;
        const double face = s % 2 == 0
                                ? field->grid.origin[a]
                                : field->grid.origin[a] + static_cast<double>(field->grid.dims[a]) *
                                                              field->grid.spacing[a];
        if (open.positions[ends.first][a] == face && open.positions[ends.second][a] == face) {
          ++on_side[s];
          ++sides;
        }
      }
      CHECK(sides >= 1);
    }
    // Water stands against four sides; the top is open air and one wall is dry.
    CHECK(std::count_if(on_side.begin(), on_side.end(), [](int n) { return n > 10; }) == 4);
  }
}

TEST_CASE("real fields: a torn film loses what no contour at one half can hold") {
  if (const auto field = load_vortex()) {
    const Reconstruction film = run(*field, Side::empty);
    CHECK(measure(film.mesh).manifold);
    CHECK(film.report.closed);
    CHECK(film.report.interfacial_cells < 6000);
    // A twelfth of the film is thinner than half a cell. What lies in cells that no vertex can
    // reach, and the ligaments next to it, is all that is lost; plic loses less of the rest than
    // linear.
    const double error = volume_error(film);
    const double unreachable = out_of_reach(*field) / film.report.fraction_volume;
    MESSAGE("film: volume error " << error << ", share out of reach " << unreachable);
    CHECK(error < -unreachable);
    CHECK(std::abs(error) < std::abs(volume_error(run(*field, Side::empty, Placement::linear))));
  }
}

TEST_CASE("real fields: blocks and slabs give the whole field to the last bit") {
  for (const auto& field : {load_drops(), load_dam_break(), load_vortex()}) {
    if (!field) {
      continue;
    }
    for (const Side side : {Side::open, Side::empty}) {
      Options options;
      options.boundary.fill(side);
      options.edge_ids = true;
      options.vertex_normals = true;
      const Reconstruction whole = reconstruct(field->cells.view(), field->grid, options);
      const Reconstruction joined =
          test::in_blocks(field->cells, field->grid, {29, 17, 41}, options);
      CHECK(test::same_bits(joined.mesh, whole.mesh));
      CHECK(test::difference(joined.report, whole.report, 1e-11) == "");
      for (const std::int64_t thickness : {1, 7, 40}) {
        const Reconstruction built =
            test::in_slabs(field->cells.view(), field->grid, options, thickness);
        CHECK(test::same_bits(built.mesh, whole.mesh));
        CHECK(test::difference(built.report, whole.report) == "");
      }
    }
  }
}

TEST_CASE("real fields: curved surfaces are manifold, and in slabs the same") {
  for (const auto& field : {load_drops(), load_dam_break(), load_vortex()}) {
    if (!field) {
      continue;
    }
    Options options;
    options.placement = Placement::curved;
    options.edge_ids = true;
    options.boundary.fill(Side::empty);
    const Reconstruction whole = reconstruct(field->cells.view(), field->grid, options);
    CHECK(measure(whole.mesh).manifold);
    CHECK(whole.report.closed);
    CHECK(whole.report.curved_vertices > 1000);
    const Reconstruction slabs = test::in_slabs(field->cells.view(), field->grid, options, 11, 11);
    CHECK(test::same_bits(slabs.mesh, whole.mesh));
    CHECK(test::difference(slabs.report, whole.report) == "");
  }
}
