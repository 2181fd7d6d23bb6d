#pragma once
/// \file encoded_file.hpp
/// The file that a MeshEncoder fills.

#include <memory>
#include <optional>

#include "atomic_file.hpp"
#include "mesh_encoder.hpp"
#include "sections.hpp"

namespace difmesh::detail {

class EncodedFile {
 public:
  /// \param counts of the whole mesh, where they are known: then nothing has to wait that comes in
  ///   the order of the file
  EncodedFile(AtomicFile& file, std::unique_ptr<MeshEncoder> encoder,
              const std::optional<MeshCounts>& counts);

  void add(const MeshPortion& portion);
  MeshFileReport finish();

 private:
  AtomicFile& file_;
  std::unique_ptr<MeshEncoder> encoder_;
  Sections sections_;
  std::optional<MeshCounts> known_;
  MeshCounts counts_;  ///< so far
};

}  // namespace difmesh::detail
