#pragma once
/// \file atomic_file.hpp
/// A file that appears whole or not at all.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

#include "byte_output.hpp"

namespace difmesh::detail {

/// What waits for its place in a file: in memory, or, once it is more than a buffer, in a temporary
/// file without a name. Errors name the file that it is for.
class SpoolFile : public ByteOutput {
 public:
  SpoolFile(std::filesystem::path folder, std::filesystem::path shown)
      : folder_(std::move(folder)), shown_(std::move(shown)) {}
  ~SpoolFile() override;

  /// All that was written. \throw Error file_write
  void copy_to(ByteOutput& output);

 private:
  void open();
  void drain(const char* data, std::size_t bytes) override;

  std::filesystem::path folder_;
  std::filesystem::path shown_;
  int descriptor_ = -1;
};

/// Writes to a new file beside the target; commit() gives it the target's name. Without commit() it
/// is removed. Symbolic links stay and are written through, to a file that is there or not yet:
/// beside that file is where the new one is made. A target that is no regular file (a device, a
/// pipe, standard output) is written directly. Against failures of programs and disks, not against
/// loss of power: nothing is forced to the disk. Every member throws Error file_write, naming the
/// target and the system's reason.
class AtomicFile : public ByteOutput {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile() override;

  /// The last call but for size().
  void commit();
  /// A place for what must wait. Beside the target, or where the system has temporary files for
  /// targets that are written directly.
  [[nodiscard]] std::unique_ptr<SpoolFile> spool() const;

 private:
  void open_direct();
  void open_temporary();
  void drain(const char* data, std::size_t bytes) override;
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_;      ///< as the caller named it
  std::filesystem::path target_;     ///< behind symbolic links
  std::filesystem::path temporary_;  ///< empty if written directly
  int descriptor_ = -1;
};

}  // namespace difmesh::detail
