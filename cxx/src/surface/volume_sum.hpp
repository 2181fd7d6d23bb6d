#pragma once
// The volume inside a mesh that comes in parts.

#include <cstdint>

#include "base/parallel.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::detail {

/// Sums what lies between triangles and a level in z, which is the volume inside once they close a
/// surface (divergence theorem). The same triangles in the same order give the same bits, in
/// however many meshes and on however many threads.
class VolumeSum {
 public:
  /// \param level near the mesh: what is summed is as small as its heights above the level
  explicit VolumeSum(double level) : level_(level) {}

  /// \pre indices of the triangles are those of the mesh's own positions
  void add(const Mesh& mesh, Phases& phases);
  [[nodiscard]] double value() const { return (closed_ + open_) / 6.0; }

 private:
  // Triangles that are summed by themselves.
  static constexpr std::int64_t kPortion = 8192;

  [[nodiscard]] double sum(const Mesh& mesh, std::int64_t begin, std::int64_t end,
                           double start) const;

  double level_;
  double closed_ = 0.0;  // of complete portions
  double open_ = 0.0;    // of the portion that the next triangles go on with
  std::int64_t in_open_ = 0;
};

}  // namespace difmesh::detail
