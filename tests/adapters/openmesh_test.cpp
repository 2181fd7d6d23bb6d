// Surfaces in OpenMesh. The judges are its own builder and its MeshChecker.

#include "difmesh/adapters/openmesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>

#include "adapters/openmesh_meshes.hpp"
#include "adapters/surfaces.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"
#include "support/mesh_field.hpp"

using namespace difmesh;
using namespace difmesh::test;

TYPE_TO_STRING(DoubleTriangles);
TYPE_TO_STRING(FloatTriangles);
TYPE_TO_STRING(DoublePolygons);
TYPE_TO_STRING(FloatPolygons);
TYPE_TO_STRING(MixedTriangles);

namespace {

#ifdef DIFMESH_SANITIZED  // slow to compile and to run
#define DIFMESH_OPENMESHES FloatPolygons, MixedTriangles
#else
#define DIFMESH_OPENMESHES \
  DoubleTriangles, FloatTriangles, DoublePolygons, FloatPolygons, MixedTriangles
#endif

template <class Vector>
bool holds(const Vector& there, const Vec3& here) {
  using Scalar = std::remove_cvref_t<decltype(there[0])>;
  return there[0] == static_cast<Scalar>(here[0]) && there[1] == static_cast<Scalar>(here[1]) &&
         there[2] == static_cast<Scalar>(here[2]);
}

/// Vertices from `first` on hold the mesh's positions, normals and edge ids.
template <class OMesh>
bool holds_arrays(const OMesh& other, const Mesh& mesh, int first = 0) {
  OpenMesh::VPropHandleT<std::uint64_t> ids;
  bool equal = mesh.edge_ids.empty() || other.get_property_handle(ids, "v:edge_id");
  for (std::size_t v = 0; equal && v < mesh.positions.size(); ++v) {
    const OpenMesh::VertexHandle vertex(first + static_cast<int>(v));
    equal = holds(other.point(vertex), mesh.positions[v]) &&
            (mesh.normals.empty() || holds(other.normal(vertex), mesh.normals[v])) &&
            (mesh.edge_ids.empty() || other.property(ids, vertex) == mesh.edge_ids[v]);
  }
  return equal;
}

Mesh small_sphere() {
  const OwnedField field = blob({12, 12, 12});
  Options options;
  options.vertex_normals = true;
  options.edge_ids = true;
  return reconstruct(field.view(), make_grid(field.dims), options).mesh;
}

Mesh random_order(Mesh mesh) {
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937_64(2));
  return mesh;
}

}  // namespace

TEST_CASE_TEMPLATE("openmesh: surfaces arrive as OpenMesh would build them and come back", OMesh,
                   DIFMESH_OPENMESHES) {
  for (const Surface& surface : all_surfaces()) {
    CAPTURE(surface.name);
    const Mesh& mesh = surface.mesh;
    const auto [other, report] = to_openmesh<OMesh>(mesh);
    CHECK(report.refused.empty());
    CHECK(report.vertices == static_cast<std::int64_t>(mesh.positions.size()));
    CHECK(report.faces == static_cast<std::int64_t>(mesh.triangles.size()));
    CHECK(report.edges == measure(mesh).edges);
    REQUIRE(other.n_vertices() == mesh.positions.size());
    REQUIRE(other.n_faces() == mesh.triangles.size());
    CHECK(holds_arrays(other, mesh));
    CHECK(same_halfedges(other, built_by_openmesh<OMesh>(mesh)));
    CHECK(judged_by_openmesh(other).empty());

    const Mesh back = mesh_from_openmesh(other);
    CHECK(same_bytes(back.triangles, mesh.triangles));
    CHECK(same_bytes(back.edge_ids, mesh.edge_ids));
    REQUIRE(back.positions.size() == mesh.positions.size());
    if constexpr (std::is_same_v<typename OMesh::Scalar, double>) {
      CHECK(same_bytes(back.positions, mesh.positions));
    }
    if constexpr (std::is_same_v<typename OMesh::Normal, OpenMesh::Vec3d>) {
      CHECK(same_bytes(back.normals, mesh.normals));
    }
  }
}

TEST_CASE("openmesh: what comes back gives the fractions of what went") {
  for (const Surface& surface : all_surfaces()) {
    if (surface.mesh.triangles.empty() || !measure(surface.mesh).closed) {
      continue;
    }
    CAPTURE(surface.name);
    const Mesh& mesh = surface.mesh;
    const TriangleMesh plain{{mesh.positions.begin(), mesh.positions.end()},
                             {mesh.triangles.begin(), mesh.triangles.end()}};
    const Grid grid = grid_around(plain, 12);
    const auto other = to_openmesh<DoublePolygons>(mesh).mesh;
    const Mesh back = mesh_from_openmesh(other);
    const FractionsFromMesh there = fractions_from_mesh(grid, mesh.positions, mesh.triangles);
    const FractionsFromMesh here = fractions_from_mesh(grid, back.positions, back.triangles);
    CHECK(same_bytes(there.fractions, here.fractions));
  }
}

TEST_CASE_TEMPLATE("openmesh: appended meshes do not touch what is there", OMesh, DoubleTriangles,
                   MixedTriangles) {
  const Mesh first = with_scalar(open_noise(), "curvature");
  const Mesh second = with_scalar(small_sphere(), "size");
  auto [other, report] = to_openmesh<OMesh>(first);
  OpenMesh::VPropHandleT<int> own;
  other.add_property(own, "own");
  for (const auto vertex : other.vertices()) {
    other.property(own, vertex) = vertex.idx();
  }
  const int shift = static_cast<int>(other.n_vertices());
  report = append_to_openmesh(other, second);
  CHECK(report.vertices == static_cast<std::int64_t>(second.positions.size()));
  CHECK(report.refused.empty());

  Mesh both = first;
  for (const Vec3& p : second.positions) {
    both.positions.push_back(p);
  }
  for (const Triangle& t : second.triangles) {
    const auto plus = static_cast<std::uint32_t>(shift);
    both.triangles.push_back({t[0] + plus, t[1] + plus, t[2] + plus});
  }
  CHECK(same_halfedges(other, built_by_openmesh<OMesh>(both)));
  CHECK(judged_by_openmesh(other).empty());
  CHECK(holds_arrays(other, first));
  CHECK(holds_arrays(other, second, shift));
  OpenMesh::VPropHandleT<double> curvature;
  OpenMesh::VPropHandleT<double> size;
  REQUIRE(other.get_property_handle(curvature, "v:curvature"));
  REQUIRE(other.get_property_handle(size, "v:size"));
  const Array<double>& firsts = first.scalars[0].values;
  const Array<double>& seconds = second.scalars[0].values;
  bool equal = true;
  for (const auto vertex : other.vertices()) {
    const int v = vertex.idx();
    equal =
        equal && other.property(own, vertex) == (v < shift ? v : 0) &&
        (v < shift ? other.property(curvature, vertex) == firsts[static_cast<std::size_t>(v)]
                   : other.property(size, vertex) == seconds[static_cast<std::size_t>(v - shift)]);
  }
  CHECK(equal);
  // Ids that start again do not ascend over all vertices, and Mesh allows no other.
  CHECK(mesh_from_openmesh(other).edge_ids.empty());
}

TEST_CASE("openmesh: scalars come back under their names") {
  const Mesh mesh = with_scalar(with_scalar(open_noise(), "curvature"), "size");
  auto other = to_openmesh<MixedTriangles>(mesh).mesh;
  OpenMesh::VPropHandleT<double> foreign;
  other.add_property(foreign, "without the letter");
  OpenMesh::VPropHandleT<float> rounded;
  other.add_property(rounded, "v:rounded");
  const Mesh back = mesh_from_openmesh(other);
  REQUIRE(back.scalars.size() == 2);
  CHECK(back.scalars[0].name == "curvature");
  CHECK(back.scalars[1].name == "size");
  CHECK(same_bytes(back.scalars[1].values, mesh.scalars[1].values));
  CHECK(mesh_from_openmesh(to_openmesh<MixedTriangles>(mesh, {.scalars = false}).mesh)
            .scalars.empty());
}

TEST_CASE("openmesh: attributes come when they are wanted") {
  const Mesh mesh = small_sphere();
  const auto bare = to_openmesh<DoubleTriangles>(mesh, {.normals = false, .edge_ids = false}).mesh;
  OpenMesh::VPropHandleT<std::uint64_t> ids;
  CHECK_FALSE(bare.has_vertex_normals());
  CHECK_FALSE(bare.get_property_handle(ids, "v:edge_id"));
  const auto full = to_openmesh<DoubleTriangles>(mesh).mesh;
  CHECK(full.has_vertex_normals());
  CHECK(full.get_property_handle(ids, "v:edge_id"));
  Mesh plain = mesh;
  plain.normals.clear();
  CHECK_FALSE(to_openmesh<DoubleTriangles>(plain).mesh.has_vertex_normals());
  // The traits of a mesh may have asked for normals before.
  CHECK(to_openmesh<MixedTriangles>(plain).mesh.has_vertex_normals());
}

TEST_CASE_TEMPLATE("openmesh: broken soups keep what can be kept", OMesh, DoubleTriangles,
                   FloatPolygons) {
  for (const BrokenSoup& soup : broken_soups()) {
    CAPTURE(soup.name);
    const auto [other, report] = to_openmesh<OMesh>(soup.mesh);
    REQUIRE(report.refused.size() == soup.refused.size());
    for (std::size_t n = 0; n < soup.refused.size(); ++n) {
      CHECK(report.refused[n].triangle == soup.refused[n].triangle);
      CHECK(report.refused[n].reason == soup.refused[n].reason);
    }
    const Mesh kept = without(soup.mesh, soup.refused);
    CHECK(other.n_vertices() == kept.positions.size());
    CHECK(report.faces == static_cast<std::int64_t>(kept.triangles.size()));
    CHECK(judged_by_openmesh(other).empty());
    CHECK(same_bytes(mesh_from_openmesh(other).triangles, kept.triangles));
    CHECK(same_halfedges(other, built_by_openmesh<OMesh>(kept)));
    check_kept_part(soup.mesh, report.refused);
  }
}

TEST_CASE("openmesh: random soups become manifolds") {
  std::size_t refused = 0;
  std::size_t kept = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const auto vertices = static_cast<std::uint32_t>(3 + seed % 40);
    const Mesh soup = random_soup(vertices, static_cast<std::uint32_t>(1 + 7 * seed % 300), seed);
    const auto [other, report] = to_openmesh<DoublePolygons>(soup);
    CHECK(judged_by_openmesh(other).empty());
    check_kept_part(soup, report.refused);
    const Mesh rest = without(soup, report.refused);
    CHECK(same_bytes(mesh_from_openmesh(other).triangles, rest.triangles));
    refused += report.refused.size();
    kept += rest.triangles.size();
  }
  CHECK(refused > 10000);
  CHECK(kept > 1000);
}

TEST_CASE("openmesh: a fan of many faces about one vertex") {
  const std::uint32_t n = 20000;
  Mesh cone;
  cone.positions.resize(n + 1, {0.0, 0.0, 1.0});
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / n;
    cone.positions[i + 1] = {std::cos(angle), std::sin(angle), 0.0};
    cone.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  const auto [other, report] = to_openmesh<DoubleTriangles>(cone);
  CHECK(report.refused.empty());
  CHECK(other.valence(OpenMesh::VertexHandle(0)) == n);
  CHECK(same_bytes(mesh_from_openmesh(other).triangles, cone.triangles));
  // In random order the way to the faces beside each one would be long, were it not sorted out.
  std::shuffle(cone.triangles.begin(), cone.triangles.end(), std::mt19937_64(1));
  const auto shuffled = to_openmesh<DoubleTriangles>(cone);
  CHECK(shuffled.report.refused.empty());
  CHECK(shuffled.mesh.valence(OpenMesh::VertexHandle(0)) == n);
  CHECK(
      judged_by_openmesh(to_openmesh<DoubleTriangles>(random_order(small_sphere())).mesh).empty());
  // One face flipped: it is found in a time that is not quadratic.
  std::swap(cone.triangles[777][0], cone.triangles[777][1]);
  const ImportReport second = to_openmesh<DoubleTriangles>(cone).report;
  REQUIRE(second.refused.size() == 1);
  CHECK(second.refused[0].triangle == 777);
}

TEST_CASE("openmesh: nothing is printed and its log stays as it is") {
  // Never disconnected, for OpenMesh would leak a few bytes.
  static std::ostringstream said;
  omerr().connect(said);
  for (const bool enabled : {true, false}) {
    enabled ? omerr().enable() : omerr().disable();
    for (const BrokenSoup& soup : broken_soups()) {
      CHECK_FALSE(to_openmesh<FloatTriangles>(soup.mesh).report.refused.empty());
    }
    CHECK(omerr().is_enabled() == enabled);
  }
  omerr().enable();
  CHECK(said.str().empty());
}

TEST_CASE("openmesh: what cannot be is an error and changes nothing") {
  auto other = to_openmesh<FloatTriangles>(small_sphere()).mesh;
  const FloatTriangles before = other;
  const auto fails = [&](const Mesh& mesh, const ImportOptions& options, ErrorCode code,
                         const std::string& word) {
    try {
      append_to_openmesh(other, mesh, options);
      FAIL_CHECK("no error was thrown");
    } catch (const Error& error) {
      const std::string message = error.what();
      CAPTURE(message);
      CHECK(error.code() == code);
      CHECK(message.find(word) != std::string::npos);
    }
    CHECK(same_halfedges(other, before));
  };
  const Mesh good = small_sphere();
  Mesh bad = good;
  bad.positions[17][1] = std::numeric_limits<double>::quiet_NaN();
  fails(bad, {}, ErrorCode::invalid_value, "vertex 17");
  bad.positions[17][1] = 1e39;
  fails(bad, {}, ErrorCode::invalid_value, "vertex 17");
  CHECK(to_openmesh<DoubleTriangles>(bad).report.refused.empty());
  bad = good;
  bad.normals.pop_back();
  fails(bad, {}, ErrorCode::invalid_argument, "normals");
  bad = good;
  bad.edge_ids.push_back(1);
  fails(bad, {}, ErrorCode::invalid_argument, "edge_ids");
  bad = good;
  bad.scalars.push_back({"curvature", {1.0, 2.0}});
  fails(bad, {}, ErrorCode::invalid_argument, "'curvature'");
  MeshView view;
  view.vertices = 3;
  CHECK_THROWS_AS(append_to_openmesh(other, view), Error);
}

TEST_CASE("openmesh: deleted elements stay behind on the way back") {
  const Mesh mesh = small_sphere();
  auto other = to_openmesh<MixedTriangles>(mesh).mesh;
  other.delete_vertex(OpenMesh::VertexHandle(5), false);
  const Mesh back = mesh_from_openmesh(other);
  CHECK(back.positions.size() == mesh.positions.size() - 1);
  const Measure facts = measure(back);
  CHECK(facts.manifold);
  CHECK(facts.boundary_edges ==
        static_cast<std::int64_t>(mesh.triangles.size() - back.triangles.size()));
  CHECK(back.edge_ids.size() == back.positions.size());
  // More can be appended before the garbage is collected.
  append_to_openmesh(other, mesh);
  CHECK(judged_by_openmesh(other).empty());
  other.garbage_collection();
  CHECK(other.n_vertices() == 2 * mesh.positions.size() - 1);
}

TEST_CASE("openmesh: polygons come back as fans of the same volume and fractions") {
  const PolygonMesh cube = cube_of_squares();
  const PolygonMesh prism = prism_with_concave_caps();
  for (const PolygonMesh* polygons : {&cube, &prism}) {
    DoublePolygons other;
    std::vector<OpenMesh::VertexHandle> vertices;
    for (const Vec3& p : polygons->positions) {
      vertices.push_back(other.add_vertex({p[0], p[1], p[2]}));
    }
    for (const std::vector<std::uint32_t>& polygon : polygons->faces) {
      std::vector<OpenMesh::VertexHandle> corners;
      for (const std::uint32_t v : polygon) {
        corners.push_back(vertices[v]);
      }
      REQUIRE(other.add_face(corners).is_valid());
    }
    const Mesh back = mesh_from_openmesh(other);
    // Cells of side 1/2: all are full or empty.
    const Grid grid = make_grid({5, 5, 3}, {0, 0, 0}, {0.5, 0.5, 0.5});
    const FractionsFromMesh field = fractions_from_mesh(grid, back.positions, back.triangles);
    const bool is_prism = polygons == &prism;
    CHECK(worst(grid, field.fractions, [&](const Index3& cell) {
            const auto half = [&](std::size_t a) { return cell[a] < 2; };
            const bool in_l = cell[0] < 4 && cell[1] < 4 && (half(0) || half(1));
            return half(2) && (is_prism ? in_l : half(0) && half(1)) ? 1.0 : 0.0;
          }) < 1e-14);
  }
}
