// Which vertices triangles join, on fields of few cells.

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"

using namespace difmesh;
using difmesh::test::OwnedField;

namespace {

Reconstruction of(const OwnedField& field, Placement placement, Side side) {
  Options options;
  options.placement = placement;
  options.boundary.fill(side);
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  return reconstruct(field.view(), grid, options);
}

}  // namespace

TEST_CASE("connectivity: rows are joined across words of nodes as they are within them") {
  // All ways for the corners of a cube to be inside, in the middle of what is all empty or full.
  // Node n is cell n - 1: the first word of nodes ends with cell 62.
  for (const bool full : {false, true}) {
    for (unsigned corners = 0; corners < 256; ++corners) {
      const auto mesh_at = [&](std::int64_t x) {
        OwnedField field({70, 4, 4}, full ? 1.0 : 0.0);
        for (unsigned c = 0; c < 8; ++c) {
          field.at(x + (c & 1U), 1 + (c >> 1U & 1U), 1 + (c >> 2U)) =
              (corners >> c & 1U) != 0 ? 1.0 : 0.0;
        }
        return of(field, Placement::midpoint, full ? Side::full : Side::empty).mesh;
      };
      const Mesh across = mesh_at(62);
      const Mesh within = mesh_at(20);
      CAPTURE(full);
      CAPTURE(corners);
      REQUIRE(across.positions.size() == within.positions.size());
      for (std::size_t n = 0; n < across.positions.size(); ++n) {
        CHECK(across.positions[n][0] - 42.0 == within.positions[n][0]);
        CHECK(across.positions[n][1] == within.positions[n][1]);
        CHECK(across.positions[n][2] == within.positions[n][2]);
      }
      CHECK(test::same_bytes(across.triangles, within.triangles));
    }
  }
}

TEST_CASE(
    "connectivity: cells that touch along an edge are joined where the mean there is a half") {
  struct Pair {
    double inside;
    double outside;
    std::int64_t bodies;
  };
  for (const Pair& pair : {Pair{0.9, 0.2, 1}, Pair{0.75, 0.25, 1}, Pair{0.7, 0.2, 2},
                           Pair{0.999, 0.0, 2}, Pair{0.5, 0.499, 2}, Pair{0.6, 0.401, 1}}) {
    for (std::int64_t axis = 0; axis < 3; ++axis) {
      OwnedField field({5, 6, 7});
      for (std::int64_t n = 0; n < 4; ++n) {
        Index3 cell{2, 2, 2};
        cell[static_cast<std::size_t>(axis + 1) % 3] += n % 2;
        cell[static_cast<std::size_t>(axis + 2) % 3] += n / 2;
        field.at(cell[0], cell[1], cell[2]) = n == 0 || n == 3 ? pair.inside : pair.outside;
      }
      const Reconstruction result = of(field, Placement::linear, Side::empty);
      CHECK(result.report.cells == 5 * 6 * 7);
      CHECK(result.report.closed);
      // Euler's number of a closed surface of bodies without holes is twice their number.
      CAPTURE(pair.inside);
      CAPTURE(axis);
      CHECK(2 * static_cast<std::int64_t>(result.mesh.positions.size()) -
                static_cast<std::int64_t>(result.mesh.triangles.size()) ==
            4 * pair.bodies);
    }
  }
}
