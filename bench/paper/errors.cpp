#include "errors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "difmesh/curvature.hpp"

namespace difmesh::paper {
namespace {

/// Of the vertices of a surface from a shape, and of the curvatures there.
void add_shape_errors(const Body& body, const Mesh& mesh, Errors& found) {
  std::vector<double> distances(mesh.positions.size());
  body.shape->distances(mesh.positions, distances);
  CurvatureOptions options;
  options.threads = 1;
  const Curvature fitted = curvature(mesh, options);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    found.distance.add(distances[v] / body.size);
    if (const auto exact = exact_curvatures(body, mesh.positions[v], distances[v])) {
      found.mean_curvature.add((fitted.mean[v] - exact->mean) * body.size);
      found.gaussian_curvature.add((fitted.gaussian[v] - exact->gaussian) * body.size * body.size);
    }
  }
  found.distance.end_surface();
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

void Tally::add(const DistanceStatistics& surface, double size) {
  const auto points = static_cast<double>(surface.points);
  count += surface.points;
  sum += points * surface.signed_mean / size;
  sum_of_squares += points * surface.rms * surface.rms / (size * size);
  maximum = std::max(maximum, surface.maximum / size);
  sum_of_maxima += surface.maximum / size;
  ++surfaces;
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

Errors errors(const Body& body, const Mesh& mesh) {
  Errors found;
  found.vertices = static_cast<std::int64_t>(mesh.positions.size());
  if (body.shape) {
    add_shape_errors(body, mesh, found);
    return found;
  }
  DistanceOptions options;
  options.both_ways = false;
  options.threads = 1;
  found.distance.add(distance(mesh, *body.mesh, options).to_reference.vertices, body.size);
  return found;
}

}  // namespace difmesh::paper
