#include "difmesh/metrics/distance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "distance_field.hpp"
#include "reference_surface.hpp"
#include "sampling.hpp"
#include "surface_view.hpp"

namespace difmesh {
namespace {

using namespace detail;

class ShapeProbe final : public DistanceProbe {
 public:
  explicit ShapeProbe(const SignedDistance& shape) : shape_(shape) {}
  double measure(const Vec3& point) override { return shape_(point); }

 private:
  const SignedDistance& shape_;
};

class ShapeField final : public DistanceField {
 public:
  explicit ShapeField(const SignedDistance& shape) : shape_(shape) {}
  [[nodiscard]] bool has_sign() const noexcept override { return true; }
  [[nodiscard]] std::unique_ptr<DistanceProbe> probe() const override {
    return std::make_unique<ShapeProbe>(shape_);
  }

 private:
  const SignedDistance& shape_;
};

void check_options(const DistanceOptions& options) {
  if (!(options.facet_spacing >= 0.0) || !std::isfinite(options.facet_spacing)) {
    throw Error(ErrorCode::invalid_argument,
                "distance: facet_spacing must be finite and not negative, got " +
                    rounded_text(options.facet_spacing));
  }
}

double largest(const Distance& distance) {
  return std::max(distance.vertices.maximum, distance.facets.maximum);
}

}  // namespace

Distance distance(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                  const SignedDistance& shape, const DistanceOptions& options) {
  const DefaultFloatEnvironment environment;
  check_options(options);
  SurfaceView surface{"mesh", positions, triangles};
  check_surface(surface);
  if (!shape) {
    throw Error(ErrorCode::invalid_argument, "distance: the shape's function is empty");
  }
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  const Box box = box_of(positions);
  surface.scale = scale_of(box, box);
  const Distance result =
      measure_surface(surface, ShapeField(shape), options.facet_spacing, phases, 1.0);
  phases.finish();
  return result;
}

MeshDistance distance(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                      std::span<const Vec3> reference_positions,
                      std::span<const Triangle> reference_triangles,
                      const DistanceOptions& options) {
  const DefaultFloatEnvironment environment;
  check_options(options);
  SurfaceView mesh{"mesh", positions, triangles};
  SurfaceView reference{"reference", reference_positions, reference_triangles};
  check_surface(mesh);
  check_surface(reference);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);
  mesh.scale = reference.scale = scale_of(box_of(positions), box_of(reference_positions));
  const auto measure = [&](const SurfaceView& from, const SurfaceView& to, double share) {
    const ReferenceSurface field(to, options.with_sign, options.threads, workers);
    return measure_surface(from, field, options.facet_spacing, phases, share);
  };
  MeshDistance result;
  const double there = static_cast<double>(triangles.size());
  const double back = options.both_ways ? static_cast<double>(reference_triangles.size()) : 0.0;
  result.to_reference = measure(mesh, reference, there / (there + back));
  result.hausdorff = largest(result.to_reference);
  if (options.both_ways) {
    result.from_reference = measure(reference, mesh, back / (there + back));
    result.hausdorff = std::max(result.hausdorff, largest(result.from_reference));
  }
  phases.finish();
  return result;
}

}  // namespace difmesh
