#pragma once
/// \file memory.hpp
/// Memory for what files hold; where there is none, the error names the file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>

#include "difmesh/mesh.hpp"
#include "difmesh/out_of_memory.hpp"

namespace difmesh::detail {

/// \throw OutOfMemory that names the file and how many bytes were asked for
[[noreturn]] void fail_memory(const std::filesystem::path& path, std::int64_t bytes);
/// \throw OutOfMemory that names the file and its size
[[noreturn]] void fail_memory(const std::filesystem::path& path);

/// Resizes an array to so many elements. \throw OutOfMemory
template <class T>
void make_room(const std::filesystem::path& path, Array<T>& array, std::int64_t elements) {
  try {
    array.resize(static_cast<std::size_t>(elements));
  } catch (const std::bad_alloc&) {
    fail_memory(path, elements * static_cast<std::int64_t>(sizeof(T)));
  }
}

/// Runs the reading of a file. \throw OutOfMemory in place of other kinds of std::bad_alloc
template <class Reading>
auto naming_file(const std::filesystem::path& path, const Reading& reading) {
  try {
    return reading();
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail_memory(path);
  }
}

}  // namespace difmesh::detail
