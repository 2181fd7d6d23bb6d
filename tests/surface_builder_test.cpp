#include "difmesh/surface_builder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/out_of_memory.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/blocks.hpp"
#include "support/errors.hpp"
#include "support/fields.hpp"
#include "support/near_pure.hpp"
#include "support/reports.hpp"
#include "support/slabs.hpp"

using namespace difmesh;
using difmesh::test::error_of;
using difmesh::test::OwnedField;

namespace {

// Before every n-th layer.
std::vector<std::int64_t> every(std::int64_t n, std::int64_t layers) {
  std::vector<std::int64_t> cuts;
  for (std::int64_t at = n; at < layers; at += n) {
    cuts.push_back(at);
  }
  return cuts;
}

void check_all_cuts(const OwnedField& field, Options options) {
  const Grid grid{field.dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
  options.edge_ids = true;
  const Reconstruction whole = reconstruct(field.view(), grid, options);
  REQUIRE(whole.mesh.triangles.size() > 100);
  CAPTURE(static_cast<int>(options.boundary[4]));
  CAPTURE(static_cast<int>(options.placement));
  for (const std::int64_t at_once : {1, 2, 3, 8}) {
    for (const std::int64_t thickness : {1, 2, 5, 12, 100}) {
      CAPTURE(at_once);
      CAPTURE(thickness);
      const Reconstruction built = test::in_slabs(field.view(), grid, options, thickness, at_once);
      CHECK(test::same_bits(built.mesh, whole.mesh));
      CHECK(test::difference(built.report, whole.report) == "");
    }
  }
}

Options with_sides(Side x, Side y, Side z_low, Side z_high) {
  Options options;
  options.boundary = {x, x, y, y, z_low, z_high};
  return options;
}

}  // namespace

TEST_CASE("builder: any slabs give the whole to the last bit and its report") {
  const OwnedField fields[] = {test::white_noise({11, 9, 26}, 3), test::blob({21, 19, 33}),
                               test::near_half_noise({7, 8, 24}, 4),
                               test::near_pure_noise({9, 7, 24}, 1e-6, 5)};
  for (const OwnedField& field : fields) {
    for (const Side side : {Side::open, Side::mirror, Side::empty, Side::full}) {
      check_all_cuts(field, with_sides(side, side, side, side));
    }
    check_all_cuts(field, with_sides(Side::periodic, Side::open, Side::full, Side::open));
  }
}

TEST_CASE("builder: every placement and normal with vertex normals") {
  const OwnedField field = test::white_noise({8, 7, 19}, 7);
  for (const Placement placement :
       {Placement::midpoint, Placement::linear, Placement::manson, Placement::plic}) {
    for (const Normals normals : {Normals::youngs, Normals::height_function, Normals::lvira}) {
      Options options;
      options.placement = placement;
      options.normals = normals;
      options.vertex_normals = true;
      check_all_cuts(field, options);
    }
  }
}

TEST_CASE("builder: curved surfaces, whose ghost layers are more") {
  Options options = with_sides(Side::mirror, Side::empty, Side::open, Side::full);
  options.placement = Placement::curved;
  options.vertex_normals = true;
  options.edge_ids = true;
  for (const OwnedField& field : {test::blob({17, 15, 24}), test::near_half_noise({5, 6, 22}, 4)}) {
    const Grid grid{field.dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
    const Reconstruction whole = reconstruct(field.view(), grid, options);
    REQUIRE(whole.mesh.triangles.size() > 100);
    for (const std::int64_t thickness : {1, 7}) {
      const Reconstruction built = test::in_slabs(field.view(), grid, options, thickness, 4);
      CHECK(test::same_bits(built.mesh, whole.mesh));
      CHECK(test::difference(built.report, whole.report) == "");
    }
  }
}

TEST_CASE("builder: random fields in random slabs") {
  std::mt19937_64 random(23);
  const auto below = [&](std::uint64_t count) {
    return static_cast<std::int64_t>(random() % count);
  };
  int with_surface = 0;
  for (std::uint64_t n = 0; n < 400; ++n) {
    Options options;
    options.edge_ids = true;
    options.threads = 1;
    options.purity_tolerance = n % 3 == 0 ? 0.1 : 1e-6;
    options.placement = below(3) > 0 ? Placement::plic : static_cast<Placement>(below(5));
    options.normals = static_cast<Normals>(below(5));
    const Index3 dims{1 + below(5), 1 + below(5), 1 + below(30)};
    for (std::size_t side = 0; side < 6; ++side) {
      options.boundary[side] = static_cast<Side>(below(5));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Side& low = options.boundary[2 * axis];
      Side& high = options.boundary[2 * axis + 1];
      if (low == Side::periodic || high == Side::periodic) {
        low = high = axis == 2 ? Side::open : Side::periodic;
      }
    }
    const OwnedField field = n % 2 == 0 ? test::near_half_noise(dims, n)
                                        : test::near_pure_noise(dims, options.purity_tolerance, n);
    std::vector<std::int64_t> cuts;
    for (std::int64_t at = 1; at < dims[2]; ++at) {
      if (below(3) == 0) {
        cuts.push_back(at);
      }
    }
    BuilderOptions how;
    how.layers_at_once = 1 + below(6);
    const Grid grid{dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
    const Reconstruction whole = reconstruct(field.view(), grid, options);
    with_surface += whole.mesh.triangles.empty() ? 0 : 1;
    const Reconstruction built = test::in_slabs(field.view(), grid, options, cuts, how);
    CAPTURE(n);
    REQUIRE(test::same_bits(built.mesh, whole.mesh));
    REQUIRE(test::difference(built.report, whole.report) == "");
  }
  CHECK(with_surface > 200);
}

TEST_CASE("builder: a part is the block, and with wrapped ghosts the periodic whole") {
  const OwnedField field = test::white_noise({9, 8, 31}, 11);
  const Grid grid{field.dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
  Options options;
  options.edge_ids = true;
  for (const Side side : {Side::open, Side::periodic}) {
    options.boundary.fill(side);
    BuilderOptions how;
    how.layers_at_once = 2;
    const test::BlockData data = test::cut_out(field, {2, 3, 7}, {7, 8, 25}, options);
    how.part = data.block;
    const Reconstruction block = reconstruct_block(data.cells.view(), data.block, grid, options);
    for (const std::int64_t thickness : {1, 4, 15, 100}) {
      const Reconstruction built = test::in_slabs(data.cells.view(), grid, options,
                                                  every(thickness, data.cells.dims[2]), how);
      CHECK(test::same_bits(built.mesh, block.mesh));
      CHECK(test::difference(built.report, block.report) == "");
    }
  }
  // The whole grid, whose first layers come again at the end.
  const Reconstruction whole = reconstruct(field.view(), grid, options);
  CHECK(test::same_bits(test::in_slabs(field.view(), grid, options, 31).mesh, whole.mesh));
  OwnedField wrapped({field.dims[0], field.dims[1], field.dims[2] + 2 * kGhostLayers});
  for (std::int64_t k = 0; k < wrapped.dims[2]; ++k) {
    for (std::int64_t j = 0; j < wrapped.dims[1]; ++j) {
      for (std::int64_t i = 0; i < wrapped.dims[0]; ++i) {
        const std::int64_t from = (k - kGhostLayers + field.dims[2]) % field.dims[2];
        wrapped.at(i, j, k) =
            field.values[static_cast<std::size_t>((from * field.dims[1] + j) * field.dims[0] + i)];
      }
    }
  }
  BuilderOptions how;
  how.part = Block{{0, 0, 0}, field.dims, {0, 0, kGhostLayers}, {0, 0, kGhostLayers}};
  how.layers_at_once = 3;
  for (const std::int64_t thickness : {1, 7, 100}) {
    const Reconstruction built =
        test::in_slabs(wrapped.view(), grid, options, every(thickness, wrapped.dims[2]), how);
    CHECK(test::same_bits(built.mesh, whole.mesh));
    CHECK(test::difference(built.report, whole.report) == "");
  }
}

TEST_CASE("builder: what is final comes early") {
  const OwnedField field = test::white_noise({10, 10, 60}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  BuilderOptions how;
  how.layers_at_once = 4;
  double top = -1.0;
  SurfaceBuilder builder(
      grid, {},
      [&](const MeshPortion& portion) {
        for (const Vec3& position : portion.positions) {
          top = std::max(top, position[2]);
        }
      },
      how);
  for (std::int64_t k = 0; k < 60; ++k) {
    builder.add(field.view().sub({0, 0, k}, {10, 10, 1}));
    CHECK(builder.missing_layers() == 59 - k);
    // All but the last layers, of which some wait for stencils and some for the group.
    CHECK(top > static_cast<double>(k + 1 - kGhostLayers - how.layers_at_once) - 1.0);
  }
  CHECK(builder.finish().cells == 6000);
}

TEST_CASE("builder: a table of faces that counts as uniform changes no bit of the report") {
  for (const std::int64_t layers : {37, 38, 39}) {
    OwnedField field({3, 3, layers});
    field.at(1, 1, 1) = 0.7;
    Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    for (std::int64_t n = 0; n <= layers; ++n) {
      grid.faces[2].push_back(-1.7 + static_cast<double>(n) * 0.1);
    }
    const Options options = with_sides(Side::empty, Side::empty, Side::empty, Side::empty);
    const Reconstruction whole = reconstruct(field.view(), grid, options);
    REQUIRE(whole.report.enclosed_volume > 0.0);
    CHECK(test::difference(test::in_slabs(field.view(), grid, options, 4).report, whole.report) ==
          "");
  }
}

TEST_CASE("builder: layouts and types") {
  const Index3 dims{7, 6, 20};
  const Grid grid{dims, {0.0, 0.0, 0.0}, {1.0, 2.0, 0.5}};
  const OwnedField field = test::white_noise(dims, 9);
  std::vector<std::uint8_t> bytes(field.values.size());
  std::vector<std::uint8_t> z_fastest(field.values.size());
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        const auto n = static_cast<std::size_t>((k * dims[1] + j) * dims[0] + i);
        bytes[n] = static_cast<std::uint8_t>(255.0 * field.values[n]);
        z_fastest[static_cast<std::size_t>((i * dims[1] + j) * dims[2] + k)] = bytes[n];
      }
    }
  }
  const Reconstruction whole =
      reconstruct(FieldView::x_fastest(bytes.data(), dims), grid, Options{});
  const FieldView view = FieldView::z_fastest(z_fastest.data(), dims);
  test::Collector collector;
  BuilderOptions how;
  how.layers_at_once = 1;
  SurfaceBuilder builder(
      grid, {}, [&](const MeshPortion& portion) { collector(portion); }, how);
  for (std::int64_t k = 0; k < dims[2]; k += 2) {
    builder.add(view.sub({0, 0, k}, {dims[0], dims[1], 2}));
  }
  CHECK(test::difference(builder.finish(), whole.report) == "");
  CHECK(test::same_bits(collector.mesh(), whole.mesh));
}

TEST_CASE("builder: a mask is doubted as the whole is") {
  const Index3 dims{5, 5, 24};
  const Grid grid{dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(5 * 5 * 24));
  for (std::size_t n = 0; n < mask.size(); ++n) {
    mask[n] = n % 7 < 3 ? 1 : 0;
  }
  const FieldView view = FieldView::x_fastest(mask.data(), dims);
  const Report whole = reconstruct(view, grid).report;
  REQUIRE(whole.warnings.size() == 1);
  SurfaceBuilder builder(grid, {}, [](const MeshPortion&) {});
  for (std::int64_t k = 0; k < dims[2]; k += 3) {
    builder.add(view.sub({0, 0, k}, {5, 5, 3}));
  }
  CHECK(builder.finish().warnings == whole.warnings);
}

TEST_CASE("builder: progress rises to 1 and cancels") {
  const OwnedField field = test::white_noise({10, 10, 40}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  std::vector<double> shares;
  Options options;
  options.progress = [&](double share) {
    shares.push_back(share);
    return true;
  };
  (void)test::in_slabs(field.view(), grid, options, 3, 5);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.size() > 20);
  CHECK(shares.front() < 0.1);
  CHECK(shares.back() == 1.0);

  options.progress = [&](double share) { return share < 0.5; };
  CHECK(error_of([&] { (void)test::in_slabs(field.view(), grid, options, 3, 5); }) ==
        "cancelled by the progress callback");
}

TEST_CASE("builder: wrong calls are named and end it") {
  const OwnedField field = test::white_noise({6, 5, 20}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const auto ignore = [](const MeshPortion&) {};
  CHECK(error_of([&] { SurfaceBuilder(grid, {}, nullptr); }) == "builder: there is no sink");
  BuilderOptions negative;
  negative.layers_at_once = -1;
  CHECK(error_of([&] { SurfaceBuilder(grid, {}, ignore, negative); }) ==
        "builder: layers_at_once must not be negative, got -1");
  Options wrong;
  wrong.clearance = 0.5;
  CHECK(error_of([&] { SurfaceBuilder(grid, wrong, ignore); }) ==
        "options: clearance must be 1e-13 to 0.25");
  BuilderOptions outside;
  outside.part = Block{{0, 0, 10}, {6, 5, 20}, {0, 0, 0}, {0, 0, 0}};
  CHECK(error_of([&] { SurfaceBuilder(grid, {}, ignore, outside); }) ==
        "block: in z: cells 10 to 10 + 20 are not inside the grid's 20");

  SurfaceBuilder builder(grid, {}, ignore);
  builder.add(field.view().sub({0, 0, 0}, {6, 5, 3}));
  CHECK(error_of([&] {
          builder.add(field.view().sub({0, 0, 3}, {5, 5, 3}));
        }) == "builder: the slab at layer 3 has 5 x 5 cells in x and y, not 6 x 5");
  CHECK(error_of([&] { builder.add(field.view()); }) ==
        "builder: the slab at layer 3 has 20 layers; 1 to 17 are possible");
  const std::vector<float> floats(30, 0.0F);
  CHECK(error_of([&] {
          builder.add(FieldView::x_fastest(floats.data(), {6, 5, 1}));
        }) == "builder: the slab at layer 3 has another element type");
  CHECK(error_of([&] { builder.add(FieldView()); }) == "field: no data");
  CHECK(error_of([&] { (void)builder.finish(); }) == "builder: 17 of 20 layers are missing");
  // None of these did harm.
  builder.add(field.view().sub({0, 0, 3}, {6, 5, 17}));
  CHECK(test::difference(builder.finish(), reconstruct(field.view(), grid).report) == "");

  Options periodic;
  periodic.boundary.fill(Side::periodic);
  SurfaceBuilder wraps(grid, periodic, ignore);
  CHECK(error_of([&] {
          wraps.add(field.view().sub({0, 0, 0}, {6, 5, 3}));
        }) == "builder: periodic in z: give the field in one slab, or a part with ghost layers");

  // A bad cell is the end, and is named by its place in the grid.
  OwnedField bad = field;
  bad.at(4, 2, 13) = 7.0;
  BuilderOptions how;
  how.layers_at_once = 1;
  SurfaceBuilder ended(grid, {}, ignore, how);
  ended.add(bad.view().sub({0, 0, 0}, {6, 5, 12}));
  CHECK(error_of([&] {
          ended.add(bad.view().sub({0, 0, 12}, {6, 5, 8}));
        }) == error_of([&] { (void)reconstruct(bad.view(), grid); }));
  CHECK(error_of([&] { (void)ended.finish(); }) == "builder: an earlier call failed");
  CHECK(error_of([&] { ended.add(bad.view()); }) == "builder: an earlier call failed");
}

TEST_CASE("builder: one that was moved from says so") {
  const OwnedField field = test::white_noise({6, 5, 20}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  SurfaceBuilder first(grid, {}, [](const MeshPortion&) {});
  first.add(field.view().sub({0, 0, 0}, {6, 5, 12}));
  SurfaceBuilder second = std::move(first);
  CHECK(second.missing_layers() == 8);
  CHECK(first.missing_layers() == 0);  // NOLINT(bugprone-use-after-move)
  CHECK(error_of([&] { first.add(field.view()); }) == "builder: it was moved to another one");
  CHECK(error_of([&] { (void)first.finish(); }) == "builder: it was moved to another one");
  second.add(field.view().sub({0, 0, 12}, {6, 5, 8}));
  CHECK(second.finish().cells == 600);
}

TEST_CASE("builder: more cells than memory are refused and not counted beyond 63 bits") {
  constexpr std::int64_t kMany = std::int64_t{1} << 29;
  const Grid grid{{kMany, kMany, 4}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const double one = 1.0;
  BuilderOptions how;
  how.layers_at_once = std::numeric_limits<std::int64_t>::max();
  SurfaceBuilder builder(
      grid, {}, [](const MeshPortion&) {}, how);
  const FieldView slab(&one, ScalarType::float64, {kMany, kMany, 1}, {0, 0, 0});
  CHECK_THROWS_AS(builder.add(slab), OutOfMemory);
}

TEST_CASE("builder: what the sink throws passes through and ends it") {
  const OwnedField field = test::white_noise({6, 5, 40}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  BuilderOptions how;
  how.layers_at_once = 2;
  int calls = 0;
  SurfaceBuilder builder(
      grid, {},
      [&](const MeshPortion&) {
        if (++calls == 2) {
          throw std::runtime_error("the disk is full");
        }
      },
      how);
  builder.add(field.view().sub({0, 0, 0}, {6, 5, 8}));
  CHECK_THROWS_WITH_AS(builder.add(field.view().sub({0, 0, 8}, {6, 5, 9})), "the disk is full",
                       std::runtime_error);
  CHECK(error_of([&] {
          builder.add(field.view().sub({0, 0, 17}, {6, 5, 9}));
        }) == "builder: an earlier call failed");
}

TEST_CASE("builder: a sink that runs out of memory is not taken for the builder") {
  const OwnedField field = test::white_noise({6, 5, 12}, 2);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  SurfaceBuilder builder(grid, {}, [](const MeshPortion&) { throw std::bad_alloc(); });
  bool is_the_builders = false;
  try {
    builder.add(field.view());
    FAIL("nothing was thrown");
  } catch (const OutOfMemory&) {
    is_the_builders = true;
  } catch (const std::bad_alloc&) {
  }
  CHECK_FALSE(is_the_builders);
}

TEST_CASE("builder: fractions below all normal numbers add up as in the whole") {
  const Index3 dims{1, 1, 40};
  const Grid grid{dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 2.3}};
  const OwnedField field(dims, 4.9406564584124654e-324);
  const Report whole = reconstruct(field.view(), grid).report;
  // The sum is rounded once, not each cell's share.
  CHECK(whole.fraction_volume == 40 * 4.9406564584124654e-324 * 2.3);
  for (const std::int64_t thickness : {1, 7}) {
    const Report report = test::in_slabs(field.view(), grid, {}, thickness).report;
    CHECK(report.fraction_volume == whole.fraction_volume);
  }
}
