#include "input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"
#include "memory.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

int open_for_reading(const std::filesystem::path& path) {
  // O_NONBLOCK: opening a pipe without a writer would wait for ever.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    throw Error(ErrorCode::file_missing,
                "cannot open " + quoted(path) + ": " + std::generic_category().message(errno));
  }
  return descriptor;
}

/// What Git LFS and git-annex leave in the place of a large file; neither writes more than this.
constexpr std::int64_t kLargestPointer = 1024;

/// Of the program that left a pointer with this text, or nullptr.
const char* pointer_program(std::string_view text) {
  if (text.starts_with("version https://git-lfs.github.com/spec/") ||
      text.starts_with("version https://hawser.github.com/spec/")) {
    return "Git LFS";
  }
  return text.starts_with("/annex/objects/") ? "git-annex" : nullptr;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : InputFile(path, open_for_reading(path)) {}

// By way of another constructor, so that what is thrown here has the descriptor closed.
InputFile::InputFile(std::filesystem::path path, int descriptor)
    : InputFile(std::move(path), descriptor, Adopted{}) {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    fail_format(path_, "not a regular file");
  }
  size_ = status.st_size;
  // Whatever the format: that it is none of it would say less.
  if (size_ <= kLargestPointer) {
    const Array<char> text = read_text(0, size_);
    if (const char* const program = pointer_program({text.data(), text.size()})) {
      fail_format(path_, std::string("a pointer of ") + program +
                             " to a file that is kept elsewhere, not the file itself");
    }
  }
}

InputFile::InputFile(std::filesystem::path path, int descriptor, Adopted)
    : path_(std::move(path)), descriptor_(descriptor) {}

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
  Array<char> text;
  make_room(path_, text, std::max<std::int64_t>(0, std::min(bytes, size_ - offset)));
  read(offset, text.data(), static_cast<std::int64_t>(text.size()));
  return text;
}

}  // namespace difmesh::detail
