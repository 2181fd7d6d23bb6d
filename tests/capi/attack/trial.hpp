#pragma once
/// \file trial.hpp
/// One attack: reconstructs a specimen in several ways and holds the results against what is
/// promised and against each other.

#include "finding.hpp"
#include "judge.hpp"
#include "specimen.hpp"

namespace difmesh::attack {

/// Keeps its memory from one specimen to the next. Changes the library's instruction set.
class Trial {
 public:
  /// The first thing that is wrong. Fields with values out of bounds must be refused; see Judge for
  /// what holds of others. Another instruction set with other threads, and the specimen's blocks,
  /// welded, must give the same bits, and so must, where `variants` says so,
  /// - kWithoutGaps: the same elements without gaps in memory, x fastest;
  /// - kWithoutNormals: a mesh that was not to have normals and edge ids;
  /// - kWithProgress: the other threads, reporting progress;
  /// - kInFloat64: the same fractions in float64;
  /// - kOtherFloats: a caller with another rounding mode, whose settings and flags stay.
  /// kMeasured: dif_mesh_measure() must agree. kOpenFaces: nodes of open faces must be inside where
  /// the planes of dif_cell_planes() say so.
  [[nodiscard]] Finding run(const Specimen& specimen);

  /// The surface of the last specimen; null where it was refused.
  [[nodiscard]] const dif_mesh* mesh() const { return mesh_.get(); }
  [[nodiscard]] const dif_report& report() const { return report_; }
  [[nodiscard]] std::uint64_t triangles() const { return surface_.triangles.size() / 3; }

 private:
  [[nodiscard]] Finding check_refusal(const Specimen& specimen, dif_status status) const;
  [[nodiscard]] Finding check_variants(const Specimen& specimen, const dif_field& field);
  [[nodiscard]] Finding check_float64(const Specimen& specimen);
  [[nodiscard]] Finding check_other_floats(const Specimen& specimen, const dif_field& field) const;
  [[nodiscard]] Finding check_bare(const dif_field& field, const dif_options& options) const;
  [[nodiscard]] Finding check_blocks(const Specimen& specimen);
  [[nodiscard]] Finding check_measure() const;
  [[nodiscard]] Finding check_open_faces(const Specimen& specimen, const dif_field& field) const;

  Elements elements_;
  Elements others_;
  Judge judge_;
  MeshHandle mesh_;
  Surface surface_;
  dif_report report_{};
};

}  // namespace difmesh::attack
