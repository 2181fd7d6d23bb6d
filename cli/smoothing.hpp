#pragma once
/// \file smoothing.hpp
/// --smooth: which smoothing, and the smoothing of a surface.

#include <cstdint>
#include <string>

#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/options.hpp"

namespace difmesh::cli {

enum class SmoothingKind : std::uint8_t { laplacian, taubin, flow, constrained };

/// A kind and its number: steps, the time of the flow over the square of the spacing, or the
/// tolerance of fractions.
struct Smoothing {
  SmoothingKind kind = SmoothingKind::taubin;
  double number = 0.0;
};

/// "NAME" or "NAME:NUMBER".
/// \throw CLI::ValidationError naming the option and the word
[[nodiscard]] Smoothing parse_smoothing(const std::string& option, const std::string& text);
[[nodiscard]] std::string smoothing_text(const Smoothing& smoothing);

/// What stays the same while surfaces are smoothed.
struct SmoothingContext {
  Grid grid;
  int threads = 0;
  Progress progress = {};
};

/// Moves the vertices. Normals, where there are any, become means of those of the triangles, by
/// area. \pre the mesh has edge_ids if kind is constrained
/// \throw Error
void smooth_surface(const Smoothing& smoothing, const SmoothingContext& context, Mesh& mesh);

}  // namespace difmesh::cli
