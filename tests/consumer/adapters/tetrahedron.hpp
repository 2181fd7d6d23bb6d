#pragma once
#include <difmesh/mesh.hpp>

inline difmesh::Mesh tetrahedron() {
  difmesh::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.normals = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.edge_ids = {3, 5, 8, 13};
  return mesh;
}

inline bool same(const difmesh::Mesh& a, const difmesh::Mesh& b) {
  return a.positions == b.positions && a.triangles == b.triangles && a.normals == b.normals &&
         a.edge_ids == b.edge_ids;
}
