#pragma once
// What the opaque handles hold.

#include <optional>
#include <string>
#include <vector>

#include "difmesh/difmesh.h"
#include "difmesh/mesh.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"

struct dif_mesh {
  difmesh::Mesh mesh;
  std::optional<difmesh::Report> report = {};  ///< of meshes that a reconstruction made
  std::vector<std::string> warnings = {};      ///< of the file or field that it comes from
};

struct dif_shape {
  difmesh::Shape shape;
};
