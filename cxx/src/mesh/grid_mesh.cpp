#include "mesh/grid_mesh.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kPerPortion = 4096;
// A volume this small a share of its terms is rounding: the mesh is flat.
constexpr double kVolumeRounding = 1e-12;

[[noreturn]] void throw_invalid(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

/// A value for each portion of a loop, combined in their order after it.
template <class T>
std::vector<T> per_portion(std::size_t count) {
  return std::vector<T>((count + kPerPortion - 1) / kPerPortion);
}

/// Index of the first element that breaks a rule, by portions; -1 for none.
struct FirstBad {
  std::int64_t index = -1;
  void note(std::int64_t i) {
    if (index < 0) {
      index = i;
    }
  }
};

std::int64_t first_bad(const std::vector<FirstBad>& portions) {
  for (const FirstBad& portion : portions) {
    if (portion.index >= 0) {
      return portion.index;
    }
  }
  return -1;
}

/// Positions in grid units. Each vertex is moved but once: triangles go on sharing their corners.
void to_grid_units(const Grid& grid, std::span<const Vec3> positions, Array<Vec3>& corners,
                   Array<std::uint64_t>& keys, Phases& phases) {
  corners.resize(positions.size());
  keys.resize(positions.size());
  auto bad = per_portion<FirstBad>(positions.size());
  phases.run(0.05, static_cast<std::int64_t>(positions.size()), kPerPortion,
             [&](std::int64_t begin, std::int64_t end) {
               FirstBad& first = bad[static_cast<std::size_t>(begin / kPerPortion)];
               for (std::int64_t v = begin; v < end; ++v) {
                 const auto i = static_cast<std::size_t>(v);
                 for (std::size_t a = 0; a < 3; ++a) {
                   corners[i][a] = (positions[i][a] - grid.origin[a]) / grid.spacing[a];
                   // False for NaN as well.
                   if (!(std::abs(corners[i][a]) < kGreatestCoordinate)) {
                     first.note(v);
                   }
                 }
                 keys[i] = position_key(positions[i]);
               }
             });
  const std::int64_t v = first_bad(bad);
  if (v >= 0) {
    const Vec3& position = positions[static_cast<std::size_t>(v)];
    const bool finite =
        std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
    throw_invalid(
        "vertex " + std::to_string(v) + " at " + rounded_text(position) +
        (finite ? " is 2^32 spacings or more away from the origin of the grid" : " is not finite"));
  }
}

void check_indices(std::size_t vertices, std::span<const Triangle> triangles, Phases& phases) {
  auto bad = per_portion<FirstBad>(triangles.size());
  phases.run(0.02, static_cast<std::int64_t>(triangles.size()), kPerPortion,
             [&](std::int64_t begin, std::int64_t end) {
               for (std::int64_t t = begin; t < end; ++t) {
                 for (const std::uint32_t vertex : triangles[static_cast<std::size_t>(t)]) {
                   if (vertex >= vertices) {
                     bad[static_cast<std::size_t>(begin / kPerPortion)].note(t);
                   }
                 }
               }
             });
  const std::int64_t t = first_bad(bad);
  if (t >= 0) {
    const Triangle& triangle = triangles[static_cast<std::size_t>(t)];
    throw_invalid("triangle " + std::to_string(t) + " (" + std::to_string(triangle[0]) + ", " +
                  std::to_string(triangle[1]) + ", " + std::to_string(triangle[2]) +
                  ") has an index out of range: the mesh has " + std::to_string(vertices) +
                  " vertices");
  }
}

/// Sums over triangles that say whether the mesh is closed and right way out.
struct SurfaceSums {
  std::uint64_t balance = 0;
  double volume6 = 0.0;
  double terms6 = 0.0;  ///< of absolute values
};

SurfaceSums surface_sums(std::span<const Vec3> corners, std::span<const std::uint64_t> keys,
                         std::span<const Triangle> triangles, Phases& phases) {
  const Vec3 apex = corners[triangles[0][0]];
  const auto from_apex = [&](std::uint32_t vertex) {
    const Vec3& corner = corners[vertex];
    return Vec3{corner[0] - apex[0], corner[1] - apex[1], corner[2] - apex[2]};
  };
  auto parts = per_portion<SurfaceSums>(triangles.size());
  phases.run(0.05, static_cast<std::int64_t>(triangles.size()), kPerPortion,
             [&](std::int64_t begin, std::int64_t end) {
               SurfaceSums sums;
               const auto portion = triangles.subspan(static_cast<std::size_t>(begin),
                                                      static_cast<std::size_t>(end - begin));
               sums.balance = edge_balance(keys, portion);
               for (const Triangle& triangle : portion) {
                 const Vec3 a = from_apex(triangle[0]);
                 const Vec3 b = from_apex(triangle[1]);
                 const Vec3 c = from_apex(triangle[2]);
                 const double term = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                                     a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                     a[2] * (b[0] * c[1] - b[1] * c[0]);
                 sums.volume6 += term;
                 sums.terms6 += std::abs(term);
               }
               parts[static_cast<std::size_t>(begin / kPerPortion)] = sums;
             });
  SurfaceSums all;
  for (const SurfaceSums& part : parts) {
    all.balance += part.balance;
    all.volume6 += part.volume6;
    all.terms6 += part.terms6;
  }
  return all;
}

}  // namespace

GridMesh checked_mesh(const Grid& grid, std::span<const Vec3> positions,
                      std::span<const Triangle> triangles, const MeshRules& rules, Phases& phases) {
  GridMesh mesh;
  to_grid_units(grid, positions, mesh.corners, mesh.names, phases);
  check_indices(positions.size(), triangles, phases);
  const SurfaceSums sums = surface_sums(mesh.corners, mesh.names, triangles, phases);
  if (rules.check_edges && sums.balance != 0) {
    mesh.defect = find_edge_defect(positions, triangles);
    if (mesh.defect) {
      return mesh;
    }
  }
  mesh.volume = (rules.flip ? -1.0 : 1.0) * sums.volume6 / 6.0;
  if (mesh.volume < -kVolumeRounding * sums.terms6) {
    throw_invalid("the mesh is inside out: its volume is " +
                  rounded_text(mesh.volume * grid.cell_volume()) +
                  (rules.flip ? "; leave out the option flip (--flip)"
                              : "; use the option flip (--flip) if its triangles are clockwise "
                                "seen from outside"));
  }
  return mesh;
}

}  // namespace difmesh::detail
