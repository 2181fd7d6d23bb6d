#include "linked_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <system_error>
#include <utility>

#include "difmesh/error.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

#ifdef O_PATH
constexpr int kPassThrough = O_PATH;  // folders that may be searched but not listed
#else
constexpr int kPassThrough = O_RDONLY;
#endif

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void reset(int number) {
    if (number_ >= 0) {
      ::close(number_);
    }
    number_ = number;
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

[[noreturn]] void fail_missing(const std::filesystem::path& file, int error) {
  throw Error(ErrorCode::file_missing,
              "cannot open " + quoted(file) + ": " + std::generic_category().message(error));
}

[[noreturn]] void fail_outside(const std::filesystem::path& path, const std::filesystem::path& name,
                               const std::string& why) {
  fail_format(path, "it names the file " + quoted(name) + ", which " + why +
                        "; files outside its folder are read only where that is allowed");
}

}  // namespace

std::string why_outside(const std::filesystem::path& name) {
  const std::filesystem::path normal = name.lexically_normal();
  if (name.is_absolute()) {
    return "is absolute";
  }
  return !normal.empty() && *normal.begin() == ".." ? "lies outside the folder" : "";
}

InputFile open_linked(const std::filesystem::path& path, const std::filesystem::path& name,
                      bool outside) {
  if (name.native().find('\0') != std::string::npos) {
    fail_format(path, "it names the file " + quoted(name) + ", and no file has a zero in its name");
  }
  const std::filesystem::path parent = path.parent_path();
  if (outside) {
    return InputFile(parent / name);
  }
  if (const std::string why = why_outside(name); !why.empty()) {
    fail_outside(path, name, why);
  }
  std::error_code error;
  const auto folder = std::filesystem::canonical(parent.empty() ? "." : parent, error);
  const auto target = error ? folder : std::filesystem::canonical(folder / name, error);
  if (error) {
    fail_missing(parent / name, error.value());
  }
  const std::filesystem::path inside = target.lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..") {
    fail_outside(path, name, "leads outside the folder");
  }
  // The resolved path has no links, so none is followed: one that takes its place meanwhile fails.
  Descriptor place(::open(folder.c_str(), kPassThrough | O_DIRECTORY | O_CLOEXEC));
  for (auto part = inside.begin(); part != inside.end() && place.number() >= 0; ++part) {
    const bool last = std::next(part) == inside.end();
    const int kind = last ? O_RDONLY | O_NONBLOCK : kPassThrough | O_DIRECTORY;
    place.reset(::openat(place.number(), part->c_str(), kind | O_CLOEXEC | O_NOFOLLOW));
  }
  if (place.number() < 0) {
    fail_missing(parent / name, errno);
  }
  return {parent / name, place.release()};
}

}  // namespace difmesh::detail
