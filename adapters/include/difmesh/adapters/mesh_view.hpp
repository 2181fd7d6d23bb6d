#pragma once
/// \file mesh_view.hpp
/// What the adapters to mesh libraries read from and what they tell. Types only: nothing of difmesh
/// has to be linked. For meshes of libdifmesh see c_mesh.hpp.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh {

/// A view of a VertexScalar.
struct ScalarView {
  std::string name;                     ///< becomes the property "v:" + name
  std::span<const double> values = {};  ///< one per vertex
};

/// A triangle mesh in memory that others own: a Mesh, a C `dif_mesh` (c_mesh.hpp), or arrays of any
/// origin, which need be neither manifold nor well oriented. Valid as long as these are neither
/// changed nor freed.
struct MeshView {
  const double* positions = nullptr;        ///< x, y, z per vertex, in the unit of the grid
  std::int64_t vertices = 0;                ///< how many
  const std::uint32_t* indices = nullptr;   ///< three per triangle, counter-clockwise from outside
  std::int64_t triangles = 0;               ///< how many
  const double* normals = nullptr;          ///< null, or x, y, z per vertex
  const std::uint64_t* edge_ids = nullptr;  ///< null, or one per vertex; see Mesh::edge_ids
  std::vector<ScalarView> scalars = {};     ///< of different names

  MeshView() = default;

  /// \throw Error invalid_argument if normals or edge_ids are neither empty nor one per vertex.
  MeshView(const Mesh& mesh)  // NOLINT(google-explicit-constructor): any mesh is a view
      : vertices(static_cast<std::int64_t>(mesh.positions.size())),
        triangles(static_cast<std::int64_t>(mesh.triangles.size())) {
    const auto check = [&mesh](std::size_t size, const char* name) {
      if (size != 0 && size != mesh.positions.size()) {
        throw Error(ErrorCode::invalid_argument,
                    std::string(name) + " holds " + std::to_string(size) + " entries for " +
                        std::to_string(mesh.positions.size()) + " vertices");
      }
      return size != 0;
    };
    positions = vertices == 0 ? nullptr : mesh.positions.front().data();
    indices = triangles == 0 ? nullptr : mesh.triangles.front().data();
    normals = check(mesh.normals.size(), "normals") ? mesh.normals.front().data() : nullptr;
    edge_ids = check(mesh.edge_ids.size(), "edge_ids") ? mesh.edge_ids.data() : nullptr;
    for (const VertexScalar& scalar : mesh.scalars) {
      scalars.push_back({scalar.name, scalar.values});
    }
  }
};

/// What comes along with the positions and triangles.
struct ImportOptions {
  bool normals = true;   ///< normals, where the mesh has them
  bool edge_ids = true;  ///< names of dual edges, where the mesh has them
  bool scalars = true;   ///< scalars, where the mesh has them
};

/// Why a face was refused. A mesh of reconstruct() loses none.
enum class Refusal : std::uint8_t {
  index_out_of_range,  ///< an index is no vertex
  degenerate,          ///< an index comes twice
  /// Another face runs along an edge the same way: three faces on an edge, a face flipped or twice.
  /// Of those in conflict the one with most such edges goes, of equals the last.
  edge_taken,
  /// The faces round a vertex are not one fan: a bow-tie. The largest fan stays, of equals the one
  /// with the first face.
  vertex_taken,
};

struct RefusedFace {
  std::int64_t triangle = 0;  ///< its index in the source
  Refusal reason = Refusal::degenerate;
};

/// Facts about one import. Faces keep their order, so that the n-th face that was not refused is
/// the n-th new one.
struct ImportReport {
  std::int64_t vertices = 0;              ///< added; all of the source, those without a face too
  std::int64_t edges = 0;                 ///< added
  std::int64_t faces = 0;                 ///< added
  std::vector<RefusedFace> refused = {};  ///< by ascending triangle
};

/// A new mesh of the library asked for, and the facts.
template <class LibraryMesh>
struct Import {
  LibraryMesh mesh;
  ImportReport report;
};

}  // namespace difmesh
