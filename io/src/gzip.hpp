#pragma once
/// \file gzip.hpp
/// gzip streams over files.

#include <cstddef>
#include <cstdint>
#include <memory>

#include "atomic_file.hpp"
#include "input_file.hpp"

namespace difmesh::detail {

/// Inflates the stream that starts at `offset` into exactly `bytes` bytes after the first `skip`;
/// several members in a row count as one, and what follows the last is ignored, as gzip does.
/// \throw Error file_format if the stream is damaged, shorter or longer.
void inflate_file(const InputFile& file, std::int64_t offset, std::int64_t skip, std::byte* to,
                  std::int64_t bytes);

/// Inflates the stream that starts at `offset` and keeps its last `bytes` bytes, which follow at
/// most `most_before` others. \throw Error likewise
void inflate_end_of_file(const InputFile& file, std::int64_t offset, std::int64_t most_before,
                         std::byte* to, std::int64_t bytes);

/// The most bytes that `compressed` bytes of deflate can become.
[[nodiscard]] std::int64_t most_inflated(std::int64_t compressed);

/// Deflates what is written to it into a file, as one member without name and time, so that the
/// same data give the same bytes.
class GzipWriter {
 public:
  GzipWriter(AtomicFile& file, int level);
  ~GzipWriter();
  void write(const std::byte* data, std::size_t bytes);
  /// The last call.
  void finish();

 private:
  struct Stream;
  void deflate_all(int flush);
  AtomicFile& file_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace difmesh::detail
