#pragma once
// Edges between cells of a block, whose windows are solved in batches.

#include <cstdint>

#include "difmesh/mesh.hpp"
#include "kernels.hpp"
#include "vertex_placer.hpp"

namespace difmesh::detail {

/// Mesh::edge_ids.
[[nodiscard]] inline std::uint64_t edge_id(const BlockField& field, const Index3& node,
                                           std::size_t axis) {
  std::uint64_t number = 0;
  for (std::size_t t = 3; t-- > 0;) {
    number = number * static_cast<std::uint64_t>(field.grid.dims[t] + 2) +
             static_cast<std::uint64_t>(node[t] + field.block.offset[t]);
  }
  return 3 * number + axis;
}

/// Where the vertices of a row go.
class VertexWriter {
 public:
  VertexWriter(const VertexPlacer& placer, Mesh& mesh) : placer_(placer), mesh_(mesh) {}

  void write(std::size_t number, const DualEdge& edge, double share, const Vec3& position) {
    mesh_.positions[number] = position;
    if (!mesh_.normals.empty()) {
      mesh_.normals[number] = placer_.normal(edge, share);
    }
    if (!mesh_.edge_ids.empty()) {
      mesh_.edge_ids[number] = edge_id(placer_.grid().field(), edge.lower, edge.axis);
    }
  }

 private:
  const VertexPlacer& placer_;
  Mesh& mesh_;
};

/// Solves and writes the vertices of edges. The planes must stay where they are until flush().
class WindowQueue {
 public:
  WindowQueue(const VertexPlacer& placer, VertexWriter& writer, EdgeCounts& counts)
      : placer_(placer), writer_(writer), counts_(counts), solve_(kernels().solve_windows) {}

  void add(const Index3& node, std::size_t axis, bool upper_inside, std::size_t number,
           const UnitPlane& lower, const UnitPlane& upper) {
    const int n = batch_.count++;
    edges_[n] = {node, axis, number, &lower, &upper, upper_inside};
    const bool outer_pure = put(axis, upper_inside, upper_inside ? lower : upper, batch_.outer, n);
    const bool inner_pure = put(axis, upper_inside, upper_inside ? upper : lower, batch_.inner, n);
    batch_.pure |= static_cast<unsigned>(outer_pure || inner_pure) << n;
    if (batch_.count == kBatch) {
      flush();
    }
  }

  void flush() {
    if (batch_.count == 0) {
      return;
    }
    // Lanes without an edge repeat the first.
    for (int n = batch_.count; n < kBatch; ++n) {
      for (int t = 0; t < 4; ++t) {
        batch_.outer[t][n] = batch_.outer[t][0];
        batch_.inner[t][n] = batch_.inner[t][0];
      }
    }
    solve_(batch_);
    for (int n = 0; n < batch_.count; ++n) {
      finish(n);
    }
    batch_.count = 0;
    batch_.pure = 0;
  }

 private:
  struct Entry {
    Index3 node;  // the lower one
    std::size_t axis;
    std::size_t number;
    const UnitPlane* lower;
    const UnitPlane* upper;
    bool upper_inside;
  };

  // The plane as EdgePlane has it; returns whether it is pure.
  static bool put(std::size_t axis, bool upper_inside, const UnitPlane& plane,
                  double (&of)[4][kBatch], int n) {
    constexpr std::size_t kNext[4] = {1, 2, 0, 1};
    of[3][n] = plane.a;
    of[1][n] = plane.m[kNext[axis]];
    of[2][n] = plane.m[kNext[axis + 1]];
    const double along = plane.m[axis];
    of[0][n] = upper_inside ? along : -along;
    if (plane.has_normal()) {
      return false;
    }
    const bool is_pure = std::abs(plane.a) >= 0.5;
    of[0][n] = is_pure ? 0.0 : -1.0;
    return is_pure;
  }

  void finish(int n) {
    const Entry& entry = edges_[n];
    DualEdge edge{entry.node, entry.node, entry.axis, entry.upper_inside};
    ++edge.upper[entry.axis];
    WindowRoot root{batch_.mu[n], static_cast<int>(batch_.steps[n]), false};
    if ((batch_.undone >> n & 1) != 0) {
      const UnitPlane& outer = edge.upper_inside ? *entry.lower : *entry.upper;
      const UnitPlane& inner = edge.upper_inside ? *entry.upper : *entry.lower;
      root = window::solve_examined(placer_.oriented(edge, outer), placer_.oriented(edge, inner),
                                    placer_.algorithm1_start(edge, *entry.lower, *entry.upper));
    }
    counts_.add(root);
    const double share = placer_.cleared(edge.upper_inside ? root.mu : 1.0 - root.mu);
    writer_.write(entry.number, edge, share, placer_.position_between_cells(edge, share));
  }

  const VertexPlacer& placer_;
  VertexWriter& writer_;
  EdgeCounts& counts_;
  void (*solve_)(WindowBatch&);
  WindowBatch batch_{};
  Entry edges_[kBatch];
};

}  // namespace difmesh::detail
