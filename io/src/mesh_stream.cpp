#include "difmesh/io/mesh_stream.hpp"

#include <optional>
#include <string>
#include <string_view>

#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "encoded_file.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"

namespace difmesh {

using namespace detail;

class MeshStream::State {
 public:
  State(const std::filesystem::path& path, const WriteMeshOptions& options)
      : path_(path), options_(options), part_(streamed_format(path, options)), file_(path) {}

  void add(const MeshPortion& portion) {
    check(portion);
    if (!portion.positions.empty() && !encoded_) {
      begin(portion);
    }
    if (encoded_) {  // or there is nothing to add
      encoded_->add(portion);
    }
    start_.vertices += portion.positions.size();
    start_.triangles += portion.triangles.size();
  }

  MeshFileReport finish() {
    if (is_finished_) {
      fail_write(ErrorCode::invalid_argument, path_, "the stream was finished before");
    }
    is_finished_ = true;
    if (!encoded_) {
      begin({});
    }
    return encoded_->finish();
  }

 private:
  static const FormatPart& streamed_format(const std::filesystem::path& path,
                                           const WriteMeshOptions& options) {
    const FormatPart& part = format_to_write(path, options);
    if (part.encoder == nullptr) {
      fail_write(ErrorCode::invalid_argument, path,
                 std::string(part.facts.name) + " cannot be written in portions");
    }
    return part;
  }

  void begin(const MeshPortion& portion) {
    contents_ = contents_of(portion, part_.facts, options_);
    encoded_.emplace(file_, part_.encoder({path_, contents_, false}), std::nullopt);
  }

  void check(const MeshPortion& portion) const {
    if (is_finished_) {
      fail_write(ErrorCode::invalid_argument, path_, "the stream was finished before");
    }
    check_portion(path_, portion, start_,
                  part_.float32_positions ? part_.facts.name : std::string_view());
    if (part_.facts.scalars && options_.scalars) {
      check_scalars(path_, portion.scalars, start_.vertices);
    }
    if (start_.vertices + portion.positions.size() > static_cast<std::size_t>(kMostVertices)) {
      fail_write(ErrorCode::too_large, path_, "more vertices than 32-bit indices can name");
    }
    if (encoded_ && !portion.positions.empty() &&
        contents_of(portion, part_.facts, options_) != contents_) {
      fail_write(ErrorCode::invalid_argument, path_,
                 "the vertices from " + std::to_string(start_.vertices) +
                     " on come with other normals, edge_ids or scalars than those before");
    }
  }

  std::filesystem::path path_;
  WriteMeshOptions options_;
  const FormatPart& part_;
  AtomicFile file_;
  MeshContents contents_;
  std::optional<EncodedFile> encoded_;  ///< from the first portion with vertices on
  PortionStart start_;
  bool is_finished_ = false;
};

MeshStream::MeshStream(const std::filesystem::path& path, const WriteMeshOptions& options)
    : state_(std::make_unique<State>(path, options)) {}
MeshStream::~MeshStream() = default;
MeshStream::MeshStream(MeshStream&&) noexcept = default;
MeshStream& MeshStream::operator=(MeshStream&&) noexcept = default;

void MeshStream::add(const MeshPortion& portion) {
  const DefaultFloatEnvironment environment;
  state_->add(portion);
}

MeshFileReport MeshStream::finish() {
  const DefaultFloatEnvironment environment;
  return state_->finish();
}

}  // namespace difmesh
