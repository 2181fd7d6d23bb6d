#include "encoded_file.hpp"

#include <utility>

namespace difmesh::detail {

EncodedFile::EncodedFile(AtomicFile& file, std::unique_ptr<MeshEncoder> encoder,
                         const std::optional<MeshCounts>& counts)
    : file_(file),
      encoder_(std::move(encoder)),
      sections_(file_, encoder_->vertex_sections() + 2),
      known_(counts) {
  if (known_) {
    encoder_->header(sections_.at(0), *known_);
    sections_.close(0);
  }
}

void EncodedFile::add(const MeshPortion& portion) {
  counts_.vertices += portion.positions.size();
  counts_.triangles += portion.triangles.size();
  const std::size_t vertex_sections = encoder_->vertex_sections();
  for (std::size_t section = 0; section < vertex_sections; ++section) {
    encoder_->vertices(sections_.at(section + 1), section, portion);
    if (known_ && counts_.vertices == known_->vertices) {
      sections_.close(section + 1);
    }
  }
  encoder_->triangles(sections_.at(vertex_sections + 1), portion);
}

MeshFileReport EncodedFile::finish() {
  if (!known_) {
    encoder_->header(sections_.at(0), counts_);
  }
  for (std::size_t section = 0; section < encoder_->vertex_sections() + 2; ++section) {
    sections_.close(section);
  }
  MeshFileReport report{.vertices = static_cast<std::int64_t>(counts_.vertices),
                        .triangles = static_cast<std::int64_t>(counts_.triangles),
                        .primitives = 1};
  encoder_->complete(report);  // which may run out of memory: before there is a file
  file_.commit();
  report.bytes = file_.size();
  return report;
}

}  // namespace difmesh::detail
