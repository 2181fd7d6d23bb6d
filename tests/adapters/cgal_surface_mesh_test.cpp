// Surfaces in CGAL's Surface_mesh, over several kernels. Surface_mesh and PMP are under the GPL:
// for tests only.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <limits>
#include <type_traits>

#include "adapters/graphs.hpp"
#include "adapters/surfaces.hpp"
#include "difmesh/adapters/cgal.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/measure.hpp"
#include "support/fields.hpp"
#include "support/mesh_field.hpp"

// Sanitizers make this unit the dearest of all to compile: what is theirs to find shows with two
// kernels.
#ifndef DIFMESH_SANITIZED
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#endif

using namespace difmesh;
using namespace difmesh::test;

namespace {

template <class Kernel>
using MeshOver = CGAL::Surface_mesh<typename Kernel::Point_3>;
using Inexact = MeshOver<CGAL::Exact_predicates_inexact_constructions_kernel>;
using Floats = MeshOver<CGAL::Simple_cartesian<float>>;
#ifdef DIFMESH_SANITIZED
#define DIFMESH_KERNELS Inexact, Floats
#else
using Exact = MeshOver<CGAL::Exact_predicates_exact_constructions_kernel>;
#define DIFMESH_KERNELS Inexact, Floats, Exact
#endif

template <class SurfaceMesh>
using NormalOf = typename CGAL::Kernel_traits<typename SurfaceMesh::Point>::Kernel::Vector_3;

template <class Vector>
bool holds(const Vector& there, const Vec3& here) {
  using Number = detail::NumberOf<Vector>;
  return there[0] == static_cast<Number>(here[0]) && there[1] == static_cast<Number>(here[1]) &&
         there[2] == static_cast<Number>(here[2]);
}

/// Vertices from `first` on hold the mesh's positions, normals and edge ids.
template <class SurfaceMesh>
bool holds_arrays(const SurfaceMesh& other, const Mesh& mesh, std::size_t first = 0) {
  using Index = typename SurfaceMesh::Vertex_index;
  const auto normals = other.template property_map<Index, NormalOf<SurfaceMesh>>("v:normal");
  const auto ids = other.template property_map<Index, std::uint64_t>("v:edge_id");
  bool equal = (mesh.normals.empty() || normals.second) && (mesh.edge_ids.empty() || ids.second);
  for (std::size_t v = 0; equal && v < mesh.positions.size(); ++v) {
    const Index vertex(static_cast<std::uint32_t>(first + v));
    equal = holds(other.point(vertex), mesh.positions[v]) &&
            (mesh.normals.empty() || holds(normals.first[vertex], mesh.normals[v])) &&
            (mesh.edge_ids.empty() || ids.first[vertex] == mesh.edge_ids[v]);
  }
  return equal;
}

}  // namespace

TYPE_TO_STRING(Inexact);
TYPE_TO_STRING(Floats);
#ifndef DIFMESH_SANITIZED
TYPE_TO_STRING(Exact);
#endif

TEST_CASE_TEMPLATE("surface_mesh: surfaces arrive as CGAL would build them and come back",
                   SurfaceMesh, DIFMESH_KERNELS) {
  for (const Surface& surface : all_surfaces()) {
    CAPTURE(surface.name);
    const Mesh& mesh = surface.mesh;
    const auto [other, report] = to_cgal<SurfaceMesh>(mesh);
    CHECK(report.refused.empty());
    CHECK(report.vertices == static_cast<std::int64_t>(mesh.positions.size()));
    CHECK(report.faces == static_cast<std::int64_t>(mesh.triangles.size()));
    CHECK(report.edges == measure(mesh).edges);
    REQUIRE(other.number_of_vertices() == mesh.positions.size());
    REQUIRE(other.number_of_faces() == mesh.triangles.size());
    CHECK(other.number_of_edges() == static_cast<std::size_t>(report.edges));
    CHECK(holds_arrays(other, mesh));
    CHECK(judged_by_cgal(other).empty());
    CHECK(other.is_valid(false));
    CHECK(CGAL::is_closed(other) == measure(mesh).closed);

    const Mesh back = mesh_from_cgal(other);
    CHECK(same_bytes(back.triangles, mesh.triangles));
    CHECK(same_bytes(back.edge_ids, mesh.edge_ids));
    if constexpr (!std::is_same_v<SurfaceMesh, Floats>) {
      CHECK(same_bits(back, mesh));
    }
    if constexpr (std::is_same_v<SurfaceMesh, Inexact>) {
      CHECK((structure(other) == structure(built_by_cgal<SurfaceMesh>(mesh))));
    }
  }
}

TEST_CASE("surface_mesh: what comes back gives the fractions of what went") {
  for (const Surface& surface : all_surfaces()) {
    if (surface.mesh.triangles.empty() || !measure(surface.mesh).closed) {
      continue;
    }
    CAPTURE(surface.name);
    const Mesh& mesh = surface.mesh;
    const TriangleMesh plain{{mesh.positions.begin(), mesh.positions.end()},
                             {mesh.triangles.begin(), mesh.triangles.end()}};
    const Grid grid = grid_around(plain, 12);
    const Mesh back = mesh_from_cgal(to_cgal<Inexact>(mesh).mesh);
    const FractionsFromMesh there = fractions_from_mesh(grid, mesh.positions, mesh.triangles);
    const FractionsFromMesh here = fractions_from_mesh(grid, back.positions, back.triangles);
    CHECK(same_bytes(there.fractions, here.fractions));
  }
}

TEST_CASE("surface_mesh: appended meshes do not touch what is there") {
  using Index = Inexact::Vertex_index;
  const Mesh first = with_scalar(open_noise(), "curvature");
  const Mesh second = with_scalar(closed_noise(), "size");
  auto [other, report] = to_cgal<Inexact>(first);
  auto own = other.add_property_map<Index, int>("v:own", -1).first;
  own[Index(3)] = 3;
  report = append_to_cgal(other, second);
  const std::size_t shift = first.positions.size();
  Mesh both = first;
  both.positions.insert(both.positions.end(), second.positions.begin(), second.positions.end());
  for (const Triangle& t : second.triangles) {
    const auto plus = static_cast<std::uint32_t>(shift);
    both.triangles.push_back({t[0] + plus, t[1] + plus, t[2] + plus});
  }
  CHECK((structure(other) == structure(built_by_cgal<Inexact>(both))));
  CHECK(judged_by_cgal(other).empty());
  CHECK(holds_arrays(other, first));
  CHECK(holds_arrays(other, second, shift));
  const auto curvature = other.property_map<Index, double>("v:curvature");
  const auto size = other.property_map<Index, double>("v:size");
  REQUIRE((curvature.second && size.second));
  const Array<double>& firsts = first.scalars[0].values;
  const Array<double>& seconds = second.scalars[0].values;
  bool equal = own[Index(3)] == 3;
  for (const Index v : other.vertices()) {
    equal = equal && (v == Index(3) || own[v] == -1) &&
            (std::size_t{v} < shift ? curvature.first[v] == firsts[v]
                                    : size.first[v] == seconds[v - shift]);
  }
  CHECK(equal);
  const Mesh back = mesh_from_cgal(other);
  CHECK(back.edge_ids.empty());
  REQUIRE(back.scalars.size() == 2);
  CHECK(back.scalars[0].name == "curvature");
  CHECK(back.scalars[0].values[3] == firsts[3]);
  CHECK(back.scalars[1].name == "size");
  CHECK(back.scalars[1].values.back() == seconds.back());
}

TEST_CASE("surface_mesh: removed items are neither used nor harmed") {
  const Mesh mesh = closed_noise();
  auto other = to_cgal<Inexact>(mesh).mesh;
  const auto face = Inexact::Face_index(10);
  CGAL::Euler::remove_face(other.halfedge(face), other);
  const std::size_t vertices = other.number_of_vertices();
  const Mesh left = mesh_from_cgal(other);
  CHECK(left.triangles.size() == mesh.triangles.size() - 1);
  const ImportReport report = append_to_cgal(other, mesh);
  CHECK(report.faces == static_cast<std::int64_t>(mesh.triangles.size()));
  CHECK(other.number_of_vertices() == vertices + mesh.positions.size());
  CHECK(other.number_of_removed_faces() == 1);
  CHECK(judged_by_cgal(other).empty());
  other.collect_garbage();
  CHECK(other.number_of_faces() == 2 * mesh.triangles.size() - 1);
  CHECK(judged_by_cgal(other).empty());
}

TEST_CASE("surface_mesh: attributes come when they are wanted") {
  using Index = Inexact::Vertex_index;
  const auto bare = to_cgal<Inexact>(open_noise(), {.normals = false, .edge_ids = false}).mesh;
  CHECK_FALSE(bare.property_map<Index, NormalOf<Inexact>>("v:normal").second);
  CHECK_FALSE(bare.property_map<Index, std::uint64_t>("v:edge_id").second);
  CHECK(mesh_from_cgal(bare).normals.empty());
}

TEST_CASE("surface_mesh: broken soups keep what can be kept") {
  for (const BrokenSoup& soup : broken_soups()) {
    CAPTURE(soup.name);
    const auto [other, report] = to_cgal<Inexact>(soup.mesh);
    REQUIRE(report.refused.size() == soup.refused.size());
    for (std::size_t n = 0; n < soup.refused.size(); ++n) {
      CHECK(report.refused[n].triangle == soup.refused[n].triangle);
      CHECK(report.refused[n].reason == soup.refused[n].reason);
    }
    const Mesh kept = without(soup.mesh, soup.refused);
    CHECK(judged_by_cgal(other).empty());
    CHECK(same_bytes(mesh_from_cgal(other).triangles, kept.triangles));
    CHECK((structure(other) == structure(built_by_cgal<Inexact>(kept))));
  }
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const auto vertices = static_cast<std::uint32_t>(3 + seed % 40);
    const Mesh soup = random_soup(vertices, static_cast<std::uint32_t>(1 + 7 * seed % 300), seed);
    const auto [other, report] = to_cgal<Inexact>(soup);
    CHECK(judged_by_cgal(other).empty());
    check_kept_part(soup, report.refused);
  }
}

TEST_CASE("surface_mesh: what cannot be is an error and changes nothing") {
  auto other = to_cgal<Floats>(open_noise()).mesh;
  const auto before = structure(other);
  Mesh bad = open_noise();
  bad.positions[17][2] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(append_to_cgal(other, bad), doctest::Contains("vertex 17"), Error);
  bad.positions[17][2] = -1e39;
  CHECK_THROWS_WITH_AS(append_to_cgal(other, bad), doctest::Contains("vertex 17"), Error);
  CHECK(to_cgal<Inexact>(bad).report.refused.empty());
  bad = open_noise();
  bad.normals.pop_back();
  CHECK_THROWS_WITH_AS(append_to_cgal(other, bad), doctest::Contains("normals"), Error);
  CHECK((structure(other) == before));
}
