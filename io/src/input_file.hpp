#pragma once
/// \file input_file.hpp
/// A regular file, open for reading, whose size is known.

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "difmesh/mesh.hpp"

namespace difmesh::detail {

class InputFile {
 public:
  /// \throw Error file_missing with the system's reason; file_format if it is no regular file, or
  ///   a pointer that Git LFS or git-annex left in the place of one.
  explicit InputFile(const std::filesystem::path& path);
  /// Takes an open descriptor over. `path` is for messages. \throw Error file_format as above
  InputFile(std::filesystem::path path, int descriptor);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::int64_t size() const { return size_; }
  /// Fills `to` from [offset, offset + bytes). \throw Error file_format if the file ends before.
  void read(std::int64_t offset, void* to, std::int64_t bytes) const;
  /// The bytes [offset, offset + bytes), as far as the file reaches.
  [[nodiscard]] Array<char> read_text(std::int64_t offset, std::int64_t bytes) const;

 private:
  struct Adopted {};
  InputFile(std::filesystem::path path, int descriptor, Adopted);

  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;
};

}  // namespace difmesh::detail
