#include "memory.hpp"

#include <string>
#include <system_error>

#include "text.hpp"

namespace difmesh::detail {

void fail_memory(const std::filesystem::path& path, std::int64_t bytes) {
  throw OutOfMemory(quoted(path) + ": out of memory, " + std::to_string(bytes) +
                    " bytes were asked for");
}

void fail_memory(const std::filesystem::path& path) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  throw OutOfMemory(quoted(path) + ": out of memory for a file" +
                    (unknown ? "" : " of " + std::to_string(size) + " bytes"));
}

}  // namespace difmesh::detail
