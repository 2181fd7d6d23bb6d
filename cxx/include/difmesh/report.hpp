#pragma once
/// \file report.hpp
/// What a reconstruction tells beside its mesh.

#include <cstdint>
#include <string>
#include <vector>

namespace difmesh {

/// Facts about one reconstruction. Of a block, they are what it adds to the whole: counts are of
/// its own cells and of the edges it owns (edge_id.hpp), so that each is counted once; see merge().
struct Report {
  std::int64_t cells = 0;              ///< cells read
  std::int64_t interfacial_cells = 0;  ///< tolerance < γ < 1 - tolerance
  std::int64_t clamped_cells = 0;      ///< γ < 0 or γ > 1
  double largest_overshoot = 0.0;      ///< largest distance of a γ from [0,1]
  double fraction_volume = 0.0;        ///< Σγ|K| over the cells, clamped, in the unit of the grid
  std::int64_t planes = 0;             ///< cells that were given a normal and a plane
  std::int64_t height_function_cells = 0;  ///< of these, with a normal from heights
  std::int64_t gradient_free_cells = 0;  ///< of these, without gradient: edge directions were used
  std::int64_t solved_edges = 0;         ///< vertices placed by the half-full window
  double newton_steps_mean = 0.0;        ///< steps per solved edge
  std::int64_t newton_steps_max = 0;
  /// Solved edges along which the window's fraction falls somewhere, so that more than one position
  /// may be half full.
  std::int64_t non_monotone_edges = 0;
  std::int64_t curved_cells = 0;     ///< Placement::curved: cells that own a curved surface
  std::int64_t curved_vertices = 0;  ///< vertices that such surfaces placed
  /// Cells whose centre their surface puts on another side than γ >= 1/2 does.
  std::int64_t moved_centres = 0;
  /// No boundary edge; an empty mesh is closed. Of a block: none on a side of the domain.
  bool closed = true;
  /// Signed volume inside; 0 where not closed. Of a block: the signed volume between its triangles
  /// and the middle of the grid in z, whose sum over the blocks of a closed surface is the volume
  /// inside.
  double enclosed_volume = 0.0;
  struct Seconds {           ///< wall time by phase
    double classify = 0.0;   ///< the one pass over the field: checks, sums, inside bits
    double normals = 0.0;    ///< normals, planes and curved surfaces
    double count = 0.0;      ///< counting and allocation of the output
    double vertices = 0.0;   ///< placement
    double triangles = 0.0;  ///< connectivity, volume
    double total = 0.0;
  } seconds;
  /// What a user should know though it is no error, one English sentence each: that integers look
  /// like a mask or a segmentation (values.hpp, doubt_of_scale()). Blocks have none.
  std::vector<std::string> warnings;
};

/// Adds the facts about a part to those about other parts of the same whole, starting from a
/// Report{}. Parts that cover the grid without overlap give the report of the whole field: the same
/// counts, and sums that differ by rounding. Seconds add up; what is warned of twice is said once.
/// Cost: negligible. Thread safety: concurrent calls on different wholes are safe.
void merge(Report& whole, const Report& part);

}  // namespace difmesh
