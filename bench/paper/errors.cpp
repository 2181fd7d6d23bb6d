#include "errors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "difmesh/curvature.hpp"
#include "reference_surface.hpp"

namespace difmesh::paper {
namespace {

/// The metrics library gives statistics; its inside gives the distances themselves.
std::vector<double> distances_from_mesh(const Mesh& reference, const Mesh& mesh) {
  constexpr int kThreads = 1;
  detail::SurfaceView view{"reference", reference.positions, reference.triangles};
  view.scale =
      detail::scale_of(detail::box_of(mesh.positions), detail::box_of(reference.positions));
  detail::Workers workers(kThreads);
  const detail::ReferenceSurface surface(view, true, kThreads, workers);
  const auto probe = surface.probe();
  std::vector<double> distances(mesh.positions.size());
  std::ranges::transform(mesh.positions, distances.begin(),
                         [&](const Vec3& point) { return probe->measure(point); });
  return distances;
}

/// Of the curvatures at vertices whose distances are known.
void add_curvature_errors(const Body& body, const Mesh& mesh, const std::vector<double>& distances,
                          Errors& found) {
  CurvatureOptions options;
  options.threads = 1;
  const Curvature fitted = curvature(mesh, options);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (const auto exact = exact_curvatures(body, mesh.positions[v], distances[v])) {
      found.mean_curvature.add((fitted.mean[v] - exact->mean) * body.size);
      found.gaussian_curvature.add((fitted.gaussian[v] - exact->gaussian) * body.size * body.size);
    }
  }
  found.mean_curvature.end_surface();
  found.gaussian_curvature.end_surface();
}

double ratio(double sum, std::int64_t count) {
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

void Tally::add(double error) {
  if (!std::isfinite(error)) {
    ++not_finite;
    return;
  }
  ++count;
  ++surface_count_;
  sum += error;
  sum_of_squares += error * error;
  surface_maximum_ = std::max(surface_maximum_, std::abs(error));
}

void Tally::end_surface() {
  if (surface_count_ > 0) {
    maximum = std::max(maximum, surface_maximum_);
    sum_of_maxima += surface_maximum_;
    ++surfaces;
  }
  surface_count_ = 0;
  surface_maximum_ = 0.0;
}

void Tally::add(const Tally& other) {
  count += other.count;
  sum_of_squares += other.sum_of_squares;
  sum += other.sum;
  maximum = std::max(maximum, other.maximum);
  sum_of_maxima += other.sum_of_maxima;
  surfaces += other.surfaces;
  not_finite += other.not_finite;
}

double Tally::rms() const {
  return std::sqrt(ratio(sum_of_squares, count));
}

double Tally::mean() const {
  return ratio(sum, count);
}

double Tally::mean_maximum() const {
  return ratio(sum_of_maxima, surfaces);
}

void Errors::add(const Errors& other) {
  vertices += other.vertices;
  distance.add(other.distance);
  mean_curvature.add(other.mean_curvature);
  gaussian_curvature.add(other.gaussian_curvature);
}

std::vector<double> vertex_distances(const Body& body, const Mesh& mesh) {
  if (!body.shape) {
    return distances_from_mesh(*body.mesh, mesh);
  }
  std::vector<double> distances(mesh.positions.size());
  body.shape->distances(mesh.positions, distances);
  return distances;
}

Errors errors(const Body& body, const Mesh& mesh) {
  Errors found;
  found.vertices = static_cast<std::int64_t>(mesh.positions.size());
  const std::vector<double> distances = vertex_distances(body, mesh);
  for (const double distance : distances) {
    found.distance.add(distance / body.size);
  }
  found.distance.end_surface();
  add_curvature_errors(body, mesh, distances, found);
  return found;
}

}  // namespace difmesh::paper
