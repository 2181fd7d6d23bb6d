#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

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
constexpr int kMostIterations = 10000;
constexpr double kFlattest = 1e-6;

/// Runs loops over the vertices, and sums over them in fixed portions.
class VertexLoops {
 public:
  VertexLoops(std::size_t count, Workers& workers)
      : count_(static_cast<std::int64_t>(count)),
        workers_(workers),
        parts_(static_cast<std::size_t>((count_ + kVerticesPerPortion - 1) / kVerticesPerPortion)) {
  }

  template <class Body>
  void run(const Body& body) {
    workers_.for_portions(count_, kVerticesPerPortion, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        body(v);
      }
    });
  }
  /// Sums the vectors that body returns.
  template <class Body>
  Vec3 sum(const Body& body) {
    workers_.for_portions(count_, kVerticesPerPortion, [&](std::int64_t begin, std::int64_t end) {
      Vec3 part{0.0, 0.0, 0.0};
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        part = plus(part, body(v));
      }
      parts_[static_cast<std::size_t>(begin / kVerticesPerPortion)] = part;
    });
    Vec3 whole{0.0, 0.0, 0.0};
    for (const Vec3& part : parts_) {
      whole = plus(whole, part);
    }
    return whole;
  }

 private:
  std::int64_t count_;
  Workers& workers_;
  std::vector<Vec3> parts_;
};

Vec3 product(const Vec3& a, const Vec3& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

/// a / b for each coordinate; 0 where b is 0.
Vec3 quotient(const Vec3& a, const Vec3& b) {
  Vec3 result{0.0, 0.0, 0.0};
  for (std::size_t t = 0; t < 3; ++t) {
    result[t] = b[t] != 0.0 ? a[t] / b[t] : 0.0;
  }
  return result;
}

/// A + time L of a mesh, with a row per vertex. Rows of vertices that stay are empty.
class FlowMatrix {
 public:
  FlowMatrix(const Array<Vec3>& positions, std::span<const Triangle> triangles,
             const VertexNeighbours& neighbours, double time)
      : neighbours_(neighbours),
        diagonal_(positions.size(), 0.0),
        pull_(neighbours.entries(), 0.0) {
    for (const Triangle& t : triangles) {
      if (!index_twice(t)) {
        add(positions, t, time);
      }
    }
    for (std::size_t v = 0; v < positions.size(); ++v) {
      double pulls = 0.0;
      for (std::size_t n = 0; n < neighbours_.of(v).size(); ++n) {
        pulls += pull_[neighbours_.first(v) + n];
      }
      diagonal_[v] =
          neighbours_.on_boundary(v) || !(diagonal_[v] > 0.0) ? 0.0 : diagonal_[v] + pulls;
    }
  }

  [[nodiscard]] bool stays(std::size_t v) const { return !(diagonal_[v] > 0.0); }
  [[nodiscard]] double diagonal(std::size_t v) const { return diagonal_[v]; }
  /// Row v times x, for x that is 0 at vertices that stay.
  [[nodiscard]] Vec3 times(std::size_t v, const Array<Vec3>& x) const {
    if (stays(v)) {
      return {0.0, 0.0, 0.0};
    }
    return minus(scaled(x[v], diagonal_[v]), pulled(v, x, {0.0, 0.0, 0.0}));
  }
  /// -time L x at v.
  [[nodiscard]] Vec3 flow(std::size_t v, const Array<Vec3>& x) const {
    return stays(v) ? Vec3{0.0, 0.0, 0.0} : pulled(v, x, x[v]);
  }

 private:
  void add(const Array<Vec3>& positions, const Triangle& t, double time) {
    std::array<Vec3, 3> side;  // from corner c to the next
    double longest2 = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      side[c] = minus(positions[t[(c + 1) % 3]], positions[t[c]]);
      longest2 = std::max(longest2, dot(side[c], side[c]));
    }
    const Vec3 normal = cross(side[0], side[1]);
    const double twice_area = std::max(std::sqrt(dot(normal, normal)), kFlattest * longest2);
    if (!(twice_area > 0.0)) {
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      diagonal_[t[c]] += twice_area / 6.0;
      // The cotangent at the corner that is opposite to this side.
      const double cotangent = -dot(side[(c + 1) % 3], side[(c + 2) % 3]) / twice_area;
      add_pull(t[c], t[(c + 1) % 3], 0.5 * time * cotangent);
      add_pull(t[(c + 1) % 3], t[c], 0.5 * time * cotangent);
    }
  }
  void add_pull(std::uint32_t from, std::uint32_t to, double pull) {
    const auto row = neighbours_.of(from);
    const auto place = std::find(row.begin(), row.end(), to) - row.begin();
    pull_[neighbours_.first(from) + static_cast<std::size_t>(place)] += pull;
  }
  [[nodiscard]] Vec3 pulled(std::size_t v, const Array<Vec3>& x, const Vec3& from) const {
    const auto row = neighbours_.of(v);
    const double* pulls = pull_.data() + neighbours_.first(v);
    Vec3 sum{0.0, 0.0, 0.0};
    for (std::size_t n = 0; n < row.size(); ++n) {
      sum = plus(sum, scaled(minus(x[row[n]], from), pulls[n]));
    }
    return sum;
  }

  const VertexNeighbours& neighbours_;
  std::vector<double> diagonal_;  ///< the areas, and the sum of the pulls
  std::vector<double> pull_;      ///< time times half the sum of cotangents, per neighbour
};

/// Solves matrix x = right for all three coordinates at once, by conjugate gradients with the
/// diagonal as preconditioner. \param residual the right side; destroyed
Array<Vec3> solve(const FlowMatrix& matrix, Array<Vec3>& residual, double tolerance,
                  VertexLoops& loops) {
  const std::size_t count = residual.size();
  Array<Vec3> x;
  Array<Vec3> direction;
  x.assign(count, Vec3{0.0, 0.0, 0.0});
  direction.assign(count, Vec3{0.0, 0.0, 0.0});
  Array<Vec3> image(count);
  const auto preconditioned = [&](std::size_t v) {
    return matrix.stays(v) ? Vec3{0.0, 0.0, 0.0} : scaled(residual[v], 1.0 / matrix.diagonal(v));
  };
  const auto residual_size = [&] {
    return loops.sum([&](std::size_t v) { return product(residual[v], preconditioned(v)); });
  };
  const Vec3 first = residual_size();
  Vec3 size = first;
  Vec3 share{0.0, 0.0, 0.0};
  for (int n = 0; n < kMostIterations; ++n) {
    bool done = true;
    for (std::size_t t = 0; t < 3; ++t) {
      done = done && !(size[t] > tolerance * tolerance * first[t]);
    }
    if (done) {
      break;
    }
    loops.run([&](std::size_t v) {
      direction[v] = plus(preconditioned(v), product(share, direction[v]));
    });
    const Vec3 bend = loops.sum([&](std::size_t v) {
      image[v] = matrix.times(v, direction);
      return product(direction[v], image[v]);
    });
    const Vec3 step = quotient(size, bend);
    loops.run([&](std::size_t v) {
      x[v] = plus(x[v], product(step, direction[v]));
      residual[v] = minus(residual[v], product(step, image[v]));
    });
    const Vec3 next = residual_size();
    share = quotient(next, size);
    size = next;
  }
  return x;
}

void flow(Array<Vec3>& positions, std::span<const Triangle> triangles,
          const VertexNeighbours& neighbours, const CurvatureFlowOptions& options,
          VertexLoops& loops) {
  const FlowMatrix matrix(positions, triangles, neighbours, options.time);
  Array<Vec3> right(positions.size());
  loops.run([&](std::size_t v) { right[v] = matrix.flow(v, positions); });
  const Array<Vec3> moves = solve(matrix, right, options.residual, loops);
  loops.run([&](std::size_t v) { positions[v] = plus(positions[v], moves[v]); });
}

void check(const std::string& caller, const CurvatureFlowOptions& options) {
  check_steps(caller, options.steps);
  if (!(options.time > 0.0) || !std::isfinite(options.time)) {
    throw Error(ErrorCode::invalid_argument,
                caller + ": time must be above 0, got " + rounded_text(options.time));
  }
  if (!(options.residual >= 1e-14 && options.residual <= 0.1)) {
    throw Error(ErrorCode::invalid_argument,
                caller + ": residual must be 1e-14 to 0.1, got " + rounded_text(options.residual));
  }
}

}  // namespace

Array<Vec3> smooth_by_curvature_flow(std::span<const Vec3> positions,
                                     std::span<const Triangle> triangles,
                                     const CurvatureFlowOptions& options) {
  const DefaultFloatEnvironment environment;
  const std::string caller = "smooth_by_curvature_flow";
  check(caller, options);
  check_mesh_arrays(caller, positions, triangles);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const VertexNeighbours neighbours(positions.size(), triangles, workers);
  VertexLoops loops(positions.size(), workers);
  Array<Vec3> moved(positions.begin(), positions.end());
  for (int step = 0; step < options.steps; ++step) {
    phases.run(1.0 / options.steps, 1, 1, [&](std::int64_t, std::int64_t) {
      flow(moved, triangles, neighbours, options, loops);
    });
  }
  phases.finish();
  return moved;
}

Mesh smooth_by_curvature_flow(const Mesh& mesh, const CurvatureFlowOptions& options) {
  return with_positions(mesh, smooth_by_curvature_flow(mesh.positions, mesh.triangles, options));
}

}  // namespace difmesh
