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
/// plic with all kinds of normals, that of its default first.
[[nodiscard]] std::vector<Way> kinds_of_normals();
/// What smooths fields or surfaces.
[[nodiscard]] std::vector<Way> smoothings();
/// Names of those that the golf ball is drawn by.
[[nodiscard]] std::vector<std::string> golf_ball_ways();
/// \pre a placement or smoothing has that name
[[nodiscard]] Way way(const std::string& name);

}  // namespace difmesh::paper
