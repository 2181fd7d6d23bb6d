#pragma once
// What the opaque handles hold.

#include <optional>

#include "difmesh/difmesh.h"
#include "difmesh/mesh.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"

struct dif_mesh {
  difmesh::Mesh mesh;
  std::optional<difmesh::Report> report;  ///< of meshes that a reconstruction made
};

struct dif_shape {
  difmesh::Shape shape;
};
