#include "warnings.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "difmesh/printable.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kMostBytes = 1000;  // callers from C and Fortran have room for 1023

/// At most so many bytes, whole characters of UTF-8.
void cut(std::string& text) {
  if (text.size() <= kMostBytes) {
    return;
  }
  std::size_t end = kMostBytes - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) {
    --end;
  }
  text.resize(end);
  text += "...";
}

}  // namespace

void add_warning(std::vector<std::string>& warnings, const std::filesystem::path& path,
                 const std::string& matter) {
  std::string warning = quoted(path) + ": " + printable(matter) + ".";
  cut(warning);
  if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
    warnings.push_back(std::move(warning));
  }
}

}  // namespace difmesh::detail
