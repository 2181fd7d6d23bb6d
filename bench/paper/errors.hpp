#pragma once
// How far surfaces are from the truth, at their vertices.

#include <cstdint>
#include <vector>

#include "bodies.hpp"

namespace difmesh::paper {

/// Errors e of some vertices of some surfaces.
struct Tally {
  std::int64_t count = 0;
  double sum_of_squares = 0.0;
  double sum = 0.0;
  double maximum = 0.0;         ///< of |e|
  double sum_of_maxima = 0.0;   ///< of the surfaces
  std::int64_t surfaces = 0;    ///< with a vertex here
  std::int64_t not_finite = 0;  ///< vertices without a value

  void add(double error);
  /// Closes the surface that add() was called for.
  void end_surface();
  /// Adds what another has seen.
  void add(const Tally& other);

  [[nodiscard]] double rms() const;
  [[nodiscard]] double mean() const;
  /// Mean over the surfaces of their maxima.
  [[nodiscard]] double mean_maximum() const;

 private:
  double surface_maximum_ = 0.0;
  std::int64_t surface_count_ = 0;
};

/// Signed distance of each vertex from the body, in the body's unit; positive outside.
[[nodiscard]] std::vector<double> vertex_distances(const Body& body, const Mesh& mesh);

/// In the body's sizes: distances over size, mean curvature times size, Gaussian times size².
struct Errors {
  std::int64_t vertices = 0;
  Tally distance;  ///< positive outside
  Tally mean_curvature;
  Tally gaussian_curvature;

  void add(const Errors& other);
};

/// Of one surface, on one thread. The curvatures are those of difmesh::curvature(); none for bodies
/// without exact ones.
[[nodiscard]] Errors errors(const Body& body, const Mesh& mesh);

}  // namespace difmesh::paper
