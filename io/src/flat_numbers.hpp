#pragma once
// Arrays of points, vectors and triangles as arrays of their numbers.

namespace difmesh {

/// The first number of an array of std::array, which follow each other without gaps; nullptr where
/// there is none, of which data() must not be asked.
template <class List>
[[nodiscard]] auto* flat_numbers(List& list) {
  return list.empty() ? nullptr : list.front().data();
}

}  // namespace difmesh
