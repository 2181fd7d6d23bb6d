// The adapters for users of libdifmesh alone: the C++ core is not linked here.

#include "difmesh/adapters/c_mesh.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstring>
#include <memory>
#include <vector>

#include "adapters/openmesh_meshes.hpp"
#include "difmesh/adapters/cgal.hpp"
#include "difmesh/adapters/openmesh.hpp"
#include "support/fields.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

struct Free {
  void operator()(dif_mesh* mesh) const { dif_mesh_free(mesh); }
};
using Owned = std::unique_ptr<dif_mesh, Free>;
using SurfaceMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

Owned surface_of(const OwnedField& cells) {
  dif_field field;
  dif_options options;
  dif_mesh* mesh = nullptr;
  REQUIRE(dif_field_init(&field, sizeof field, cells.values.data(), DIF_FLOAT64,
                         cells.dims.data()) == DIF_OK);
  REQUIRE(dif_options_init(&options, sizeof options) == DIF_OK);
  options.vertex_normals = 1;
  options.edge_ids = 1;
  for (std::int32_t& side : options.boundary) {
    side = DIF_SIDE_EMPTY;
  }
  REQUIRE(dif_reconstruct(&field, &options, &mesh) == DIF_OK);
  return Owned(mesh);
}

std::vector<double> fractions_of(const dif_mesh* mesh, const Index3& dims) {
  dif_grid grid;
  REQUIRE(dif_grid_init(&grid, sizeof grid, dims.data()) == DIF_OK);
  std::vector<double> fractions(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
  REQUIRE(dif_fractions_from_mesh(&grid, mesh, nullptr, nullptr, fractions.data()) == DIF_OK);
  return fractions;
}

/// All that a view shows, compared bit for bit.
bool same(const MeshView& a, const MeshView& b) {
  const auto vertices = static_cast<std::size_t>(a.vertices);
  return a.vertices == b.vertices && a.triangles == b.triangles &&
         std::memcmp(a.positions, b.positions, 24 * vertices) == 0 &&
         std::memcmp(a.normals, b.normals, 24 * vertices) == 0 &&
         std::memcmp(a.edge_ids, b.edge_ids, 8 * vertices) == 0 &&
         std::memcmp(a.indices, b.indices, 12 * static_cast<std::size_t>(a.triangles)) == 0 &&
         a.scalars.size() == 1 && b.scalars.size() == 1 && a.scalars[0].name == b.scalars[0].name &&
         std::memcmp(a.scalars[0].values.data(), b.scalars[0].values.data(), 8 * vertices) == 0;
}

}  // namespace

TEST_CASE("c mesh: to OpenMesh and CGAL and back to fractions") {
  for (const OwnedField& cells : {blob({14, 13, 12}), white_noise({9, 10, 11}, 3)}) {
    const Owned mesh = surface_of(cells);
    // Any numbers will do: of three times as many coordinates, the first.
    REQUIRE(dif_mesh_set_scalars(mesh.get(), "height", view_of(mesh.get()).positions) == DIF_OK);
    const auto opened = to_openmesh<DoubleTriangles>(view_of(mesh.get()));
    const auto surface = to_cgal<SurfaceMesh>(view_of(mesh.get()));
    CHECK(opened.report.refused.empty());
    CHECK(surface.report.refused.empty());
    CHECK(judged_by_openmesh(opened.mesh).empty());
    CHECK(surface.mesh.is_valid(false));
    const std::vector<double> fractions = fractions_of(mesh.get(), cells.dims);
    for (const Mesh& back : {mesh_from_openmesh(opened.mesh), mesh_from_cgal(surface.mesh)}) {
      const Owned again(to_dif_mesh(back));
      CHECK(same(view_of(mesh.get()), MeshView(back)));
      CHECK(same(view_of(mesh.get()), view_of(again.get())));
      CHECK((fractions_of(again.get(), cells.dims) == fractions));
    }
  }
}

TEST_CASE("c mesh: an empty one and none at all") {
  const Owned empty = surface_of(OwnedField({5, 5, 5}));
  const auto opened = to_openmesh<DoubleTriangles>(view_of(empty.get()));
  CHECK(opened.mesh.n_vertices() == 0);
  CHECK(opened.report.faces == 0);
  CHECK(to_cgal<SurfaceMesh>(view_of(empty.get())).mesh.is_empty());
  const dif_mesh* none = nullptr;
  CHECK_THROWS_AS((void)view_of(none), Error);
  Mesh bad;
  bad.positions.resize(3, {0.0, 0.0, 0.0});
  bad.triangles.push_back({0, 1, 3});
  CHECK_THROWS_AS((void)to_dif_mesh(bad), Error);
}
