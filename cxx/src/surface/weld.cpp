#include "difmesh/weld.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/edge_id.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/printable.hpp"

namespace difmesh {
namespace {

[[noreturn]] void fail(std::size_t mesh, const std::string& what) {
  throw Error(ErrorCode::invalid_argument, "weld: mesh " + std::to_string(mesh) + " " + what);
}

// The values of a scalar, or nullptr.
const Array<double>* find_scalar(const Mesh& mesh, const std::string& name) {
  for (const VertexScalar& scalar : mesh.scalars) {
    if (scalar.name == name) {
      return &scalar.values;
    }
  }
  return nullptr;
}

// All have the scalars of the first one that has vertices.
void check_scalars(std::span<const Mesh* const> meshes, std::size_t first, std::size_t m) {
  if (meshes[m]->scalars.size() != meshes[first]->scalars.size()) {
    fail(m, "differs from mesh " + std::to_string(first) + " in its scalars");
  }
  for (const VertexScalar& scalar : meshes[first]->scalars) {
    const auto has_name = [&](const VertexScalar& s) { return s.name == scalar.name; };
    const std::vector<VertexScalar>& own = meshes[m]->scalars;
    if (std::count_if(own.begin(), own.end(), has_name) > 1) {
      fail(m, "has two scalars '" + printable(scalar.name) + "'");
    }
    const Array<double>* const values = find_scalar(*meshes[m], scalar.name);
    if (values == nullptr) {
      fail(m, "has no scalar '" + printable(scalar.name) + "', which mesh " +
                  std::to_string(first) + " has");
    }
    if (values->size() != meshes[m]->positions.size()) {
      fail(m, "has '" + printable(scalar.name) + "' for some vertices only");
    }
  }
}

void check(std::span<const Mesh* const> meshes, const Index3& dims) {
  const std::uint64_t end = edge_id_end(dims);
  std::size_t first = meshes.size();  // with vertices
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (meshes[m] == nullptr) {
      fail(m, "is NULL");
    }
    const Mesh& mesh = *meshes[m];
    if (mesh.edge_ids.size() != mesh.positions.size()) {
      fail(m, "has no edge_ids");
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
      fail(m, "has normals for some vertices only");
    }
    if (!mesh.positions.empty()) {
      first = std::min(first, m);
      if (mesh.normals.empty() != meshes[first]->normals.empty()) {
        fail(m, "differs from mesh " + std::to_string(first) + " in having normals or not");
      }
      check_scalars(meshes, first, m);
    }
    for (const std::uint64_t id : mesh.edge_ids) {
      if (id >= end) {
        fail(m, "has an edge id outside the grid: " + std::to_string(id));
      }
    }
    for (const Triangle& triangle : mesh.triangles) {
      if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.positions.size()) {
        fail(m, "has a triangle with an index out of range");
      }
    }
  }
}

// The lower node of the dual cell that a triangle lies in, as the id of its edge in x: the low
// corner of the box around its edges. No triangle is flat on a face of its cell, so the box is the
// cell.
std::uint64_t cell_of(const std::array<std::uint64_t, 3>& ids, const Index3& dims) {
  Index3 low = edge_of(dims, ids[0]).lower;
  for (const std::uint64_t id : {ids[1], ids[2]}) {
    const Index3 lower = edge_of(dims, id).lower;
    for (std::size_t t = 0; t < 3; ++t) {
      low[t] = std::min(low[t], lower[t]);
    }
  }
  return edge_id(dims, {low, 0});
}

struct PlacedTriangle {
  std::uint64_t cell;
  Triangle corners;
  std::uint32_t mesh;
};

// Sorts a list of parts, those between `ends` that follow each other. Parts that are sorted, as
// those of reconstruct_block() are, are merged only. Stable.
template <class List, class Less>
void merge_parts(List& list, std::vector<std::size_t> ends, const Less& less) {
  const auto at = [&](std::size_t n) { return list.begin() + static_cast<std::ptrdiff_t>(n); };
  for (std::size_t n = 1; n < ends.size(); ++n) {
    if (!std::is_sorted(at(ends[n - 1]), at(ends[n]), less)) {
      std::stable_sort(at(ends[n - 1]), at(ends[n]), less);
    }
  }
  while (ends.size() > 2) {
    std::vector<std::size_t> merged{0};
    for (std::size_t n = 1; n < ends.size(); n += 2) {
      if (n + 1 < ends.size()) {
        std::inplace_merge(at(ends[n - 1]), at(ends[n]), at(ends[n + 1]), less);
      }
      merged.push_back(ends[std::min(n + 1, ends.size() - 1)]);
    }
    ends = std::move(merged);
  }
}

// Where an id stands among the ascending ones; near `from` if the last was there.
using Ids = Array<std::uint64_t>;
Ids::const_iterator find_from(const Ids& ids, Ids::const_iterator from, std::uint64_t id) {
  constexpr int kNear = 16;
  for (int n = 0; n < kNear && from != ids.end() && *from <= id; ++n, ++from) {
    if (*from == id) {
      return from;
    }
  }
  return std::lower_bound(ids.begin(), ids.end(), id);
}

// Each dual cell is of one block alone. \pre sorted by cell
void check_disjoint(const std::vector<PlacedTriangle>& triangles, const Index3& dims) {
  const auto shared = std::adjacent_find(triangles.begin(), triangles.end(),
                                         [](const PlacedTriangle& a, const PlacedTriangle& b) {
                                           return a.cell == b.cell && a.mesh != b.mesh;
                                         });
  if (shared == triangles.end()) {
    return;
  }
  const Index3 low = edge_of(dims, shared->cell).lower;
  fail(std::next(shared)->mesh, "has triangles between the same cells as mesh " +
                                    std::to_string(shared->mesh) + ", those from (" +
                                    std::to_string(low[0]) + ", " + std::to_string(low[1]) + ", " +
                                    std::to_string(low[2]) + ") on; blocks must be disjoint");
}

}  // namespace

Mesh weld(std::span<const Mesh> meshes, const Grid& grid) {
  std::vector<const Mesh*> pointers;
  pointers.reserve(meshes.size());
  for (const Mesh& mesh : meshes) {
    pointers.push_back(&mesh);
  }
  return weld_pointers(pointers, grid);
}

Mesh weld_pointers(std::span<const Mesh* const> meshes, const Grid& grid) {
  const DefaultFloatEnvironment environment;
  validate(grid);
  check(meshes, grid.dims);

  Mesh result;
  std::vector<std::size_t> ends{0};
  for (const Mesh* mesh : meshes) {
    result.edge_ids.insert(result.edge_ids.end(), mesh->edge_ids.begin(), mesh->edge_ids.end());
    ends.push_back(result.edge_ids.size());
  }
  merge_parts(result.edge_ids, ends, std::less<>());
  result.edge_ids.erase(std::unique(result.edge_ids.begin(), result.edge_ids.end()),
                        result.edge_ids.end());
  if (result.edge_ids.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "weld: the mesh would have " +
                                          std::to_string(result.edge_ids.size()) +
                                          " vertices, more than 2^32 - 1");
  }

  result.positions.resize(result.edge_ids.size());
  std::vector<PlacedTriangle> triangles;
  std::vector<std::size_t> triangle_ends{0};
  std::vector<std::uint32_t> number;
  for (std::size_t part = 0; part < meshes.size(); ++part) {
    const Mesh& mesh = *meshes[part];
    if (!mesh.normals.empty()) {
      result.normals.resize(result.edge_ids.size());
    }
    if (!mesh.positions.empty() && result.scalars.empty()) {
      for (const VertexScalar& scalar : mesh.scalars) {
        result.scalars.push_back({scalar.name, Array<double>(result.edge_ids.size())});
      }
    }
    number.resize(mesh.positions.size());
    auto place = result.edge_ids.cbegin();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      place = find_from(result.edge_ids, place, mesh.edge_ids[v]);
      const auto n = static_cast<std::size_t>(place - result.edge_ids.cbegin());
      number[v] = static_cast<std::uint32_t>(n);
      result.positions[n] = mesh.positions[v];
      if (!mesh.normals.empty()) {
        result.normals[n] = mesh.normals[v];
      }
    }
    for (VertexScalar& scalar : result.scalars) {
      const Array<double>* const values = find_scalar(mesh, scalar.name);
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        scalar.values[number[v]] = (*values)[v];
      }
    }
    for (const Triangle& t : mesh.triangles) {
      const std::array<std::uint64_t, 3> ids{mesh.edge_ids[t[0]], mesh.edge_ids[t[1]],
                                             mesh.edge_ids[t[2]]};
      triangles.push_back({cell_of(ids, grid.dims),
                           {number[t[0]], number[t[1]], number[t[2]]},
                           static_cast<std::uint32_t>(part)});
    }
    triangle_ends.push_back(triangles.size());
  }
  merge_parts(triangles, triangle_ends,
              [](const PlacedTriangle& a, const PlacedTriangle& b) { return a.cell < b.cell; });
  check_disjoint(triangles, grid.dims);
  result.triangles.resize(triangles.size());
  std::transform(triangles.begin(), triangles.end(), result.triangles.begin(),
                 [](const PlacedTriangle& t) { return t.corners; });
  return result;
}

}  // namespace difmesh
