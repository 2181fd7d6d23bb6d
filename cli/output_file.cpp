#include "output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <iostream>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"

namespace difmesh::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 100;
constexpr int kMostLinks = 40;  // as many as Linux follows

[[noreturn]] void fail_write(const fs::path& path, int error) {
  throw Error(ErrorCode::file_write,
              "cannot write '" + path.string() + "': " + std::generic_category().message(error));
}

/// Names of streams that are already open: what they lead to must not be replaced.
bool names_open_stream(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/");
}

/// The file behind symbolic links, which need not be there yet: a link stays a link when its file
/// is written. Links among the folders are left to the system; so is an endless chain, which it
/// refuses. Open streams are links too, which end the way.
fs::path behind_links(fs::path path) {
  std::error_code error;
  for (int links = 0; links < kMostLinks && !names_open_stream(path); ++links) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) {
      break;
    }
    path = path.parent_path() / next;  // `next` alone where that is absolute
  }
  return path;
}

/// Devices and pipes cannot be replaced by a file beside them.
bool is_written_directly(const fs::path& path) {
  struct stat status {};
  return names_open_stream(behind_links(path)) ||
         (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode));
}

void check_writable(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      fail_write(path, EISDIR);
    }
    if (::access(path.c_str(), W_OK) != 0) {
      fail_write(path, errno);
    }
    if (!S_ISREG(status.st_mode)) {
      return;
    }
  } else if (errno != ENOENT) {
    fail_write(path, errno);
  }
  const fs::path folder = behind_links(path).parent_path();
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) {
    fail_write(path, errno);
  }
}

/// Whether both lead to one file, whether or not it exists yet.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const bool equivalent = fs::equivalent(a, b, error);
  const auto place = [&error](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(behind_links(path), error), error);
  };
  return error ? place(a) == place(b) : equivalent;
}

}  // namespace

void check_output(const std::string& option, const std::string& path, const std::string& other) {
  if (path == "-") {
    return;
  }
  if (same_file(path, other)) {
    throw CLI::ValidationError(option, "'" + path + "' is named for two things at once");
  }
  check_writable(path);
}

OutputFile::OutputFile(fs::path target, std::string text)
    : target_(std::move(target)), text_(std::move(text)) {
  if (target_ != "-" && !is_written_directly(target_)) {
    target_ = behind_links(target_);
    write_temporary();
  }
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
  }
}

void OutputFile::commit() {
  if (!temporary_.empty()) {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
      fail(errno);
    }
    temporary_.clear();
    return;
  }
  if (target_ == "-") {
    std::cout << text_;  // main() sees to the end of standard output
    return;
  }
  const int descriptor = ::open(target_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) {
    fail(errno);
  }
  write_all(descriptor);
}

void OutputFile::fail(int error) const {
  fail_write(target_, error);
}

void OutputFile::write_temporary() {
  const std::string start =
      "." + target_.filename().string().substr(0, 200) + "." + std::to_string(::getpid()) + ".";
  fs::path name = target_;
  int descriptor = -1;
  // Names are taken only where a program of the same number died before it could tidy up.
  for (int attempt = 0; attempt < kAttempts && descriptor < 0; ++attempt) {
    name.replace_filename(start + std::to_string(attempt) + ".part");
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) {
      break;
    }
  }
  if (descriptor < 0) {
    fail(errno);
  }
  temporary_ = name;
  try {
    write_all(descriptor);
  } catch (...) {
    ::unlink(temporary_.c_str());  // no destructor runs for what was not constructed
    throw;
  }
}

/// Writes the text and closes.
void OutputFile::write_all(int descriptor) const {
  int error = 0;
  for (std::size_t done = 0; done < text_.size() && error == 0;) {
    const ::ssize_t written = ::write(descriptor, text_.data() + done, text_.size() - done);
    if (written >= 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (::close(descriptor) != 0 && error == 0) {
    error = errno;
  }
  if (error != 0) {
    fail(error);
  }
}

}  // namespace difmesh::cli
