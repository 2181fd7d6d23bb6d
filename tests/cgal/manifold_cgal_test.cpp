// Marching cubes yields manifolds without self-intersection for every input. The judges are CGAL
// (closed, outward, bounding a volume, free of self-intersection, with exact predicates) and
// OpenMesh (accepts every face).

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"

using namespace difmesh;
using difmesh::test::OwnedField;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

#ifdef DIFMESH_SANITIZED
constexpr int kNoiseFields = 5;
constexpr int kCasePositions = 1;
#else
constexpr int kNoiseFields = 100;
constexpr int kCasePositions = 20;
#endif

// What a judge found wrong, or "fine".
std::string judge_with_openmesh(const Mesh& mesh) {
  OpenMeshMesh other;
  std::vector<OpenMeshMesh::VertexHandle> vertices;
  for (const Vec3& p : mesh.positions) {
    vertices.push_back(other.add_vertex({p[0], p[1], p[2]}));
  }
  omerr().disable();
  std::size_t refused = 0;
  for (const Triangle& t : mesh.triangles) {
    refused += other.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid() ? 0U : 1U;
  }
  omerr().enable();
  if (refused != 0) {
    return "OpenMesh refused " + std::to_string(refused) + " faces";
  }
  for (const auto vertex : other.vertices()) {
    if (!other.is_manifold(vertex)) {
      return "OpenMesh: vertex " + std::to_string(vertex.idx()) + " is not manifold";
    }
  }
  return "fine";
}

std::string judge_with_cgal(const Reconstruction& result) {
  SurfaceMesh other;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (const Vec3& p : result.mesh.positions) {
    vertices.push_back(other.add_vertex({p[0], p[1], p[2]}));
  }
  for (const Triangle& t : result.mesh.triangles) {
    if (other.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) ==
        SurfaceMesh::null_face()) {
      return "CGAL refused a face";
    }
  }
  if (!other.is_valid(false)) {
    return "CGAL finds the halfedges invalid";
  }
  if (CGAL::is_closed(other) != result.report.closed) {
    return "CGAL and the report disagree about closed";
  }
  if (processing::does_self_intersect(other)) {
    return "self-intersection";
  }
  return "fine";
}

// For closed surfaces about material: CGAL's whole notion of a solid.
std::string judge_solid(const Reconstruction& result) {
  SurfaceMesh other;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (const Vec3& p : result.mesh.positions) {
    vertices.push_back(other.add_vertex({p[0], p[1], p[2]}));
  }
  for (const Triangle& t : result.mesh.triangles) {
    other.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  }
  if (!CGAL::is_closed(other)) {
    return "not closed";
  }
  if (!processing::does_bound_a_volume(other)) {
    return "bounds no volume";
  }
  if (!processing::is_outward_oriented(other)) {
    return "inside out";
  }
  return "fine";
}

std::string judge(const OwnedField& field, const Options& options) {
  const Grid grid{field.dims, {0.1, -3.0, 7.0}, {1.0, 0.5, 2.3}};
  const Reconstruction result = reconstruct(field.view(), grid, options);
  if (result.mesh.triangles.empty()) {
    return "no surface";
  }
  std::string verdict = judge_with_openmesh(result.mesh);
  if (verdict == "fine") {
    verdict = judge_with_cgal(result);
  }
  const bool closed_by_empty = std::all_of(options.boundary.begin(), options.boundary.end(),
                                           [](Side side) { return side == Side::empty; });
  if (verdict == "fine" && closed_by_empty) {
    verdict = judge_solid(result);
  }
  return verdict;
}

constexpr Side kAllSides[] = {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full};

}  // namespace

TEST_CASE("manifold: all 256 cases with random vertex positions") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  Options options;
  options.boundary.fill(Side::empty);
  for (int inside = 1; inside < 256; ++inside) {
    for (int round = 0; round < kCasePositions; ++round) {
      OwnedField field({2, 2, 2});
      for (std::size_t c = 0; c < 8; ++c) {
        // A share near the ends makes thin and fat triangles alike.
        const double share = round % 2 == 0 ? even(random) : std::pow(even(random), 8.0);
        field.values[c] = (inside >> c & 1) != 0 ? 0.5 + 0.5 * share : 0.5 * (1.0 - share) * 0.999;
      }
      options.placement = round % 4 < 2 ? Placement::plic : Placement::linear;
      CAPTURE(inside);
      REQUIRE(judge(field, options) == "fine");
    }
  }
}

TEST_CASE("manifold: white noise with every kind of side") {
  for (const Side side : kAllSides) {
    for (int n = 0; n < kNoiseFields; ++n) {
      Options options;
      options.boundary.fill(side);
      options.placement = n % 5 == 4   ? Placement::linear
                          : n % 5 == 3 ? Placement::curved
                                       : Placement::plic;
      CAPTURE(static_cast<int>(side));
      CAPTURE(n);
      const auto seed = static_cast<std::uint64_t>(1000 * static_cast<int>(side) + n);
      REQUIRE(judge(test::white_noise({16, 16, 16}, seed), options) == "fine");
    }
  }
}

TEST_CASE("manifold: sides mixed at random and thin domains") {
  std::mt19937_64 random(5);
  constexpr Index3 kDims[] = {{16, 16, 1}, {1, 12, 16}, {2, 16, 3}, {9, 9, 9}, {1, 1, 40}};
  for (int n = 0; n < 2 * kNoiseFields; ++n) {
    Options options;
    for (Side& side : options.boundary) {
      constexpr Side kAlone[] = {Side::open, Side::mirror, Side::empty, Side::full};
      side = kAlone[random() % 4];
    }
    CAPTURE(n);
    const std::string verdict = judge(test::white_noise(kDims[n % 5], random()), options);
    CAPTURE(verdict);
    REQUIRE((verdict == "fine" || verdict == "no surface"));
  }
}

TEST_CASE("manifold: values out of 0 and 1/2 and 1") {
  for (const Side side : kAllSides) {
    for (int n = 0; n < kNoiseFields / 5; ++n) {
      for (const Placement placement : {Placement::midpoint, Placement::linear, Placement::manson,
                                        Placement::plic, Placement::curved}) {
        Options options;
        options.boundary.fill(side);
        options.placement = placement;
        CAPTURE(static_cast<int>(side));
        CAPTURE(static_cast<int>(placement));
        REQUIRE(judge(test::half_noise({12, 12, 12}, static_cast<std::uint64_t>(n)), options) ==
                "fine");
      }
    }
  }
}
