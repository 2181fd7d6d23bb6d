#pragma once
// The ways to a surface that are compared.

#include <functional>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "difmesh/reconstruct.hpp"

namespace difmesh::paper {

/// A way from a field to a surface. Works on one thread.
struct Way {
  std::string name;
  std::function<Mesh(const Sample& sample)> surface;
};

/// linear, manson and plic.
[[nodiscard]] std::vector<Way> placements();
/// The placements, and plic with all other normals.
[[nodiscard]] std::vector<Way> placements_and_normals();
/// These, and all that the library offers beside them.
[[nodiscard]] std::vector<Way> all_ways();
/// Names of those that the golf ball is drawn by.
[[nodiscard]] std::vector<std::string> golf_ball_ways();
/// \pre there is one of that name
[[nodiscard]] Way way(const std::string& name);

}  // namespace difmesh::paper
