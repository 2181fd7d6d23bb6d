#pragma once
/// \file atomic_file.hpp
/// A file that appears whole or not at all.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace difmesh::detail {

/// Writes to a new file beside the target; commit() gives it the target's name. Without commit() it
/// is removed. Symbolic links stay and are written through, to a file that is there or not yet: beside
/// that file is where the new one is made. A target that is no regular file (a device, a pipe, standard output) is written
/// directly. Against failures of programs and disks, not against loss of power: nothing is forced
/// to the disk. Every member throws Error file_write, naming the target and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Shortest decimal form that reads as the same number.
  void write_number(double number);
  void write_number(std::uint64_t number);
  /// The last call but for size().
  void commit();
  /// Bytes written so far.
  [[nodiscard]] std::int64_t size() const { return flushed_ + static_cast<std::int64_t>(used_); }

 private:
  void open_direct();
  void open_temporary();
  void make_room(std::size_t bytes);
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_;      ///< as the caller named it
  std::filesystem::path target_;     ///< behind symbolic links
  std::filesystem::path temporary_;  ///< empty if written directly
  int descriptor_ = -1;
  std::int64_t flushed_ = 0;
  std::size_t used_ = 0;
  std::vector<char> buffer_;
};

}  // namespace difmesh::detail
