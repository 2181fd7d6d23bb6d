#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "base/vector3.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/smoothing.hpp"
#include "difmesh/vertex_normals.hpp"
#include "mesh/mesh_arrays.hpp"
#include "mesh/smoothing_options.hpp"
#include "mesh/vertex_neighbours.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr std::int64_t kVerticesPerPortion = 4096;

void check_share(const std::string& caller, const std::string& name, double share) {
  if (!(share > 0.0 && share <= 1.0)) {
    throw Error(
        ErrorCode::invalid_argument,
        caller + ": " + name + " must be above 0 and at most 1, got " + rounded_text(share));
  }
}

/// Moves all vertices at once by a share of the way to the mean of their neighbours.
class Umbrella {
 public:
  Umbrella(std::span<const Vec3> positions, std::span<const Triangle> triangles,
           BoundaryVertices boundary, Workers& workers)
      : boundary_(boundary),
        neighbours_(positions.size(), triangles, workers),
        before_(positions.begin(), positions.end()),
        after_(positions.size()) {}

  void move(double share, double weight, Phases& phases) {
    const auto count = static_cast<std::int64_t>(before_.size());
    phases.run(weight, count, kVerticesPerPortion, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        after_[v] = moved(v, share);
      }
    });
    std::swap(before_, after_);
  }
  [[nodiscard]] Array<Vec3> take() { return std::move(before_); }

 private:
  [[nodiscard]] Vec3 moved(std::size_t v, double share) const {
    const Vec3& here = before_[v];
    const bool on_boundary = neighbours_.on_boundary(v);
    if (on_boundary && boundary_ == BoundaryVertices::stay) {
      return here;
    }
    const auto seen = on_boundary ? neighbours_.along_boundary(v) : neighbours_.of(v);
    if (seen.empty()) {
      return here;
    }
    Vec3 sum{0.0, 0.0, 0.0};
    for (const std::uint32_t neighbour : seen) {
      sum = plus(sum, minus(before_[neighbour], here));
    }
    return plus(here, scaled(sum, share / static_cast<double>(seen.size())));
  }

  BoundaryVertices boundary_;
  VertexNeighbours neighbours_;
  Array<Vec3> before_;
  Array<Vec3> after_;
};

}  // namespace

Array<Vec3> smooth_laplacian(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                             const LaplacianOptions& options) {
  const DefaultFloatEnvironment environment;
  const std::string caller = "smooth_laplacian";
  check_steps(caller, options.steps);
  check_boundary(caller, options.boundary);
  check_share(caller, "factor", options.factor);
  check_mesh_arrays(caller, positions, triangles);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  Umbrella umbrella(positions, triangles, options.boundary, workers);
  for (int step = 0; step < options.steps; ++step) {
    umbrella.move(options.factor, 1.0 / options.steps, phases);
  }
  phases.finish();
  return umbrella.take();
}

Array<Vec3> smooth_taubin(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                          const TaubinOptions& options) {
  const DefaultFloatEnvironment environment;
  const std::string caller = "smooth_taubin";
  check_steps(caller, options.steps);
  check_boundary(caller, options.boundary);
  check_share(caller, "lambda", options.lambda);
  const double mu = 1.0 / (options.pass_band - 1.0 / options.lambda);
  const double highest = (1.0 - 2.0 * options.lambda) * (1.0 - 2.0 * mu);
  if (!(options.pass_band > 0.0 && mu < 0.0 && std::abs(highest) <= 1.0)) {
    throw Error(ErrorCode::invalid_argument,
                caller + ": lambda " + rounded_text(options.lambda) + " and pass_band " +
                    rounded_text(options.pass_band) + " do not go together; see smoothing.hpp");
  }
  check_mesh_arrays(caller, positions, triangles);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  Umbrella umbrella(positions, triangles, options.boundary, workers);
  for (int step = 0; step < options.steps; ++step) {
    umbrella.move(options.lambda, 0.5 / options.steps, phases);
    umbrella.move(mu, 0.5 / options.steps, phases);
  }
  phases.finish();
  return umbrella.take();
}

Mesh smooth_laplacian(const Mesh& mesh, const LaplacianOptions& options) {
  return with_positions(mesh, smooth_laplacian(mesh.positions, mesh.triangles, options));
}

Mesh smooth_taubin(const Mesh& mesh, const TaubinOptions& options) {
  return with_positions(mesh, smooth_taubin(mesh.positions, mesh.triangles, options));
}

}  // namespace difmesh
