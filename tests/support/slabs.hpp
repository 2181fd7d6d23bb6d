#pragma once
/// \file slabs.hpp
/// Reconstruction of a field slab by slab.

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "difmesh/surface_builder.hpp"
#include "support/fields.hpp"

namespace difmesh::test {

/// Appends what comes, and demands that no triangle names a vertex that has not come.
class Collector {
 public:
  void operator()(const MeshPortion& portion) {
    const auto append = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    append(mesh_.positions, portion.positions);
    append(mesh_.normals, portion.normals);
    append(mesh_.edge_ids, portion.edge_ids);
    for (const Triangle& triangle : portion.triangles) {
      for (const std::uint32_t corner : triangle) {
        REQUIRE(corner < mesh_.positions.size());
      }
    }
    append(mesh_.triangles, portion.triangles);
  }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

 private:
  Mesh mesh_;
};

/// The field of a view given to a builder in slabs, cut before these layers. Each slab is gone when
/// the next one comes.
inline Reconstruction in_slabs(const FieldView& view, const Grid& grid, const Options& options,
                               std::vector<std::int64_t> cuts, const BuilderOptions& how) {
  Collector collector;
  SurfaceBuilder builder(
      grid, options, [&](const MeshPortion& portion) { collector(portion); }, how);
  cuts.push_back(view.dims[2]);
  std::int64_t from = 0;
  for (const std::int64_t to : cuts) {
    const OwnedField slab =
        copy_of(view.sub({0, 0, from}, {view.dims[0], view.dims[1], to - from}));
    builder.add(slab.view());
    from = to;
  }
  CHECK(builder.missing_layers() == 0);
  Reconstruction built;
  built.report = builder.finish();
  built.mesh = collector.mesh();
  return built;
}

/// The same in slabs of equal thickness, the last excepted.
inline Reconstruction in_slabs(const FieldView& view, const Grid& grid, const Options& options,
                               std::int64_t thickness, std::int64_t at_once = 1) {
  std::vector<std::int64_t> cuts;
  for (std::int64_t at = thickness; at < view.dims[2]; at += thickness) {
    cuts.push_back(at);
  }
  BuilderOptions how;
  how.layers_at_once = at_once;
  return in_slabs(view, grid, options, cuts, how);
}

}  // namespace difmesh::test
