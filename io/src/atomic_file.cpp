#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;
constexpr std::size_t kLongestNumber = 32;
constexpr int kMostLinks = 40;  // as many as Linux follows

/// Names of streams that are already open. They may lead to regular files, which must be appended
/// to where they stand and not be replaced.
bool names_open_stream(const std::filesystem::path& path) {
  const std::string name = path.lexically_normal().string();
  return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/");
}

/// The file behind symbolic links, which need not be there yet: a link stays a link when its file is
/// written. Links among the folders are left to the system; so is an endless chain, which it refuses.
/// Open streams are links too, which end the way.
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

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target)
    : shown_(target), target_(behind_links(target)), buffer_(kBufferSize) {
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
  // Not mkstemp(): its files are readable by their owner only, whatever the umask says.
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name = ".";
    name += target_.filename().string().substr(0, 200);
    name += '.';
    name += std::to_string(random());
    name += ".part";
    std::filesystem::path path = target_.parent_path() / name;
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      temporary_ = std::move(path);  // cannot fail, or the file would be left behind
      return;
    }
    if (errno != EEXIST) {
      fail(errno);
    }
  }
  fail(EEXIST);
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  while (bytes > 0) {
    make_room(1);
    const std::size_t part = std::min(bytes, buffer_.size() - used_);
    std::memcpy(buffer_.data() + used_, from, part);
    used_ += part;
    from += part;
    bytes -= part;
  }
}

void AtomicFile::write_number(double number) {
  make_room(kLongestNumber);
  const auto result =
      std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), number);
  used_ = static_cast<std::size_t>(result.ptr - buffer_.data());
}

void AtomicFile::write_number(std::uint64_t number) {
  make_room(kLongestNumber);
  const auto result =
      std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), number);
  used_ = static_cast<std::size_t>(result.ptr - buffer_.data());
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

void AtomicFile::make_room(std::size_t bytes) {
  if (buffer_.size() - used_ < bytes) {
    flush();
  }
}

void AtomicFile::flush() {
  for (std::size_t done = 0; done < used_;) {
    const ::ssize_t written = ::write(descriptor_, buffer_.data() + done, used_ - done);
    if (written < 0 && errno != EINTR) {
      fail(errno);
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  flushed_ += static_cast<std::int64_t>(used_);
  used_ = 0;
}

void AtomicFile::fail(int error) const {
  throw Error(ErrorCode::file_write,
              "cannot write " + quoted(shown_) + ": " + std::generic_category().message(error));
}

}  // namespace difmesh::detail
