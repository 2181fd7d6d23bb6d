#pragma once
// Measures the points of a surface against a field of distances.

#include "base/parallel.hpp"
#include "difmesh/metrics/distance.hpp"
#include "distance_field.hpp"
#include "surface_view.hpp"

namespace difmesh::detail {

/// \param share of the whole work that this is, for the progress
/// Throws as distance() says, of the surface's area, the facets' spacing and distances that are not
/// finite.
[[nodiscard]] Distance measure_surface(const SurfaceView& surface, const DistanceField& field,
                                       double facet_spacing, Phases& phases, double share);

}  // namespace difmesh::detail
