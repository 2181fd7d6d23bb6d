#include "difmesh/constrained_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "base/vector3.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/fractions_from_mesh.hpp"
#include "difmesh/vertex_normals.hpp"
#include "mesh/area_vectors.hpp"
#include "mesh/mesh_arrays.hpp"
#include "mesh/vertex_neighbours.hpp"
#include "mesh/vertex_patch.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr std::int64_t kVerticesPerPortion = 512;
constexpr int kMostHalvings = 6;
// Edges that hardly cross the surface are not followed as far as it would take to reach the patch.
constexpr double kLeastCrossing = 0.25;
// How far a position may be off its edge, in spacings: what files with float32 leave.
constexpr double kOffEdge = 1e-5;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "smooth_within_fractions: " + message);
}

void require_range(double value, double low, double high, const std::string& name) {
  if (!(value >= low && value <= high)) {
    fail(name + " is " + rounded_text(value) + "; possible is " + rounded_text(low) + " to " +
         rounded_text(high));
  }
}

/// The dual edge of a vertex: along which axis it runs, from which cell's centre, and how far the
/// vertex may go. No way is left to vertices whose edge ends beyond the grid.
struct EdgeTrack {
  std::size_t axis = 0;
  Index3 cell{0, 0, 0};
  double low = 0.0;
  double high = 0.0;
};

class Tracks {
 public:
  Tracks(const Mesh& mesh, const Grid& grid, double clearance) : grid_(grid) {
    tracks_.reserve(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      tracks_.push_back(make(v, mesh.edge_ids[v], mesh.positions[v], clearance));
    }
  }
  [[nodiscard]] const EdgeTrack& operator[](std::size_t v) const { return tracks_[v]; }

  /// Whether one of the cells that the vertex's triangles may reach is marked.
  [[nodiscard]] bool touches(std::size_t v, const std::vector<std::uint8_t>& marks) const {
    const EdgeTrack& track = tracks_[v];
    Index3 low;
    Index3 high;
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::max<std::int64_t>(track.cell[a] - (a == track.axis ? 0 : 1), 0);
      high[a] = std::min(track.cell[a] + 1, grid_.dims[a] - 1);
    }
    for (std::int64_t k = low[2]; k <= high[2]; ++k) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        const std::int64_t row = (k * grid_.dims[1] + j) * grid_.dims[0];
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          if (marks[static_cast<std::size_t>(row + i)] != 0) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] EdgeTrack make(std::size_t v, std::uint64_t id, const Vec3& position,
                               double clearance) const {
    EdgeTrack track;
    track.axis = static_cast<std::size_t>(id % 3);
    std::uint64_t rest = id / 3;
    bool is_inside = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto nodes = static_cast<std::uint64_t>(grid_.dims[a]) + 2;
      track.cell[a] = static_cast<std::int64_t>(rest % nodes) - 1;
      rest /= nodes;
      const std::int64_t last = grid_.dims[a] - (a == track.axis ? 2 : 1);
      is_inside = is_inside && track.cell[a] >= 0 && track.cell[a] <= last;
    }
    if (rest != 0) {
      fail("vertex " + std::to_string(v) + " has an edge id outside the grid");
    }
    track.low = track.high = position[track.axis];
    if (is_inside) {
      require_on_edge(v, track, position);
      const Vec3 centre = grid_.cell_centre(track.cell);
      const double spacing = grid_.spacing[track.axis];
      track.low = std::min(track.low, centre[track.axis] + clearance * spacing);
      track.high = std::max(track.high, centre[track.axis] + (1.0 - clearance) * spacing);
    }
    return track;
  }
  void require_on_edge(std::size_t v, const EdgeTrack& track, const Vec3& position) const {
    const Vec3 centre = grid_.cell_centre(track.cell);
    for (std::size_t a = 0; a < 3; ++a) {
      const double away = (position[a] - centre[a]) / grid_.spacing[a];
      const double reach = a == track.axis ? 1.0 : 0.0;
      if (!(away >= -kOffEdge && away <= reach + kOffEdge)) {
        fail("vertex " + std::to_string(v) + " at " + rounded_text(position) +
             " is not on the edge of its id; is the grid that of the reconstruction?");
      }
    }
  }

  const Grid& grid_;
  std::vector<EdgeTrack> tracks_;
};

class Smoother {
 public:
  Smoother(const Mesh& mesh, const Grid& grid, const ConstrainedSmoothingOptions& options)
      : given_(mesh),
        grid_(grid),
        options_(options),
        triangles_(mesh.triangles),
        workers_(options.threads),
        tracks_(mesh, grid, options.clearance),
        neighbours_(mesh.positions.size(), mesh.triangles, workers_),
        moves_(mesh.positions.size()),
        halvings_(mesh.positions.size()) {
    positions_ = mesh.positions;
    wanted_ = measured(positions_, true);
  }

  /// \return false if nothing has moved
  bool step() {
    find_moves();
    std::fill(halvings_.begin(), halvings_.end(), std::uint8_t{0});
    std::vector<std::uint8_t> marks(wanted_.size());
    for (;;) {
      Array<Vec3> candidate = moved();
      double largest = 0.0;
      if (!mark_changes(measured(candidate, false), marks, largest)) {
        positions_ = std::move(candidate);
        result_.largest_change = largest;
        return true;
      }
      if (!hold_back(marks)) {
        return false;  // what is left is rounding
      }
    }
  }

  ConstrainedSmoothing finish() {
    result_.held_vertices = std::count_if(halvings_.begin(), halvings_.end(),
                                          [](std::uint8_t halvings) { return halvings > 0; });
    result_.mesh = with_positions(given_, std::move(positions_));
    return std::move(result_);
  }

 private:
  Array<double> measured(const Array<Vec3>& positions, bool first) {
    FractionsFromMeshOptions options;
    options.check_edges = first;
    options.overlaps = first ? Overlaps::refuse : Overlaps::count;
    options.threads = options_.threads;
    ++result_.measurements;
    return fractions_from_mesh(grid_, positions, triangles_, options).fractions;
  }

  template <class Body>
  void for_vertices(const Body& body) {
    const auto count = static_cast<std::int64_t>(moves_.size());
    workers_.for_portions(count, kVerticesPerPortion, body);
  }

  /// How far each vertex is to go along its edge to meet its patch.
  void find_moves() {
    const Array<Vec3> areas = area_vectors(positions_, triangles_);
    const PatchSurface surface{positions_, areas, neighbours_};
    for_vertices([&](std::int64_t begin, std::int64_t end) {
      VertexPatch patch(surface);
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        const PatchFit fitted = patch(static_cast<std::uint32_t>(v));
        const EdgeTrack& track = tracks_[v];
        const double crossing = fitted.axis[track.axis];
        const double way = fitted.height * crossing / std::max(crossing * crossing, kLeastCrossing);
        const double here = positions_[v][track.axis];
        moves_[v] =
            fitted.is_determined ? std::clamp(here + way, track.low, track.high) - here : 0.0;
      }
    });
  }

  [[nodiscard]] Array<Vec3> moved() {
    Array<Vec3> positions = positions_;
    for_vertices([&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
        if (halvings_[v] <= kMostHalvings) {
          positions[v][tracks_[v].axis] += std::ldexp(moves_[v], -halvings_[v]);
        }
      }
    });
    return positions;
  }

  /// Marks the cells whose fractions have changed by more than the tolerance.
  bool mark_changes(const Array<double>& fractions, std::vector<std::uint8_t>& marks,
                    double& largest) const {
    bool any = false;
    for (std::size_t cell = 0; cell < marks.size(); ++cell) {
      const double change = std::abs(fractions[cell] - wanted_[cell]);
      const bool is_over = change > options_.tolerance;
      marks[cell] = is_over ? 1 : 0;
      any = any || is_over;
      largest = std::max(largest, change);
    }
    return any;
  }

  bool hold_back(const std::vector<std::uint8_t>& marks) {
    bool any = false;
    for (std::size_t v = 0; v < halvings_.size(); ++v) {
      if (halvings_[v] <= kMostHalvings && tracks_.touches(v, marks)) {
        ++halvings_[v];
        any = true;
      }
    }
    return any;
  }

  const Mesh& given_;
  const Grid& grid_;
  const ConstrainedSmoothingOptions& options_;
  std::span<const Triangle> triangles_;
  Workers workers_;
  Tracks tracks_;
  VertexNeighbours neighbours_;
  Array<Vec3> positions_;
  ConstrainedSmoothing result_;
  Array<double> wanted_;
  std::vector<double> moves_;
  std::vector<std::uint8_t> halvings_;  ///< of this step's move; more than the most: not moved
};

void check(const Mesh& mesh, const Grid& grid, const ConstrainedSmoothingOptions& options) {
  constexpr int kMostSteps = 1000;
  validate(grid);
  require_uniform(grid, "smooth_within_fractions");
  require_range(options.steps, 0, kMostSteps, "steps");
  require_range(options.tolerance, 1e-9, 0.5, "tolerance");
  require_range(options.clearance, 1e-13, 0.25, "clearance");
  if (mesh.edge_ids.size() != mesh.positions.size()) {
    fail("the mesh has no edge_ids");
  }
  check_mesh_arrays("smooth_within_fractions", mesh.positions, mesh.triangles);
}

}  // namespace

ConstrainedSmoothing smooth_within_fractions(const Mesh& mesh, const Grid& grid,
                                             const ConstrainedSmoothingOptions& options) {
  const DefaultFloatEnvironment environment;
  check(mesh, grid, options);
  if (mesh.triangles.empty()) {
    return {with_positions(mesh, mesh.positions), 0.0, 0, 0};
  }
  Smoother smoother(mesh, grid, options);
  for (int step = 0; step < options.steps && smoother.step(); ++step) {
    if (options.progress && !options.progress((step + 1.0) / options.steps)) {
      throw Error(ErrorCode::cancelled, "cancelled by the progress callback");
    }
  }
  return smoother.finish();
}

}  // namespace difmesh
