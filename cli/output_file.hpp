#pragma once
/// \file output_file.hpp
/// Text files that appear whole or not at all, and early checks of where output goes.

#include <filesystem>
#include <string>

namespace difmesh::cli {

/// Fails now rather than after the work, where a file at that path could not be written (its folder
/// is missing or not writable, or it is a folder itself) or must not be (it is `other`, which the
/// command reads or writes).
/// \param option of the command line that the path was given with
/// \throw Error file_write and CLI::ValidationError
void check_output(const std::string& option, const std::string& path, const std::string& other);

/// Text on its way to a file. The constructor writes it beside the target, commit() gives it the
/// target's name, the destructor removes what was not committed. "-" is standard output; that,
/// devices and pipes are written by commit(). \throw Error file_write, naming the path
class OutputFile {
 public:
  OutputFile(std::filesystem::path target, std::string text);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  void write_temporary();
  void write_all(int descriptor) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty where there is none
  std::string text_;
};

}  // namespace difmesh::cli
