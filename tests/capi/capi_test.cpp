// The C interface gives what the C++ core gives, to the last bit.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "difmesh/difmesh.hpp"
#include "handles.hpp"

namespace {

using difmesh::FieldView;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Mesh;
using difmesh::Options;
using difmesh::Placement;
using difmesh::Side;
namespace test = difmesh::test;

const Grid kGrid{.dims = {17, 14, 12}, .origin = {1.0, -2.0, 3.5}, .spacing = {0.5, 1.0, 0.75}};

dif_field placed(dif_field field) {
  for (int axis = 0; axis < 3; ++axis) {
    field.origin[axis] = kGrid.origin[static_cast<std::size_t>(axis)];
    field.spacing[axis] = kGrid.spacing[static_cast<std::size_t>(axis)];
  }
  return field;
}

dif_options with_all() {
  dif_options options = test::prepared(dif_options_init);
  options.vertex_normals = 1;
  options.edge_ids = 1;
  return options;
}

Options cxx_with_all() {
  Options options;
  options.vertex_normals = true;
  options.edge_ids = true;
  return options;
}

}  // namespace

TEST_CASE("version and names") {
  CHECK(dif_version() ==
        1000000 * DIF_VERSION_MAJOR + 1000 * DIF_VERSION_MINOR + DIF_VERSION_PATCH);
  CHECK(std::string(dif_version_text()) == DIFMESH_VERSION);
  CHECK(DIF_VERSION_MAJOR == DIFMESH_VERSION_MAJOR);
  CHECK(DIF_VERSION_MINOR == DIFMESH_VERSION_MINOR);
  CHECK(DIF_VERSION_PATCH == DIFMESH_VERSION_PATCH);
  CHECK(std::string(dif_status_name(DIF_ERROR_FILE_WRITE)) == "DIF_ERROR_FILE_WRITE");
  CHECK(std::string(dif_status_name(-7)) == "unknown status");
  CHECK(dif_has(0) == 0);
  CHECK(dif_has(99) == 0);
}

TEST_CASE("a reconstruction has the bits of the core's for every choice") {
  const test::OwnedField blob = test::blob(kGrid.dims);
  const test::OwnedField noise = test::white_noise(kGrid.dims, 3);
  const std::array placements{Placement::midpoint, Placement::linear, Placement::manson,
                              Placement::plic, Placement::curved};
  for (const test::OwnedField* field : {&blob, &noise}) {
    for (std::int32_t placement = 0; placement <= 5; ++placement) {
      dif_options options = with_all();
      Options expected = cxx_with_all();
      options.placement = placement;
      if (placement > 0) {
        expected.placement = placements[static_cast<std::size_t>(placement - 1)];
      }
      options.normals = 1 + placement % 3;
      expected.normals = static_cast<difmesh::Normals>(placement % 3);
      const std::array<Side, 6> sides{Side::open,     Side::mirror, Side::periodic,
                                      Side::periodic, Side::empty,  Side::full};
      for (std::size_t side = 0; side < 6; ++side) {
        options.boundary[side] = static_cast<std::int32_t>(sides[side]) + 1;
        expected.boundary[side] = sides[side];
      }
      options.threads = 2;
      options.clearance = expected.clearance = 1e-3;
      options.purity_tolerance = expected.purity_tolerance = 1e-4;
      const auto handle = test::c_reconstruct(placed(test::c_field(*field)), &options);
      const auto [mesh, report] = reconstruct(field->view(), kGrid, expected);
      REQUIRE(!mesh.positions.empty());
      CHECK(test::same_bits(test::mesh_of(handle.get()), mesh));

      dif_report facts = test::prepared(dif_report_init);
      REQUIRE(dif_mesh_report(handle.get(), &facts) == DIF_OK);
      CHECK(facts.struct_size == sizeof facts);
      CHECK(facts.cells == report.cells);
      CHECK(facts.interfacial_cells == report.interfacial_cells);
      CHECK(facts.clamped_cells == report.clamped_cells);
      CHECK(facts.fraction_volume == report.fraction_volume);
      CHECK(facts.planes == report.planes);
      CHECK(facts.height_function_cells == report.height_function_cells);
      CHECK(facts.gradient_free_cells == report.gradient_free_cells);
      CHECK(facts.solved_edges == report.solved_edges);
      CHECK(facts.newton_steps_mean == report.newton_steps_mean);
      CHECK(facts.newton_steps_max == report.newton_steps_max);
      CHECK(facts.non_monotone_edges == report.non_monotone_edges);
      CHECK(facts.enclosed_volume == report.enclosed_volume);
      CHECK(facts.closed == (report.closed ? 1 : 0));
      CHECK(facts.seconds_total > 0.0);
    }
  }
}

TEST_CASE("fields of every type and layout need no copy") {
  const test::OwnedField whole = test::white_noise({9, 8, 7}, 11);
  const Mesh expected = difmesh::reconstruct(whole.view(), {.dims = whole.dims}).mesh;
  const auto mesh_of = [](const dif_field& field) {
    return test::mesh_of(test::c_reconstruct(field).get());
  };

  SUBCASE("ghost layers of a Fortran array") {
    const Index3 outer{12, 11, 10};
    std::vector<double> ghosted(12 * 11 * 10, std::nan(""));
    for (std::int64_t k = 0; k < 7; ++k) {
      for (std::int64_t j = 0; j < 8; ++j) {
        for (std::int64_t i = 0; i < 9; ++i) {
          ghosted[static_cast<std::size_t>(((k + 2) * 11 + j + 1) * 12 + i + 2)] =
              whole.values[static_cast<std::size_t>((k * 8 + j) * 9 + i)];
        }
      }
    }
    dif_field field = test::c_field(ghosted.data() + (2 * 11 + 1) * 12 + 2, DIF_FLOAT64, {9, 8, 7});
    field.strides[1] = outer[0];
    field.strides[2] = outer[0] * outer[1];
    CHECK(test::same_bits(mesh_of(field), expected));
  }
  SUBCASE("z fastest and backwards") {
    std::vector<double> turned(whole.values.size());
    for (std::int64_t k = 0; k < 7; ++k) {
      for (std::int64_t j = 0; j < 8; ++j) {
        for (std::int64_t i = 0; i < 9; ++i) {
          turned[static_cast<std::size_t>((i * 8 + j) * 7 + (6 - k))] =
              whole.values[static_cast<std::size_t>((k * 8 + j) * 9 + i)];
        }
      }
    }
    dif_field field = test::c_field(turned.data() + 6, DIF_FLOAT64, {9, 8, 7});
    field.strides[0] = 56;
    field.strides[1] = 7;
    field.strides[2] = -1;
    CHECK(test::same_bits(mesh_of(field), expected));
  }
  SUBCASE("other types") {
    std::vector<float> floats(whole.values.begin(), whole.values.end());
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint16_t> words;
    for (const double value : whole.values) {
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
      words.push_back(static_cast<std::uint16_t>(std::lround(65535 * value)));
    }
    const Grid grid{.dims = whole.dims};
    CHECK(test::same_bits(
        mesh_of(test::c_field(floats.data(), DIF_FLOAT32, whole.dims)),
        difmesh::reconstruct(FieldView::x_fastest(floats.data(), grid.dims), grid).mesh));
    CHECK(test::same_bits(
        mesh_of(test::c_field(bytes.data(), DIF_UINT8, whole.dims)),
        difmesh::reconstruct(FieldView::x_fastest(bytes.data(), grid.dims), grid).mesh));
    CHECK(test::same_bits(
        mesh_of(test::c_field(words.data(), DIF_UINT16, whole.dims)),
        difmesh::reconstruct(FieldView::x_fastest(words.data(), grid.dims), grid).mesh));
  }
}

TEST_CASE("copies of a mesh go where strides say and nowhere else") {
  const dif_options options = with_all();
  const auto handle = test::c_reconstruct(test::c_field(test::blob(kGrid.dims)), &options);
  const Mesh mesh = test::mesh_of(handle.get());
  const auto n = static_cast<std::int64_t>(mesh.positions.size());
  const auto m = static_cast<std::int64_t>(mesh.triangles.size());
  REQUIRE(n > 100);

  std::vector<float> floats(static_cast<std::size_t>(5 * (n - 1) + 3), -7.0F);
  const auto room = static_cast<std::int64_t>(floats.size());
  REQUIRE(dif_mesh_copy_positions(handle.get(), DIF_FLOAT32, 5, room, floats.data()) == DIF_OK);
  std::vector<double> doubles(static_cast<std::size_t>(3 * n));
  REQUIRE(dif_mesh_copy_normals(handle.get(), DIF_FLOAT64, 3, 3 * n, doubles.data()) == DIF_OK);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      REQUIRE(floats[5 * v + axis] == static_cast<float>(mesh.positions[v][axis]));
      REQUIRE(doubles[3 * v + axis] == mesh.normals[v][axis]);
    }
    if (v + 1 < mesh.positions.size()) {
      REQUIRE(floats[5 * v + 3] == -7.0F);
      REQUIRE(floats[5 * v + 4] == -7.0F);
    }
  }

  std::vector<std::int32_t> from_one(static_cast<std::size_t>(4 * m), -1);
  std::vector<std::int64_t> wide(static_cast<std::size_t>(3 * m));
  REQUIRE(dif_mesh_copy_triangles(handle.get(), DIF_INT32, 1, 4, 4 * m, from_one.data()) == DIF_OK);
  REQUIRE(dif_mesh_copy_triangles(handle.get(), DIF_INT64, std::int64_t{1} << 40, 3, 3 * m,
                                  wide.data()) == DIF_OK);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      REQUIRE(from_one[4 * t + c] == static_cast<std::int32_t>(mesh.triangles[t][c]) + 1);
      REQUIRE(wide[3 * t + c] ==
              static_cast<std::int64_t>(mesh.triangles[t][c]) + (std::int64_t{1} << 40));
    }
    REQUIRE(from_one[4 * t + 3] == -1);
  }
  CHECK(dif_mesh_copy_positions(handle.get(), DIF_FLOAT32, 5, room - 1, floats.data()) ==
        DIF_ERROR_INVALID_ARGUMENT);
  CHECK(dif_mesh_copy_triangles(handle.get(), DIF_INT32, 0x7FFFFFFF, 3, 3 * m, from_one.data()) ==
        DIF_ERROR_TOO_LARGE);
}

TEST_CASE("a face twice leaves a mesh without volume") {
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 1, 2, 3};
  dif_mesh* mesh = nullptr;
  REQUIRE(dif_mesh_from_arrays(points, 4, corners, 5, &mesh) == DIF_OK);
  const test::MeshHandle handle(mesh);
  const dif_measure facts = test::measured(mesh);
  CHECK(facts.closed == 0);
  CHECK(facts.has_volume == 0);
  CHECK(facts.unbalanced_edges == 3);
  CHECK(facts.non_manifold_edges == 3);
  CHECK(facts.reserved == 0);
}

TEST_CASE("meshes from arrays are measured as the core does") {
  const Mesh mesh = difmesh::reconstruct(test::blob(kGrid.dims).view(), kGrid).mesh;
  dif_mesh* made = nullptr;
  REQUIRE(dif_mesh_from_arrays(mesh.positions[0].data(),
                               static_cast<std::int64_t>(mesh.positions.size()),
                               mesh.triangles[0].data(),
                               static_cast<std::int64_t>(mesh.triangles.size()), &made) == DIF_OK);
  const test::MeshHandle handle(made);
  CHECK(test::same_bits(test::mesh_of(made), mesh));
  const dif_measure facts = test::measured(made);
  const difmesh::Measure expected = difmesh::measure(mesh);
  CHECK(facts.vertices == expected.vertices);
  CHECK(facts.edges == expected.edges);
  CHECK(facts.triangles == expected.triangles);
  CHECK(facts.components == 1);
  CHECK(facts.euler_number == 2);
  CHECK(facts.boundary_edges == 0);
  CHECK(facts.closed == 1);
  CHECK(facts.manifold == 1);
  CHECK(facts.unbalanced_edges == 0);
  CHECK(facts.has_volume == 1);
  CHECK(facts.area == expected.area);
  CHECK(facts.volume == expected.volume);
  CHECK(std::equal(expected.low.begin(), expected.low.end(), facts.low));
  CHECK(std::equal(expected.high.begin(), expected.high.end(), facts.high));
  dif_report report = test::prepared(dif_report_init);
  CHECK(dif_mesh_report(made, &report) == DIF_ERROR_INVALID_ARGUMENT);

  std::vector<double> normals(3 * mesh.positions.size(), 0.5);
  std::vector<std::uint64_t> ids(mesh.positions.size(), 9);
  REQUIRE(dif_mesh_set_normals(made, normals.data()) == DIF_OK);
  REQUIRE(dif_mesh_set_edge_ids(made, ids.data()) == DIF_OK);
  CHECK(test::mesh_of(made).normals.back() == difmesh::Vec3{0.5, 0.5, 0.5});
  CHECK(test::mesh_of(made).edge_ids.back() == 9);
  REQUIRE(dif_mesh_set_normals(made, nullptr) == DIF_OK);
  CHECK(test::mesh_of(made).normals.empty());
}

TEST_CASE("an empty field gives an empty mesh") {
  const auto handle = test::c_reconstruct(test::c_field(test::OwnedField({3, 3, 3})));
  const double* positions = &kGrid.origin[0];
  std::int64_t count = -1;
  REQUIRE(dif_mesh_positions(handle.get(), &positions, &count) == DIF_OK);
  CHECK(positions == nullptr);
  CHECK(count == 0);
  CHECK(dif_mesh_copy_positions(handle.get(), DIF_FLOAT64, 3, 0, nullptr) == DIF_OK);
}

TEST_CASE("planes alone are the core's and cut off the fractions asked for") {
  const double spacing[3] = {1.0, 0.25, 3.0};
  std::vector<double> normals;
  std::vector<double> fractions;
  for (int n = 0; n < 200; ++n) {
    for (const double component : {std::sin(n), std::cos(3.0 * n), std::sin(7.0 * n + 1)}) {
      normals.push_back(2.5 * component);
    }
    fractions.push_back((n + 0.5) / 200);
  }
  std::vector<double> offsets(200);
  std::vector<double> back(200);
  REQUIRE(dif_plane_offset(spacing, 200, normals.data(), fractions.data(), offsets.data()) ==
          DIF_OK);
  REQUIRE(dif_plane_fraction(spacing, 200, normals.data(), offsets.data(), back.data()) == DIF_OK);
  for (std::size_t n = 0; n < 200; ++n) {
    CHECK(std::abs(back[n] - fractions[n]) < 1e-14);
    CHECK(offsets[n] ==
          difmesh::plane_offset({normals[3 * n], normals[3 * n + 1], normals[3 * n + 2]},
                                {1.0, 0.25, 3.0}, fractions[n]));
  }
}

TEST_CASE("planes of cells and of whole fields are the core's") {
  const test::OwnedField blob = test::blob(kGrid.dims);
  const dif_field field = placed(test::c_field(blob));
  const auto cells = difmesh::interfacial_cells(blob.view(), kGrid);
  std::vector<difmesh::CellPlane> expected(cells.size());
  difmesh::cell_planes(blob.view(), kGrid, cells, {}, expected);

  std::vector<double> normals(3 * cells.size());
  std::vector<double> offsets(cells.size());
  std::vector<std::int32_t> sources(cells.size());
  REQUIRE(dif_cell_planes(&field, nullptr, static_cast<std::int64_t>(cells.size()), cells[0].data(),
                          normals.data(), offsets.data(), sources.data()) == DIF_OK);
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      REQUIRE(normals[3 * n + axis] == expected[n].plane.normal[axis]);
    }
    REQUIRE(offsets[n] == expected[n].plane.offset);
    REQUIRE(sources[n] == static_cast<std::int32_t>(expected[n].source));
  }
  CHECK(dif_cell_planes(&field, nullptr, static_cast<std::int64_t>(cells.size()), cells[0].data(),
                        nullptr, nullptr, nullptr) == DIF_OK);
  CHECK(dif_cell_planes(&field, nullptr, 0, nullptr, nullptr, nullptr, nullptr) == DIF_OK);

  // Into arrays with a ghost layer, as a solver has them.
  const Index3 outer{kGrid.dims[0] + 2, kGrid.dims[1] + 2, kGrid.dims[2] + 2};
  const auto size = static_cast<std::size_t>(outer[0] * outer[1] * outer[2]);
  std::array<std::vector<double>, 4> numbers;
  std::vector<std::int32_t> source(size, -9);
  const std::int64_t first = (outer[1] + 1) * outer[0] + 1;
  dif_plane_arrays arrays = test::prepared(dif_plane_arrays_init);
  std::array<double**, 4> places{&arrays.normal_x, &arrays.normal_y, &arrays.normal_z,
                                 &arrays.offset};
  for (std::size_t n = 0; n < 4; ++n) {
    numbers[n].assign(size, -9.0);
    *places[n] = numbers[n].data() + first;
  }
  arrays.source = source.data() + first;
  arrays.strides[0] = 1;
  arrays.strides[1] = outer[0];
  arrays.strides[2] = outer[0] * outer[1];
  dif_options options = test::prepared(dif_options_init);
  double last = 0.0;
  options.progress_user = &last;
  options.progress = [](void* user, double share) -> std::int32_t {
    double& before = *static_cast<double*>(user);
    const bool is_right = share >= before && share <= 1.0;
    before = share;
    return is_right ? 0 : 1;
  };
  REQUIRE(dif_field_planes(&field, &options, &arrays) == DIF_OK);
  CHECK(last == 1.0);
  std::vector<std::int32_t> seen(size, -9);
  for (std::int64_t k = 0; k < kGrid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < kGrid.dims[1]; ++j) {
      for (std::int64_t i = 0; i < kGrid.dims[0]; ++i) {
        seen[static_cast<std::size_t>(first + (k * outer[1] + j) * outer[0] + i)] = 0;
      }
    }
  }
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const auto at = static_cast<std::size_t>(
        first + (cells[n][2] * outer[1] + cells[n][1]) * outer[0] + cells[n][0]);
    seen[at] = static_cast<std::int32_t>(expected[n].source);
    REQUIRE(numbers[0][at] == expected[n].plane.normal[0]);
    REQUIRE(numbers[1][at] == expected[n].plane.normal[1]);
    REQUIRE(numbers[2][at] == expected[n].plane.normal[2]);
    REQUIRE(numbers[3][at] == expected[n].plane.offset);
  }
  CHECK(source == seen);
  for (std::size_t n = 0; n < size; ++n) {
    REQUIRE(((source[n] == -9) == (numbers[3][n] == -9.0)));
  }
}

TEST_CASE("fractions from a function a shape and a mesh are the core's") {
  const Grid grid{
      .dims = {20, 18, 16}, .origin = {-1.1, -1.0, -0.9}, .spacing = {0.11, 0.12, 0.13}};
  const dif_grid cells = test::c_grid(grid);
  const auto size = static_cast<std::size_t>(grid.cell_count());
  const double radius = 0.7;
  std::vector<double> fractions(size);
  dif_function_report report = test::prepared(dif_function_report_init);
  const dif_function sphere = [](void* user, std::int64_t count, const double* points,
                                 double* values) -> std::int32_t {
    for (std::int64_t n = 0; n < count; ++n) {
      values[n] = std::hypot(points[3 * n], points[3 * n + 1], points[3 * n + 2]) -
                  *static_cast<const double*>(user);
    }
    return 0;
  };
  double r = radius;
  REQUIRE(dif_fractions_from_function(&cells, sphere, &r, nullptr, &report, fractions.data()) ==
          DIF_OK);
  const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  CHECK(report.fraction_volume == doctest::Approx(volume).epsilon(1e-10));
  CHECK(report.function_calls > report.lattice_calls);
  CHECK(report.interfacial_cells > 500);

  dif_shape_options wanted = test::prepared(dif_shape_options_init);
  wanted.radius = radius;
  dif_shape* made = nullptr;
  REQUIRE(dif_shape_create(&wanted, &made) == DIF_OK);
  const test::ShapeHandle shape(made);
  std::vector<double> of_shape(size);
  REQUIRE(dif_fractions_from_shape(&cells, made, nullptr, nullptr, of_shape.data()) == DIF_OK);
  double worst = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    worst = std::max(worst, std::abs(of_shape[n] - fractions[n]));
  }
  CHECK(worst < 1e-9);
  double known = 0.0;
  REQUIRE(dif_shape_volume(made, &known) == DIF_OK);
  CHECK(known == doctest::Approx(volume).epsilon(1e-14));
  double low[3];
  double high[3];
  REQUIRE(dif_shape_bounds(made, low, high) == DIF_OK);
  CHECK(low[2] == -radius);
  CHECK(high[0] == radius);
  const double points[6] = {0, 0, 0, 3, 4, 0};
  double distances[2];
  REQUIRE(dif_shape_distances(made, 2, points, distances) == DIF_OK);
  CHECK(distances[0] == -radius);
  CHECK(distances[1] == doctest::Approx(5 - radius).epsilon(1e-15));

  dif_field field = test::c_field(of_shape.data(), DIF_FLOAT64, grid.dims);
  std::copy(grid.origin.begin(), grid.origin.end(), field.origin);
  std::copy(grid.spacing.begin(), grid.spacing.end(), field.spacing);
  const auto surface = test::c_reconstruct(field);
  std::vector<double> again(size);
  dif_triangle_report facts = test::prepared(dif_triangle_report_init);
  REQUIRE(dif_fractions_from_mesh(&cells, surface.get(), nullptr, &facts, again.data()) == DIF_OK);
  const Mesh mesh = test::mesh_of(surface.get());
  const auto expected = difmesh::fractions_from_mesh(grid, mesh.positions, mesh.triangles);
  CHECK(std::equal(again.begin(), again.end(), expected.fractions.begin()));
  CHECK(facts.mesh_volume == expected.report.mesh_volume);
  CHECK(facts.pieces == expected.report.pieces);
  CHECK(facts.overlap_cells == 0);

  if (dif_has(DIF_PART_DISTANCE) == 1) {
    dif_distance found = test::prepared(dif_distance_init);
    REQUIRE(dif_distance_to_shape(surface.get(), made, nullptr, &found) == DIF_OK);
    CHECK(found.vertices.points == static_cast<std::int64_t>(mesh.positions.size()));
    CHECK(found.has_sign == 1);
    CHECK(found.vertices.rms < 0.02 * 0.12);
    dif_distance by_function = test::prepared(dif_distance_init);
    REQUIRE(dif_distance_to_function(surface.get(), sphere, &r, nullptr, &by_function) == DIF_OK);
    CHECK(by_function.vertices.maximum == doctest::Approx(found.vertices.maximum).epsilon(1e-9));
    dif_distance there = test::prepared(dif_distance_init);
    dif_distance back = test::prepared(dif_distance_init);
    REQUIRE(dif_distance_to_mesh(surface.get(), surface.get(), nullptr, &there, &back) == DIF_OK);
    CHECK(there.facets.maximum < 1e-15);
    CHECK(back.vertices.points == there.vertices.points);
  } else {
    dif_distance found = test::prepared(dif_distance_init);
    CHECK(dif_distance_to_shape(surface.get(), made, nullptr, &found) == DIF_ERROR_UNSUPPORTED);
  }
}

TEST_CASE("blocks welded give the mesh of the whole field") {
  const test::OwnedField noise = test::white_noise({18, 9, 8}, 21);
  dif_options options = with_all();
  const auto whole = test::c_reconstruct(placed(test::c_field(noise)), &options);
  std::vector<test::MeshHandle> parts;
  Grid grid = kGrid;
  grid.dims = noise.dims;
  const dif_grid cells = test::c_grid(grid);
  for (const std::int64_t start : {0, 7}) {
    dif_block block = test::prepared(dif_block_init);
    block.offset[0] = start;
    block.dims[0] = start == 0 ? 7 : 11;
    block.dims[1] = 9;
    block.dims[2] = 8;
    block.ghost_low[0] = start == 0 ? 0 : DIF_GHOST_LAYERS;
    block.ghost_high[0] = start == 0 ? DIF_GHOST_LAYERS : 0;
    dif_field field =
        test::c_field(noise.values.data() + start - block.ghost_low[0], DIF_FLOAT64,
                      {block.dims[0] + block.ghost_low[0] + block.ghost_high[0], 9, 8});
    field.strides[1] = 18;
    field.strides[2] = 18 * 9;
    field.spacing[0] = -1.0;  // origin and spacing are those of the grid
    dif_mesh* mesh = nullptr;
    REQUIRE(dif_reconstruct_block(&field, &block, &cells, &options, &mesh) == DIF_OK);
    parts.emplace_back(mesh);
  }
  const std::array<const dif_mesh*, 2> meshes{parts[0].get(), parts[1].get()};
  dif_mesh* welded = nullptr;
  REQUIRE(dif_mesh_weld(meshes.data(), 2, &cells, &welded) == DIF_OK);
  const test::MeshHandle handle(welded);
  CHECK(test::same_bits(test::mesh_of(welded), test::mesh_of(whole.get())));
}

TEST_CASE("each thread has its own message") {
  dif_mesh* mesh = nullptr;
  CHECK(dif_reconstruct(nullptr, nullptr, &mesh) == DIF_ERROR_INVALID_ARGUMENT);
  const std::string here = dif_last_message();
  CHECK(here == "argument 'field' is NULL");
  std::string elsewhere = "unset";
  std::thread([&] { elsewhere = dif_last_message(); }).join();
  CHECK(elsewhere.empty());
  std::thread([] { static_cast<void>(dif_mesh_report(nullptr, nullptr)); }).join();
  CHECK(dif_last_message() == here);
}

TEST_CASE("an exception of a callback becomes a status") {
  const test::OwnedField blob = test::blob(kGrid.dims);
  const dif_field field = test::c_field(blob);
  dif_options options = test::prepared(dif_options_init);
  options.progress = [](void*, double) -> std::int32_t { throw std::string("of the caller"); };
  dif_mesh* mesh = nullptr;
  CHECK(dif_reconstruct(&field, &options, &mesh) == DIF_ERROR_INTERNAL);
  CHECK(mesh == nullptr);
}

TEST_CASE("reconstructions on eight threads at once do not disturb each other") {
  const test::OwnedField noise = test::white_noise(kGrid.dims, 8);
  const dif_field field = test::c_field(noise);
  dif_options options = with_all();
  const Mesh expected = test::mesh_of(test::c_reconstruct(field, &options).get());
  std::array<int, 8> right{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < right.size(); ++t) {
    threads.emplace_back([&, t] {
      dif_options own = options;
      own.threads = static_cast<std::int32_t>(t % 3);
      for (int turn = 0; turn < 10; ++turn) {
        dif_mesh* mesh = nullptr;
        if (dif_reconstruct(&field, &own, &mesh) == DIF_OK) {
          right[t] += test::same_bits(test::mesh_of(mesh), expected) ? 1 : 0;
        }
        dif_mesh_free(mesh);
        static_cast<void>(dif_reconstruct(nullptr, nullptr, &mesh));
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const int times : right) {
    CHECK(times == 10);
  }
}

TEST_CASE("overlapping parts of a mesh are united or refused or counted") {
  // Two boxes of 2 x 2 x 2 with 1 x 2 x 2 in common.
  std::vector<double> points;
  std::vector<std::uint32_t> faces;
  constexpr std::uint32_t kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                           {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                           {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const std::uint32_t box : {0U, 1U}) {
    for (std::uint32_t v = 0; v < 8; ++v) {
      points.insert(points.end(),
                    {1.25 + box + 2.0 * (v & 1U), 1.5 + (v & 2U), 1.75 + (v & 4U) / 2.0});
    }
    for (const auto& face : kFaces) {
      for (const std::uint32_t v : face) {
        faces.push_back(v + 8 * box);
      }
    }
  }
  dif_mesh* made = nullptr;
  REQUIRE(dif_mesh_from_arrays(points.data(), 16, faces.data(), 24, &made) == DIF_OK);
  const test::MeshHandle mesh(made);
  const dif_grid grid = test::c_grid({.dims = {6, 6, 6}});
  std::vector<double> fractions(216);
  const auto sum = [&] { return std::accumulate(fractions.begin(), fractions.end(), 0.0); };
  dif_triangle_report report = test::prepared(dif_triangle_report_init);
  REQUIRE(dif_fractions_from_mesh(&grid, made, nullptr, &report, fractions.data()) == DIF_OK);
  CHECK(sum() == doctest::Approx(12.0).epsilon(1e-13));
  CHECK(report.overlap_volume == doctest::Approx(4.0).epsilon(1e-13));
  CHECK(report.overlap_cells == 18);
  CHECK(report.largest_overlap == doctest::Approx(0.75).epsilon(1e-13));
  CHECK(report.overlap_cell[0] == 2);
  CHECK(report.overlap_cell[1] == 2);
  CHECK(report.overlap_cell[2] == 2);
  CHECK(report.overlap_low[2] == 1.0);
  CHECK(report.overlap_high[2] == 4.0);
  CHECK(report.inverted_cells == 0);
  CHECK(report.inverted_volume == 0.0);
  CHECK(report.undecided_cells == 0);
  CHECK(report.undecided_volume == 0.0);
  CHECK(report.largest_undecided == 0.0);
  dif_triangle_options options = test::prepared(dif_triangle_options_init);
  options.overlaps = DIF_OVERLAPS_COUNT;
  REQUIRE(dif_fractions_from_mesh(&grid, made, &options, nullptr, fractions.data()) == DIF_OK);
  CHECK(sum() == doctest::Approx(16.0).epsilon(1e-13));
  options.overlaps = DIF_OVERLAPS_REFUSE;
  CHECK(dif_fractions_from_mesh(&grid, made, &options, nullptr, fractions.data()) ==
        DIF_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(dif_last_message()).find("overlap: cell (2, 1, 1)") != std::string::npos);
}

TEST_CASE("stretched axes") {
  const std::vector<double> z{0.0, 1.0, 4.0, 5.0};
  const std::vector<double> fractions{1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0};
  const std::int64_t dims[3] = {2, 2, 3};
  dif_field field{};
  REQUIRE(dif_field_init(&field, sizeof field, fractions.data(), DIF_FLOAT64, dims) == DIF_OK);
  field.faces_z = z.data();
  dif_mesh* mesh = nullptr;
  REQUIRE(dif_reconstruct(&field, nullptr, &mesh) == DIF_OK);
  std::int64_t count = 0;
  const double* positions = nullptr;
  REQUIRE(dif_mesh_positions(mesh, &positions, &count) == DIF_OK);
  REQUIRE(count > 0);
  for (std::int64_t v = 0; v < count; ++v) {
    CHECK(positions[3 * v + 2] == doctest::Approx(2.5).epsilon(1e-11));
  }
  dif_report report{};
  REQUIRE(dif_report_init(&report, sizeof report) == DIF_OK);
  REQUIRE(dif_mesh_report(mesh, &report) == DIF_OK);
  CHECK(report.fraction_volume == doctest::Approx(4.0 * (1.0 + 1.5)).epsilon(1e-15));
  dif_mesh_free(mesh);

  const std::vector<double> bad{0.0, 1.0, 1.0, 5.0};
  field.faces_z = bad.data();
  CHECK(dif_reconstruct(&field, nullptr, &mesh) == DIF_ERROR_INVALID_GRID);
  CHECK(std::string(dif_last_message()) ==
        "faces in z: number 2 is not greater than the one before");
}
