#include "text.hpp"

#include <cstdarg>
#include <cstdio>

namespace difmesh::attack {

std::string text(const char* format, ...) {
  char buffer[401];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

std::string node_text(const Index3& node) {
  return text("(%d, %d, %d)", static_cast<int>(node[0]), static_cast<int>(node[1]),
              static_cast<int>(node[2]));
}

}  // namespace difmesh::attack
