// Surfaces in other graphs of CGAL: Polyhedron_3 (GPL: for tests only), and OpenMesh's meshes
// behind CGAL's functions. With CGAL_USE_OM_POINTS, else CGAL itself rounds OpenMesh's points to
// float.

#define CGAL_USE_OM_POINTS
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <type_traits>

#include "adapters/graphs.hpp"
#include "adapters/openmesh_meshes.hpp"
#include "adapters/surfaces.hpp"
#include "difmesh/adapters/cgal.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/measure.hpp"
#include "support/fields.hpp"
#include "support/mesh_field.hpp"

using namespace difmesh;
using namespace difmesh::test;

namespace {

using Polyhedron = CGAL::Polyhedron_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
using FloatPolyhedron = CGAL::Polyhedron_3<CGAL::Simple_cartesian<float>>;

// Sanitizers make units with CGAL the dearest to compile: two kinds are enough for them.
#ifdef DIFMESH_SANITIZED
#define DIFMESH_GRAPHS Polyhedron, DoubleTriangles
#else
#define DIFMESH_GRAPHS Polyhedron, FloatPolyhedron, DoubleTriangles, FloatPolygons
#endif

template <class Graph>
constexpr bool kIsOpenMesh =
    std::is_same_v<Graph, DoubleTriangles> || std::is_same_v<Graph, FloatPolygons>;

template <class Graph>
constexpr bool kHoldsDoubles =
    std::is_same_v<Graph, Polyhedron> || std::is_same_v<Graph, DoubleTriangles>;

}  // namespace

TYPE_TO_STRING(Polyhedron);
TYPE_TO_STRING(FloatPolyhedron);
TYPE_TO_STRING(DoubleTriangles);
TYPE_TO_STRING(FloatPolygons);

TEST_CASE_TEMPLATE("graphs: surfaces arrive as CGAL would build them and come back", Graph,
                   DIFMESH_GRAPHS) {
  for (const Surface& surface : all_surfaces()) {
    CAPTURE(surface.name);
    const Mesh& mesh = surface.mesh;
    const auto [other, report] = to_cgal<Graph>(mesh);
    CHECK(report.refused.empty());
    CHECK(report.edges == measure(mesh).edges);
    REQUIRE(num_vertices(other) == mesh.positions.size());
    REQUIRE(num_faces(other) == mesh.triangles.size());
    CHECK(judged_by_cgal(other).empty());
    if constexpr (kIsOpenMesh<Graph>) {
      CHECK(same_halfedges(other, built_by_openmesh<Graph>(mesh)));
      CHECK(judged_by_openmesh(other).empty());
    } else {
      CHECK((structure(other) == structure(built_by_cgal<Graph>(mesh))));
    }
    const Mesh back = mesh_from_cgal(other);
    CHECK(same_bytes(back.triangles, mesh.triangles));
    REQUIRE(back.positions.size() == mesh.positions.size());
    bool equal = true;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      for (std::size_t a = 0; a < 3; ++a) {
        const double x = mesh.positions[v][a];
        equal =
            equal && back.positions[v][a] ==
                         (kHoldsDoubles<Graph> ? x : static_cast<double>(static_cast<float>(x)));
      }
    }
    CHECK(equal);
  }
}

TEST_CASE_TEMPLATE("graphs: appended meshes and broken soups", Graph, Polyhedron, DoubleTriangles) {
  const Mesh first = open_noise();
  auto other = to_cgal<Graph>(first).mesh;
  append_to_cgal(other, first);
  CHECK(num_faces(other) == 2 * first.triangles.size());
  CHECK(judged_by_cgal(other).empty());
  for (const BrokenSoup& soup : broken_soups()) {
    CAPTURE(soup.name);
    const auto [part, report] = to_cgal<Graph>(soup.mesh);
    REQUIRE(report.refused.size() == soup.refused.size());
    CHECK(num_faces(part) == soup.mesh.triangles.size() - soup.refused.size());
    const Mesh kept = without(soup.mesh, soup.refused);
    CHECK(same_bytes(mesh_from_cgal(part).triangles, kept.triangles));
  }
}

TEST_CASE("graphs: polygons come back as fans of the same fractions") {
  const PolygonMesh prism = prism_with_concave_caps();
  Polyhedron other;
  std::vector<Polyhedron::Vertex_handle> all;
  for (const Vec3& p : prism.positions) {
    all.push_back(add_vertex(other));
    all.back()->point() = Polyhedron::Point_3(p[0], p[1], p[2]);
  }
  for (const auto& polygon : prism.faces) {
    std::vector<Polyhedron::Vertex_handle> corners;
    for (const std::uint32_t v : polygon) {
      corners.push_back(all[v]);
    }
    CGAL::Euler::add_face(corners, other);
  }
  const Mesh back = mesh_from_cgal(other);
  CHECK(measure(back).volume == doctest::Approx(3.0).epsilon(1e-15));
  const Grid grid = make_grid({3, 3, 2}, {0, 0, 0}, {1, 1, 1});
  const FractionsFromMesh field = fractions_from_mesh(grid, back.positions, back.triangles);
  CHECK(worst(grid, field.fractions, [](const Index3& c) {
          return c[2] == 0 && c[0] < 2 && c[1] < 2 && c[0] + c[1] < 2 ? 1.0 : 0.0;
        }) < 1e-14);
}
