#pragma once
// Edges between cells of a block, whose windows are solved in batches.

#include <algorithm>
#include <cstdint>

#include "difmesh/edge_id.hpp"
#include "difmesh/mesh.hpp"
#include "planes/kernels.hpp"
#include "planes/unit_plane.hpp"
#include "surface/vertex_placer.hpp"

namespace difmesh::detail {

/// Where vertices go.
class VertexWriter {
 public:
  VertexWriter(const VertexPlacer& placer, Mesh& mesh)
      : field_(placer.grid().field()),
        positions_(mesh.positions.data()),
        normals_(mesh.normals.empty() ? nullptr : mesh.normals.data()),
        edge_ids_(mesh.edge_ids.empty() ? nullptr : mesh.edge_ids.data()) {}

  void write(std::size_t number, const Index3& lower, std::size_t axis,
             const Vec3& position) const {
    positions_[number] = position;
    if (edge_ids_ != nullptr) {
      const Index3& offset = field_.block.offset;
      edge_ids_[number] =
          edge_id(field_.grid.dims,
                  {{lower[0] + offset[0] - 1, lower[1] + offset[1] - 1, lower[2] + offset[2] - 1},
                   static_cast<int>(axis)});
    }
  }
  [[nodiscard]] bool with_normals() const { return normals_ != nullptr; }
  void write_normal(std::size_t number, const Vec3& normal) const { normals_[number] = normal; }

 private:
  const BlockField& field_;
  Vec3* positions_;
  Vec3* normals_;
  std::uint64_t* edge_ids_;
};

/// Solves and writes the vertices of edges between cells. The planes must stay where they are until
/// flush().
class WindowQueue {
 public:
  WindowQueue(const VertexPlacer& placer, const VertexWriter& writer, EdgeCounts& counts)
      : placer_(placer), writer_(writer), counts_(counts), solve_(kernels().solve_windows) {}

  void add(const Index3& node, std::size_t axis, bool upper_inside, std::size_t number,
           const UnitPlane& lower, const UnitPlane& upper) {
    const int n = batch_.count++;
    edges_[n] = {node, axis, number};
    batch_.lower[n] = &lower;
    batch_.upper[n] = &upper;
    batch_.axis[n] = static_cast<std::uint8_t>(axis);
    batch_.sense[n] = upper_inside ? 1.0 : -1.0;
    if (batch_.count == kBatch) {
      flush();
    }
  }

  void flush() {
    if (batch_.count == 0) {
      return;
    }
    for (int n = batch_.count; n < kBatch; ++n) {
      batch_.lower[n] = batch_.lower[0];
      batch_.upper[n] = batch_.upper[0];
      batch_.axis[n] = batch_.axis[0];
      batch_.sense[n] = batch_.sense[0];
    }
    solve_(batch_);
    if (batch_.undone != 0) {
      solve_alone();
    }
    int most_steps = 0;
    for (int n = 0; n < batch_.count; ++n) {
      const auto steps = static_cast<int>(batch_.steps[n]);
      counts_.steps += steps;
      most_steps = std::max(most_steps, steps);
      const Entry& edge = edges_[n];
      const double share = placer_.cleared(batch_.share[n]);
      batch_.share[n] = share;
      writer_.write(edge.number, edge.lower, edge.axis,
                    placer_.position_between_cells(edge.lower, edge.axis, share));
    }
    counts_.solved += batch_.count;
    counts_.most_steps = std::max<std::int64_t>(counts_.most_steps, most_steps);
    for (int n = 0; writer_.with_normals() && n < batch_.count; ++n) {
      writer_.write_normal(
          edges_[n].number,
          placer_.uniform_normal(edges_[n].axis, batch_.sense[n] > 0.0, *batch_.lower[n],
                                 *batch_.upper[n], batch_.share[n]));
    }
    batch_.count = 0;
  }

 private:
  struct Entry {
    Index3 lower;
    std::size_t axis;
    std::size_t number;
  };

  [[nodiscard]] DualEdge edge_of(int n) const {
    return edge_from(edges_[n].lower, edges_[n].axis, batch_.sense[n] > 0.0);
  }

  // The edges that the kernel left.
  void solve_alone() {
    for (int n = 0; n < batch_.count; ++n) {
      if ((batch_.undone >> n & 1) == 0) {
        continue;
      }
      const DualEdge edge = edge_of(n);
      const UnitPlane& lower = *batch_.lower[n];
      const UnitPlane& upper = *batch_.upper[n];
      const WindowRoot root =
          window::solve_examined(placer_.oriented(edge, edge.upper_inside ? lower : upper),
                                 placer_.oriented(edge, edge.upper_inside ? upper : lower),
                                 placer_.algorithm1_start(edge, lower, upper));
      counts_.non_monotone += root.non_monotone ? 1 : 0;
      batch_.share[n] = edge.upper_inside ? root.mu : 1.0 - root.mu;
      batch_.steps[n] = root.steps;
    }
  }

  const VertexPlacer& placer_;
  const VertexWriter& writer_;
  EdgeCounts& counts_;
  void (*solve_)(WindowBatch&);
  WindowBatch batch_{};
  Entry edges_[kBatch];
};

}  // namespace difmesh::detail
