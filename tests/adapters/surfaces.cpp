#include "adapters/surfaces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"
#include "support/mesh_field.hpp"

namespace difmesh::test {
namespace {

Mesh surface_of(const FieldView& field, const Grid& grid, Side side) {
  Options options;
  options.boundary.fill(side);
  options.vertex_normals = true;
  options.edge_ids = true;
  return reconstruct(field, grid, options).mesh;
}

Mesh as_mesh(const TriangleMesh& source) {
  Mesh mesh;
  mesh.positions.assign(source.positions.begin(), source.positions.end());
  mesh.triangles.assign(source.triangles.begin(), source.triangles.end());
  return mesh;
}

void add_solver_fields(std::vector<Surface>& surfaces) {
  struct Source {
    const char* name;
    Vec3 spacing;
  };
  const Vec3 cube{0.015625, 0.015625, 0.015625};
  for (const Source& source :
       {Source{"gerris_drops64_t0.45", cube},
        Source{"interfoam_dambreak_64x40x80_t0.3", {0.015625, 0.025, 0.0125}},
        Source{"isofoam_vortex64_t1.5", cube}}) {
    const auto path =
        std::filesystem::path(DIFMESH_SHARED_DATA) / (std::string(source.name) + ".npy");
    if (!std::filesystem::exists(path)) {
      MESSAGE("skipped: no " << path.string());
      continue;
    }
    const FieldFile file = read_field(path);
    const Grid grid = make_grid(file.dims, {0, 0, 0}, source.spacing);
    for (const Side side : {Side::open, Side::empty}) {
      surfaces.push_back({std::string(source.name) + (side == Side::open ? " open" : " closed"),
                          surface_of(file.view(), grid, side)});
    }
  }
}

void add_shared_meshes(std::vector<Surface>& surfaces) {
  for (const SharedMesh& shared : kSharedMeshes) {
    if (const auto mesh = shared_mesh(shared.file)) {
      const Grid grid = grid_around(*mesh, 40);
      const FractionsFromMesh field = run(grid, *mesh);
      surfaces.push_back({shared.file, as_mesh(*mesh)});
      surfaces.push_back(
          {std::string(shared.file) + " by its fractions",
           surface_of(FieldView::x_fastest(field.fractions.data(), grid.dims), grid, Side::empty)});
    }
  }
}

Mesh white_surface(Side side) {
  const OwnedField field = white_noise({14, 12, 13}, 7);
  return surface_of(field.view(), make_grid(field.dims), side);
}

Mesh half_surface(Side side) {
  const OwnedField field = half_noise({11, 13, 12}, 8);
  return surface_of(field.view(), make_grid(field.dims), side);
}

void add_noise(std::vector<Surface>& surfaces) {
  for (const Side side : {Side::empty, Side::open, Side::periodic}) {
    const std::string kind = std::to_string(static_cast<int>(side));
    surfaces.push_back({"white noise, sides of kind " + kind, white_surface(side)});
    surfaces.push_back({"halves at random, sides of kind " + kind, half_surface(side)});
  }
}

Mesh mesh_of(std::uint32_t vertices, const std::vector<Triangle>& triangles) {
  Mesh mesh;
  Random random(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    mesh.positions.push_back({random.uniform(), random.uniform(), random.uniform()});
  }
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

/// Twice n + 1 faces: the two cones of a double pyramid over a polygon of n corners, tips n, n + 1.
std::vector<Triangle> double_pyramid(std::uint32_t n) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    triangles.push_back({i, (i + 1) % n, n});
    triangles.push_back({(i + 1) % n, i, n + 1});
  }
  return triangles;
}

std::vector<Triangle> shifted(std::vector<Triangle> triangles, std::uint32_t vertex,
                              std::uint32_t becomes, std::uint32_t shift) {
  for (Triangle& t : triangles) {
    for (std::uint32_t& v : t) {
      v = v == vertex ? becomes : v + shift;
    }
  }
  return triangles;
}

}  // namespace

const std::vector<Surface>& all_surfaces() {
  static const std::vector<Surface> surfaces = [] {
    std::vector<Surface> made;
    add_solver_fields(made);
    add_shared_meshes(made);
    add_noise(made);
    const OwnedField nothing({6, 6, 6});
    made.push_back({"nothing", surface_of(nothing.view(), make_grid(nothing.dims), Side::empty)});
    return made;
  }();
  return surfaces;
}

Mesh closed_noise() {
  return white_surface(Side::empty);
}

Mesh open_noise() {
  return half_surface(Side::open);
}

std::vector<BrokenSoup> broken_soups() {
  using R = Refusal;
  std::vector<BrokenSoup> soups;
  soups.push_back({"three faces on an edge",
                   mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
                   {{2, R::edge_taken}}});
  soups.push_back(
      {"a degenerate face", mesh_of(4, {{0, 1, 2}, {1, 1, 3}, {1, 0, 3}}), {{1, R::degenerate}}});
  soups.push_back({"an index out of range",
                   mesh_of(4, {{0, 1, 4}, {0, 1, 2}, {9, 9, 9}}),
                   {{0, R::index_out_of_range}, {2, R::index_out_of_range}}});
  soups.push_back(
      {"a face twice", mesh_of(4, {{0, 1, 2}, {1, 0, 3}, {1, 2, 0}}), {{2, R::edge_taken}}});
  // Wherever it stands, the flipped face goes and its neighbours stay.
  const std::vector<Triangle> solid = double_pyramid(6);
  for (const std::size_t flipped : {std::size_t{0}, std::size_t{5}, solid.size() - 1}) {
    std::vector<Triangle> triangles = solid;
    std::swap(triangles[flipped][0], triangles[flipped][1]);
    soups.push_back({"face " + std::to_string(flipped) + " flipped",
                     mesh_of(8, triangles),
                     {{static_cast<std::int64_t>(flipped), R::edge_taken}}});
  }
  // A bow-tie of an open fan of one face and one of two.
  soups.push_back(
      {"an open bow-tie", mesh_of(6, {{0, 1, 2}, {0, 3, 4}, {0, 4, 5}}), {{0, R::vertex_taken}}});
  // Two solids that touch in a point, 6: eight vertices of the one, five more of the other. The
  // latter's tip has five faces, against six.
  std::vector<Triangle> touching = double_pyramid(6);
  const std::vector<Triangle> second = shifted(double_pyramid(5), 5, 6, 8);
  touching.insert(touching.begin(), second.begin(), second.end());
  soups.push_back({"two solids that touch in a point",
                   mesh_of(15, touching),
                   {{0, R::vertex_taken},
                    {2, R::vertex_taken},
                    {4, R::vertex_taken},
                    {6, R::vertex_taken},
                    {8, R::vertex_taken}}});
  soups.push_back({"all of it",
                   mesh_of(9, {{3, 3, 3},
                               {0, 1, 2},
                               {1, 0, 3},
                               {0, 1, 4},
                               {2, 5, 6},
                               {7, 8, 9},
                               {2, 0, 1},
                               {5, 2, 8}}),
                   {{0, R::degenerate},
                    {3, R::edge_taken},
                    {5, R::index_out_of_range},
                    {6, R::edge_taken},
                    {1, R::vertex_taken}}});
  for (BrokenSoup& soup : soups) {
    std::sort(soup.refused.begin(), soup.refused.end(),
              [](const RefusedFace& a, const RefusedFace& b) { return a.triangle < b.triangle; });
  }
  return soups;
}

Mesh random_soup(std::uint32_t vertices, std::uint32_t triangles, std::uint64_t seed) {
  std::vector<Triangle> faces;
  Random random(seed);
  const auto vertex = [&] {
    return static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(vertices)));
  };
  for (std::uint32_t t = 0; t < triangles; ++t) {
    faces.push_back({vertex(), vertex(), vertex()});
  }
  return mesh_of(vertices, faces);
}

Mesh without(const Mesh& mesh, const std::vector<RefusedFace>& refused) {
  Mesh kept = mesh;
  for (auto face = refused.rbegin(); face != refused.rend(); ++face) {
    kept.triangles.erase(kept.triangles.begin() + face->triangle);
  }
  return kept;
}

void check_kept_part(const Mesh& mesh, const std::vector<RefusedFace>& refused) {
  const Mesh kept = without(mesh, refused);
  const Measure facts = measure(kept);
  CHECK(facts.manifold);
  CHECK(facts.non_manifold_edges + facts.misoriented_edges + facts.non_manifold_vertices == 0);
  for (const Triangle& t : kept.triangles) {
    REQUIRE((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
  }
}

PolygonMesh cube_of_squares() {
  PolygonMesh mesh;
  mesh.positions = box_mesh({0, 0, 0}, {1, 1, 1}).positions;
  mesh.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return mesh;
}

PolygonMesh prism_with_concave_caps() {
  // The corners of an L; a fan about the first of them folds over.
  const std::vector<std::pair<double, double>> outline{{2, 0}, {2, 1}, {1, 1},
                                                       {1, 2}, {0, 2}, {0, 0}};
  PolygonMesh mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  mesh.faces.resize(2);
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : outline) {
      mesh.positions.push_back({x, y, z});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.faces[0].push_back(n - 1 - i);
    mesh.faces[1].push_back(n + i);
    mesh.faces.push_back({i, j, n + j, n + i});
  }
  return mesh;
}

Mesh with_scalar(Mesh mesh, const std::string& name) {
  Array<double> values;
  for (const Vec3& p : mesh.positions) {
    values.push_back(p[0] - 2.0 * p[1] + 0.1 * p[2] * p[2]);
  }
  mesh.scalars.push_back({name, std::move(values)});
  return mesh;
}

}  // namespace difmesh::test
