#include "difmesh/weld.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "placement/placement.hpp"
#include "support/blocks.hpp"
#include "support/errors.hpp"
#include "support/fields.hpp"
#include "support/near_pure.hpp"
#include "support/reports.hpp"

using namespace difmesh;
using difmesh::test::OwnedField;

namespace {

void check_blocks(const OwnedField& field, const Index3& cut, Options options) {
  const Grid grid{field.dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
  options.edge_ids = true;
  options.vertex_normals = true;
  const Reconstruction whole = reconstruct(field.view(), grid, options);
  REQUIRE(whole.mesh.triangles.size() > 100);
  CAPTURE(static_cast<int>(options.boundary[0]));
  CAPTURE(static_cast<int>(options.placement));
  CAPTURE(cut[0]);
  const Reconstruction joined = test::in_blocks(field, grid, cut, options);
  CHECK(test::same_bits(joined.mesh, whole.mesh));
  CHECK(test::difference(joined.report, whole.report, 1e-12) == "");
}

std::string weld_error(const std::vector<Mesh>& meshes, const Grid& grid) {
  return test::error_of([&] { (void)weld(meshes, grid); });
}

}  // namespace

TEST_CASE("weld: eight uneven blocks are the whole field to the last bit") {
  const OwnedField fields[] = {test::blob({31, 27, 22}), test::white_noise({17, 15, 13}, 1),
                               test::half_noise({17, 15, 13}, 2)};
  for (const OwnedField& field : fields) {
    for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
      Options options;
      options.boundary.fill(side);
      check_blocks(field, {7, 9, 6}, options);
    }
    Options mixed;
    mixed.boundary = {Side::open,     Side::empty, Side::periodic,
                      Side::periodic, Side::full,  Side::mirror};
    check_blocks(field, {6, 5, 8}, mixed);
  }
}

TEST_CASE("weld: blocks of curved surfaces are the whole field to the last bit") {
  for (const OwnedField& field : {test::blob({25, 22, 20}), test::white_noise({10, 9, 8}, 1)}) {
    for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty}) {
      Options options;
      options.placement = Placement::curved;
      options.boundary.fill(side);
      check_blocks(field, {13, 22, 9}, options);
    }
  }
}

TEST_CASE("weld: blocks thinner than their ghosts and cuts along one axis only") {
  const OwnedField field = test::white_noise({9, 8, 7}, 5);
  for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty}) {
    Options options;
    options.boundary.fill(side);
    options.placement = side == Side::mirror ? Placement::curved : Placement::plic;
    check_blocks(field, {1, 2, 6}, options);
    check_blocks(field, {9, 8, 3}, options);
    check_blocks(field, {4, 8, 7}, options);
  }
}

TEST_CASE("weld: every placement and normal") {
  const OwnedField field = test::white_noise({13, 12, 11}, 7);
  for (const Placement placement :
       {Placement::midpoint, Placement::linear, Placement::manson, Placement::plic}) {
    for (const Normals normals : {Normals::youngs, Normals::myc, Normals::height_function,
                                  Normals::elvira, Normals::lvira}) {
      Options options;
      options.placement = placement;
      options.normals = normals;
      check_blocks(field, {6, 5, 4}, options);
    }
  }
}

TEST_CASE("weld: blocks depend on as many ghost layers as the placement and the normals reach") {
  std::mt19937_64 random(23);
  const OwnedField noise = test::white_noise({15, 14, 13}, 8);
  const OwnedField blob = test::blob({30, 28, 26});
  // The field in blocks whose cells beyond some ghost layers are those of another field.
  const auto in_blocks_of = [&](const OwnedField& field, std::int64_t layers,
                                const Options& options) {
    const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    std::vector<Mesh> meshes;
    for (test::BlockData& data :
         test::cut_up(field, {{{field.dims[0] / 2}, {field.dims[1] / 3}, {7}}}, options)) {
      const Block& block = data.block;
      for (std::size_t n = 0; n < data.cells.values.size(); ++n) {
        const auto number = static_cast<std::int64_t>(n);
        const Index3& dims = data.cells.dims;
        const Index3 cell{number % dims[0], number / dims[0] % dims[1], number / dims[0] / dims[1]};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::int64_t from = block.ghost_low[axis] - layers;
          const std::int64_t to = block.ghost_low[axis] + block.dims[axis] + layers;
          if (cell[axis] < from || cell[axis] >= to) {
            data.cells.values[n] = static_cast<double>(random() % 1000) * 1e-3;
          }
        }
      }
      meshes.push_back(reconstruct_block(data.cells.view(), block, grid, options).mesh);
    }
    return weld(meshes, grid);
  };
  std::int64_t most = 0;
  for (const Placement placement : {Placement::midpoint, Placement::linear, Placement::manson,
                                    Placement::plic, Placement::curved}) {
    for (const Normals normals : {Normals::youngs, Normals::myc, Normals::height_function,
                                  Normals::elvira, Normals::lvira}) {
      for (const bool vertex_normals : {false, true}) {
        if (placement == Placement::curved && (normals != Normals::myc || !vertex_normals)) {
          continue;  // slow, and by surfaces it reads as far whatever the normals
        }
        CAPTURE(static_cast<int>(placement));
        CAPTURE(static_cast<int>(normals));
        CAPTURE(vertex_normals);
        Options options;
        options.placement = placement;
        options.normals = normals;
        options.vertex_normals = vertex_normals;
        options.edge_ids = true;
        options.boundary = {Side::periodic, Side::periodic, Side::open,
                            Side::mirror,   Side::open,     Side::full};
        const std::int64_t layers = detail::layers_read(options);
        REQUIRE(layers >= 1);
        most = std::max(most, layers);
        bool would_fewer_do = true;
        for (const OwnedField* const field : {&noise, &blob}) {
          const Grid grid{field->dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
          const Mesh whole = reconstruct(field->view(), grid, options).mesh;
          CHECK(test::same_bits(in_blocks_of(*field, layers, options), whole));
          try {
            would_fewer_do =
                would_fewer_do && test::same_bits(in_blocks_of(*field, layers - 1, options), whole);
          } catch (const Error&) {  // the blocks do not fit together
            would_fewer_do = false;
          }
        }
        // The last layer of curved matters only to a surface next to a kink next to a centre.
        CHECK((!would_fewer_do || placement == Placement::curved));
      }
    }
  }
  CHECK(most == kCurvedGhostLayers);
}

TEST_CASE("weld: cells as good as pure have the same plane for every block that asks") {
  // The cell (0, 1, 1) is one, and its only crossed edge leaves the upper block at its low side.
  OwnedField field({1, 3, 2});
  field.values = {1e-6, 0.5, 1e-6, 0.499999999999999, 1e-6, 0.499999999999999};
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.edge_ids = true;
  options.vertex_normals = true;
  for (const double tolerance : {1e-6, 0.1}) {
    options.purity_tolerance = tolerance;
    const Reconstruction whole = reconstruct(field.view(), grid, options);
    REQUIRE(whole.mesh.triangles.size() >= 8);
    const Reconstruction joined = test::in_blocks(field, grid, {1, 3, 1}, options);
    CHECK(test::same_bits(joined.mesh, whole.mesh));
    CHECK(test::difference(joined.report, whole.report, 1e-12) == "");
  }
}

TEST_CASE("weld: the whole to the last bit of fields that are nearly pure however they are cut") {
  std::mt19937_64 random(17);
  const auto below = [&](std::uint64_t count) {
    return static_cast<std::int64_t>(random() % count);
  };
  constexpr double kTolerances[] = {0.0, 1e-6, 0.01, 0.1};
  int with_surface = 0;
  for (std::uint64_t n = 0; n < 1200; ++n) {
    Options options;
    options.edge_ids = true;
    options.vertex_normals = true;
    options.threads = 1;
    options.purity_tolerance = kTolerances[below(4)];
    options.placement = below(3) > 0 ? Placement::plic : static_cast<Placement>(below(4));
    options.normals = static_cast<Normals>(below(5));
    OwnedField field({0, 0, 0});
    test::Cuts cuts;
    Index3 dims{};
    for (std::size_t a = 0; a < 3; ++a) {
      dims[a] = 1 + below(n % 4 == 0 ? 8 : 4);
      for (std::int64_t at = 1; at < dims[a]; ++at) {
        if (below(2) == 0) {
          cuts[a].push_back(at);
        }
      }
      const bool is_open = below(2) == 0;
      for (std::size_t high = 0; high < 2; ++high) {
        options.boundary[2 * a + high] = is_open ? Side::open : static_cast<Side>(below(5));
      }
      Side& low_side = options.boundary[2 * a];
      Side& high_side = options.boundary[2 * a + 1];
      if ((low_side == Side::periodic) != (high_side == Side::periodic)) {
        low_side = high_side = Side::periodic;
      }
    }
    field = n % 3 == 0 ? test::near_half_noise(dims, n)
                       : test::near_pure_noise(dims, options.purity_tolerance, n);
    const Grid grid{dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
    const Reconstruction whole = reconstruct(field.view(), grid, options);
    with_surface += whole.mesh.triangles.empty() ? 0 : 1;
    CAPTURE(n);
    const Reconstruction joined = test::in_cut_blocks(field, grid, cuts, options);
    REQUIRE(test::same_bits(joined.mesh, whole.mesh));
    REQUIRE(test::difference(joined.report, whole.report, 1e-10) == "");
  }
  CHECK(with_surface > 1000);
}

TEST_CASE("weld: scalars come along where all meshes have them") {
  const OwnedField field = test::white_noise({8, 7, 12}, 3);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  std::vector<Mesh> meshes;
  for (const test::BlockData& data : test::cut_up(field, {{{}, {}, {4, 9}}}, {})) {
    Mesh mesh = reconstruct_block(data.cells.view(), data.block, grid).mesh;
    // Numbers that follow from the vertex, so that those of different blocks agree.
    mesh.scalars = {{"height", {}}, {"id", {}}};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.scalars[0].values.push_back(mesh.positions[v][2]);
      mesh.scalars[1].values.push_back(static_cast<double>(mesh.edge_ids[v]));
    }
    meshes.push_back(std::move(mesh));
  }
  // Names count, not places.
  std::swap(meshes[1].scalars[0], meshes[1].scalars[1]);
  const Mesh whole = weld(meshes, grid);
  REQUIRE(whole.scalars.size() == 2);
  CHECK(whole.scalars[0].name == "height");
  CHECK(whole.scalars[1].name == "id");
  for (const VertexScalar& scalar : whole.scalars) {
    REQUIRE(scalar.values.size() == whole.positions.size());
  }
  for (std::size_t v = 0; v < whole.positions.size(); ++v) {
    CHECK(whole.scalars[0].values[v] == whole.positions[v][2]);
    CHECK(whole.scalars[1].values[v] == static_cast<double>(whole.edge_ids[v]));
  }
  meshes[2].scalars.pop_back();
  CHECK(weld_error(meshes, grid) == "weld: mesh 2 differs from mesh 0 in its scalars");
  meshes[2].scalars.push_back({"Id", meshes[2].scalars[0].values});
  CHECK(weld_error(meshes, grid) == "weld: mesh 2 has no scalar 'id', which mesh 0 has");
  meshes[2].scalars[1].name = "id";
  meshes[2].scalars[1].values.pop_back();
  CHECK(weld_error(meshes, grid) == "weld: mesh 2 has 'id' for some vertices only");
  meshes[0].scalars[0].name = "id";
  CHECK(weld_error(meshes, grid) == "weld: mesh 0 has two scalars 'id'");
}

TEST_CASE("weld: missing ghosts are named") {
  const OwnedField field = test::white_noise({20, 8, 8}, 3);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const Block block{{4, 0, 0}, {10, 8, 8}, {4, 0, 0}, {3, 0, 0}};
  std::string message;
  try {
    (void)reconstruct_block(field.view().sub({0, 0, 0}, {17, 8, 8}), block, grid);
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message == "block: in x: 4 and 3 ghost layers are given; 4 and 5 are needed");
}

TEST_CASE("weld: ghosts beyond 64 bits are named") {
  const double one = 1.0;
  const Grid grid{{20, 8, 8}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.boundary[0] = options.boundary[1] = Side::periodic;
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t ghosts : {kMost, kMost - 5, kMost - 30, (std::int64_t{1} << 60) + 1}) {
    const Block block{{0, 0, 0}, {20, 8, 8}, {5, 0, 0}, {ghosts, 0, 0}};
    const FieldView view(&one, ScalarType::float64, {25 + (ghosts >> 1), 8, 8}, {0, 0, 0});
    CHECK(test::error_of([&] { (void)reconstruct_block(view, block, grid, options); }) ==
          "block: in x: more than 2^60 ghost layers");
  }
}

TEST_CASE("weld: bad meshes are named") {
  const OwnedField field = test::white_noise({6, 6, 6}, 3);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  Options options;
  options.edge_ids = true;
  const Mesh good = reconstruct(field.view(), grid, options).mesh;
  CHECK(weld_error({good}, grid).empty());
  CHECK(weld({}, grid).positions.empty());

  Mesh bad = good;
  bad.edge_ids.clear();
  CHECK(weld_error({good, bad}, grid) == "weld: mesh 1 has no edge_ids");
  bad = good;
  bad.edge_ids.back() = 3 * 8 * 8 * 8;
  CHECK(weld_error({bad}, grid) == "weld: mesh 0 has an edge id outside the grid: 1536");
  bad = good;
  bad.triangles[5][1] = static_cast<std::uint32_t>(bad.positions.size());
  CHECK(weld_error({good, bad}, grid) == "weld: mesh 1 has a triangle with an index out of range");
  bad = good;
  bad.normals.resize(bad.positions.size());
  CHECK(weld_error({good, bad}, grid) ==
        "weld: mesh 1 differs from mesh 0 in having normals or not");
}

TEST_CASE("weld: blocks that overlap are named") {
  const OwnedField field = test::white_noise({8, 7, 20}, 4);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const auto block = [&](std::int64_t from, std::int64_t to) {
    const std::int64_t low = std::min<std::int64_t>(from, kGhostLayers);
    const std::int64_t high = std::min<std::int64_t>(20 - to, kGhostLayers);
    const FieldView cells = field.view().sub({0, 0, from - low}, {8, 7, to - from + low + high});
    return reconstruct_block(cells, {{0, 0, from}, {8, 7, to - from}, {0, 0, low}, {0, 0, high}},
                             grid)
        .mesh;
  };
  const Mesh low = block(0, 9);
  const Mesh high = block(9, 20);
  CHECK(weld_error({low, high}, grid).empty());
  CHECK(weld_error({high, low}, grid).empty());
  CHECK(weld_error({low}, grid).empty());
  CHECK(weld_error({low, Mesh{}, high, Mesh{}}, grid).empty());
  CHECK(weld_error({low, low}, grid) ==
        "weld: mesh 1 has triangles between the same cells as mesh 0, those from (-1, -1, -1) on; "
        "blocks must be disjoint");
  CHECK(weld_error({low, high, low}, grid).starts_with("weld: mesh 2 has triangles"));
  // One layer of cells in common: its dual cells begin at its cells.
  const std::string message = weld_error({block(8, 20), low}, grid);
  CHECK(message.starts_with("weld: mesh 1 has triangles between the same cells as mesh 0"));
  CHECK(message.ends_with(", 8) on; blocks must be disjoint"));
}
