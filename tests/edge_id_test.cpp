#include "difmesh/edge_id.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>

#include "difmesh/reconstruct.hpp"
#include "support/blocks.hpp"
#include "support/fields.hpp"

namespace {

using difmesh::DualEdgeName;
using difmesh::Index3;
using difmesh::Side;
namespace test = difmesh::test;

}  // namespace

TEST_CASE("edge ids: all edges of a grid have different ones that ascend and come back") {
  const Index3 dims{3, 1, 2};
  std::uint64_t before = 0;
  bool is_first = true;
  for (std::int64_t k = -1; k <= dims[2]; ++k) {
    for (std::int64_t j = -1; j <= dims[1]; ++j) {
      for (std::int64_t i = -1; i <= dims[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          const DualEdgeName edge{{i, j, k}, axis};
          const std::uint64_t id = difmesh::edge_id(dims, edge);
          CHECK((is_first || id == before + 1));
          CHECK(id < difmesh::edge_id_end(dims));
          CHECK((difmesh::edge_of(dims, id) == edge));
          before = id;
          is_first = false;
        }
      }
    }
  }
  CHECK(before + 1 == difmesh::edge_id_end(dims));
}

TEST_CASE("edge ids: the largest grids have room in 64 bits") {
  // validate() takes 2^20 nodes each way, and 2^31 - 3 cells along one axis.
  for (const Index3& dims : {Index3{(1 << 20) - 2, (1 << 20) - 2, (1 << 20) - 2},
                             Index3{2147483645, 1, 1}, Index3{1, 1, 2147483645}}) {
    const DualEdgeName last{{dims[0], dims[1], dims[2]}, 2};
    CHECK((difmesh::edge_of(dims, difmesh::edge_id(dims, last)) == last));
    CHECK(difmesh::edge_id(dims, last) + 1 == difmesh::edge_id_end(dims));
    CHECK(difmesh::edge_id_end(dims) < std::uint64_t{1} << 63);
  }
}

TEST_CASE("edge ids: each vertex of blocks is owned by one of those that have it") {
  const test::OwnedField field = test::white_noise({7, 6, 5}, 21);
  const difmesh::Grid grid{.dims = field.dims};
  for (const Side side : {Side::open, Side::mirror, Side::empty, Side::periodic}) {
    difmesh::Options options;
    options.boundary.fill(side);
    options.edge_ids = true;
    const auto whole = difmesh::reconstruct(field.view(), grid, options).mesh;
    std::map<std::uint64_t, int> owners;
    for (const test::BlockData& data : test::cut_up(field, {{{2, 3}, {4}, {1}}}, options)) {
      const auto part =
          difmesh::reconstruct_block(data.cells.view(), data.block, grid, options).mesh;
      for (const std::uint64_t id : part.edge_ids) {
        owners[id] +=
            difmesh::owns(data.block, field.dims, difmesh::edge_of(field.dims, id)) ? 1 : 0;
      }
    }
    CHECK(owners.size() == whole.edge_ids.size());
    for (const std::uint64_t id : whole.edge_ids) {
      REQUIRE(owners[id] == 1);
    }
  }
}
