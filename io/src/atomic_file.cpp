#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr int kMostLinks = 40;  // as many as Linux follows

/// Names of streams that are already open. They may lead to regular files, which must be appended
/// to where they stand and not be replaced.
bool names_open_stream(const std::filesystem::path& path) {
  const std::string name = path.lexically_normal().string();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/");
}

/// The file behind symbolic links, which need not be there yet: a link stays a link when its file
/// is written. Links among the folders are left to the system; so is an endless chain, which it
/// refuses. Open streams are links too, which end the way.
std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code error;
  for (int links = 0; links < kMostLinks && !names_open_stream(path); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    if (error) {
      break;
    }
    path = path.parent_path() / next;  // `next` alone where that is absolute
  }
  return path;
}

[[noreturn]] void fail_for(const std::filesystem::path& shown, int error) {
  throw Error(ErrorCode::file_write,
              "cannot write " + quoted(shown) + ": " + std::generic_category().message(error));
}

void write_all(int descriptor, const char* data, std::size_t bytes,
               const std::filesystem::path& shown) {
  for (std::size_t done = 0; done < bytes;) {
    const ::ssize_t written = ::write(descriptor, data + done, bytes - done);
    if (written < 0 && errno != EINTR) {
      fail_for(shown, errno);
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
}

/// A new file with a name like `name` that no other has, put into `path`.
/// \return its descriptor, or -1 with errno
int open_new(const std::filesystem::path& folder, const std::string& name, int access,
             std::filesystem::path& path) {
  // Not mkstemp(): its files are readable by their owner only, whatever the umask says.
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string hidden = ".";
    hidden += name.substr(0, 200);
    hidden += '.';
    hidden += std::to_string(random());
    hidden += ".part";
    std::filesystem::path tried = folder / hidden;
    const int descriptor = ::open(tried.c_str(), access | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      path = std::move(tried);  // cannot fail, or the file would be left behind
    }
    if (descriptor >= 0 || errno != EEXIST) {
      return descriptor;
    }
  }
  return -1;
}

}  // namespace

SpoolFile::~SpoolFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void SpoolFile::open() {
  std::filesystem::path path;
  descriptor_ = open_new(folder_, shown_.filename().string(), O_RDWR, path);
  if (descriptor_ < 0 || ::unlink(path.c_str()) != 0) {
    fail_for(shown_, errno);
  }
}

void SpoolFile::drain(const char* data, std::size_t bytes) {
  if (descriptor_ < 0) {
    open();
  }
  write_all(descriptor_, data, bytes, shown_);
}

void SpoolFile::copy_to(ByteOutput& output) {
  if (descriptor_ < 0) {
    output.write(waiting());
    return;
  }
  flush();
  std::vector<char> piece(kBufferSize);
  for (std::int64_t done = 0; done < size();) {
    const ::ssize_t read = ::pread(descriptor_, piece.data(), piece.size(), done);
    if (read == 0 || (read < 0 && errno != EINTR)) {
      fail_for(shown_, read == 0 ? EIO : errno);
    }
    output.write(piece.data(), read > 0 ? static_cast<std::size_t>(read) : 0);
    done += std::max<::ssize_t>(read, 0);
  }
}

AtomicFile::AtomicFile(const std::filesystem::path& target)
    : shown_(target), target_(behind_links(target)) {
  struct stat status {};
  const int obstacle = ::stat(shown_.c_str(), &status) == 0 ? 0 : errno;
  const bool exists = obstacle == 0;
  if (names_open_stream(target_) ||
      (exists && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))) {
    target_ = shown_;
    open_direct();
    return;
  }
  if (!exists && obstacle != ENOENT) {
    fail(obstacle);
  }
  if (exists && S_ISDIR(status.st_mode)) {
    fail(EISDIR);
  }
  if (exists && ::access(target_.c_str(), W_OK) != 0) {
    fail(errno);
  }
  open_temporary();
  if (exists) {
    // Best effort: file systems without modes refuse it, and nothing is lost there.
    (void)!::fchmod(descriptor_, status.st_mode & 0777);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
  }
}

void AtomicFile::open_direct() {
  // Appending: a redirected standard output may hold something already.
  descriptor_ = ::open(target_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) {
    fail(errno);
  }
}

void AtomicFile::open_temporary() {
  descriptor_ = open_new(target_.parent_path(), target_.filename().string(), O_WRONLY, temporary_);
  if (descriptor_ < 0) {
    fail(errno);
  }
}

std::unique_ptr<SpoolFile> AtomicFile::spool() const {
  std::error_code error;
  const bool is_direct = temporary_.empty();
  const std::filesystem::path folder =
      is_direct ? std::filesystem::temp_directory_path(error) : target_.parent_path();
  return std::make_unique<SpoolFile>(folder, shown_);
}

void AtomicFile::commit() {
  flush();
  const int closing = std::exchange(descriptor_, -1);
  if (::close(closing) != 0) {
    fail(errno);
  }
  if (!temporary_.empty()) {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
      fail(errno);
    }
    temporary_.clear();
  }
}

void AtomicFile::drain(const char* data, std::size_t bytes) {
  write_all(descriptor_, data, bytes, shown_);
}

void AtomicFile::fail(int error) const {
  fail_for(shown_, error);
}

}  // namespace difmesh::detail
