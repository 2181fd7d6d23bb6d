#pragma once
/// \file cube.hpp
/// What every dialect of a file with the cube [1,3]³ must be read as.

#include <doctest/doctest.h>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"

namespace test {

inline void check_cube(const difmesh::MeshFile& read) {
  const difmesh::Measure m = difmesh::measure(read.mesh);
  CHECK(m.triangles == 12);
  CHECK(m.vertices == 8);
  CHECK(m.closed);
  CHECK(m.manifold);
  CHECK(m.area == doctest::Approx(24.0).epsilon(1e-15));
  CHECK(m.volume == doctest::Approx(8.0).epsilon(1e-15));
}

}  // namespace test
