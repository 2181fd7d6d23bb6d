#pragma once
/// \file errors.hpp
/// What calls complain of.

#include <string>

#include "difmesh/error.hpp"

namespace difmesh::test {

/// The message of the Error that a call throws, or "".
template <class Call>
[[nodiscard]] std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace difmesh::test
