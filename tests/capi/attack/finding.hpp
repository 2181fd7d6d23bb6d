#pragma once
/// \file finding.hpp
/// What is wrong with a result, or that nothing is.

#include <string>

namespace difmesh::attack {

struct Finding {
  const char* kind = nullptr;  ///< nullptr: nothing is wrong
  std::string detail;

  explicit operator bool() const { return kind != nullptr; }
};

}  // namespace difmesh::attack
