#include "difmesh/weld.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/blocks.hpp"
#include "support/fields.hpp"

using namespace difmesh;
using difmesh::test::OwnedField;

namespace {

void check_blocks(const OwnedField& field, const Index3& cut, Options options) {
  const Grid grid{field.dims, {0.1, -0.7, 3.3}, {0.3, 0.1, 0.7}};
  options.edge_ids = true;
  options.vertex_normals = true;
  const Mesh whole = reconstruct(field.view(), grid, options).mesh;
  REQUIRE(whole.triangles.size() > 100);
  CAPTURE(static_cast<int>(options.sides[0]));
  CAPTURE(static_cast<int>(options.placement));
  CAPTURE(cut[0]);
  CHECK(test::same_bits(test::in_blocks(field, grid, cut, options), whole));
}

std::string weld_error(const std::vector<Mesh>& meshes, const Grid& grid) {
  try {
    (void)weld(meshes, grid);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("weld: eight uneven blocks are the whole field to the last bit") {
  const OwnedField fields[] = {test::blob({31, 27, 22}), test::white_noise({17, 15, 13}, 1),
                               test::half_noise({17, 15, 13}, 2)};
  for (const OwnedField& field : fields) {
    for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
      Options options;
      options.sides.fill(side);
      check_blocks(field, {7, 9, 6}, options);
    }
    Options mixed;
    mixed.sides = {Side::open,     Side::empty, Side::periodic,
                   Side::periodic, Side::full,  Side::mirror};
    check_blocks(field, {6, 5, 8}, mixed);
  }
}

TEST_CASE("weld: blocks thinner than their ghosts and cuts along one axis only") {
  const OwnedField field = test::white_noise({9, 8, 7}, 5);
  for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty}) {
    Options options;
    options.sides.fill(side);
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
