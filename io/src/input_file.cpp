#include "input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"
#include "text.hpp"

namespace difmesh::detail {

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  // O_NONBLOCK: opening a pipe without a writer would wait for ever.
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) {
    throw Error(ErrorCode::file_missing,
                "cannot open " + quoted(path_) + ": " + std::generic_category().message(errno));
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    fail_format(path_, "not a regular file");
  }
  size_ = status.st_size;
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

void InputFile::read(std::int64_t offset, void* to, std::int64_t bytes) const {
  auto* place = static_cast<char*>(to);
  for (std::int64_t done = 0; done < bytes;) {
    const auto part = static_cast<std::size_t>(std::min<std::int64_t>(bytes - done, 1 << 30));
    const ::ssize_t got = ::pread(descriptor_, place + done, part, offset + done);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      fail_format(path_, "cannot be read: " + std::generic_category().message(errno));
    }
    if (got == 0) {
      fail_format(path_, "truncated: " + std::to_string(offset + bytes) + " bytes wanted, " +
                             std::to_string(offset + done) + " found");
    }
    done += got;
  }
}

Array<char> InputFile::read_text(std::int64_t offset, std::int64_t bytes) const {
  Array<char> text(
      static_cast<std::size_t>(std::max<std::int64_t>(0, std::min(bytes, size_ - offset))));
  read(offset, text.data(), static_cast<std::int64_t>(text.size()));
  return text;
}

}  // namespace difmesh::detail
