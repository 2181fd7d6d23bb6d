#include "curved/surface_maker.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "curved/graph_fit.hpp"
#include "curved/height_surface.hpp"
#include "curved/neighbourhood.hpp"

namespace difmesh::detail {
namespace {

// Axes whose components of the normal differ by no more have the same right to the columns.
constexpr double kTied = 1e-6;

// Fifteen coefficients are too many for cells that are long: what is known of the surface along
// them does not reach two cells across.
bool serve_quartics(const Vec3& size) {
  constexpr double kMostRatio = 1.5;
  return std::max({size[0], size[1], size[2]}) <=
         kMostRatio * std::min({size[0], size[1], size[2]});
}

// From columns along all axes that have the same right.
std::optional<LocalSurface> from_heights(const Neighbourhood& cells, const Vec3& m,
                                         const HeightRule& rule) {
  const double largest = std::max({std::abs(m[0]), std::abs(m[1]), std::abs(m[2])});
  LocalSurface result;
  result.source = rule.is_biquartic ? CellSurfaceSource::heights_25 : CellSurfaceSource::heights_13;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(m[axis]) < largest * (1.0 - kTied)) {
      continue;
    }
    const std::optional<Graph> graph = height_surface(cells, axis, m[axis] > 0.0 ? 1 : -1, rule);
    if (!graph) {
      return std::nullopt;
    }
    result.axis = result.count == 0 ? static_cast<int>(axis) : result.axis;
    result.graphs[static_cast<std::size_t>(result.count++)] = *graph;
  }
  return result;
}

template <int kDegree>
std::optional<LocalSurface> from_fit(const Neighbourhood& cells, const Vec3& m) {
  const std::optional<Graph> graph = fitted_graph<kDegree>(cells, m);
  if (!graph) {
    return std::nullopt;
  }
  LocalSurface result;
  result.source = kDegree == 4 ? CellSurfaceSource::quartic_fit : CellSurfaceSource::quadratic_fit;
  result.count = 1;
  result.graphs[0] = *graph;
  return result;
}

std::optional<LocalSurface> best_surface(const Neighbourhood& cells, const Vec3& m,
                                         CellSurfaceKind kind) {
  std::optional<LocalSurface> result;
  if (kind == CellSurfaceKind::curvature) {
    result = from_heights(cells, m, kCurvatureHeights);
    if (!result && serve_quartics(cells.size())) {
      result = from_fit<4>(cells, m);
    }
  }
  if (!result) {
    result = from_heights(cells, m, kPositionHeights);
  }
  return result ? result : from_fit<2>(cells, m);
}

bool is_at_open_side(const Neighbourhood& cells) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cells.is_there(axis, -1) || !cells.is_there(axis, 1)) {
      return true;
    }
  }
  return false;
}

// Whether what it says of the cell's centre may be.
bool is_credible(const LocalSurface& surface, double fraction, const Vec3& size) {
  const double value = surface.function({0.0, 0.0, 0.0});
  const bool agrees = (value <= 0.0) == (fraction >= 0.5);
  return (agrees || (fraction >= kMayFlip && fraction <= 1.0 - kMayFlip)) &&
         std::abs(value) <= kMostAway * std::max({size[0], size[1], size[2]});
}

}  // namespace

template <class T>
LocalSurface SurfaceMaker<T>::operator()(const Index3& cell) const {
  const double fraction = field_.fraction(cell);
  if (!field_.is_interfacial(fraction)) {
    return {};
  }
  const Neighbourhood cells(field_, cell,
                            kind_ == CellSurfaceKind::curvature ? kCurvatureReach : kPositionReach);
  const UnitNormal normal = is_at_open_side(cells) ? lvira_(cell) : youngs_(cell);
  if (normal.source == NormalSource::none) {
    return {};
  }
  const std::optional<LocalSurface> surface = best_surface(cells, normal.m, kind_);
  return surface && is_credible(*surface, fraction, cells.size()) ? *surface : LocalSurface{};
}

template class SurfaceMaker<float>;
template class SurfaceMaker<double>;
template class SurfaceMaker<std::uint8_t>;
template class SurfaceMaker<std::uint16_t>;

}  // namespace difmesh::detail
