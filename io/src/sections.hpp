#pragma once
/// \file sections.hpp
/// Fills the sections of a file at the same time.

#include <cstddef>
#include <memory>
#include <vector>

#include "atomic_file.hpp"

namespace difmesh::detail {

/// What cannot be written in its place yet, as a section before is not complete, waits in a spool.
class Sections {
 public:
  Sections(AtomicFile& file, std::size_t count) : file_(file), parts_(count) {}

  /// Where the next bytes of a section go. Valid until the next call.
  [[nodiscard]] ByteOutput& at(std::size_t section);
  /// Says that nothing follows in a section, which may be said again.
  void close(std::size_t section);

 private:
  struct Part {
    std::unique_ptr<SpoolFile> spool = {};
    bool is_closed = false;
  };

  AtomicFile& file_;
  std::vector<Part> parts_;
  std::size_t current_ = 0;  ///< the first section that is not closed: it goes into the file
};

}  // namespace difmesh::detail
