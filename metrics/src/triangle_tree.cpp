#include "triangle_tree.hpp"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string>

#include "difmesh/error.hpp"
#ifdef DIFMESH_WITH_TBB
#include "base/arena_lease.hpp"
#endif

namespace difmesh::detail {
namespace {

// Silent, and without the 128 MB that it would set aside for subdivision surfaces.
constexpr const char* kDeviceSettings = "verbose=0,tessellation_cache_size=0";

// Of numbers whose inverse is finite.
constexpr int kLeastExponent = -1000;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// A query point is rounded to float32 by at most 2^-24 of each coordinate.
constexpr double kPointRounding = 0x1p-23;
// Distances from boxes, their squares and those of the radius take some eight more roundings.
constexpr double kDistanceRounding = 1.0 + 0x1p-20;
// Keeps squares clear of the denormal numbers; the boxes reach to 1 or 2.
constexpr double kLeastRadius = 0x1p-60;
// A point that is more radii of the surface away than kFar is looked at from kNear radii: in
// float32 the boxes hardly differ in their distance from the point itself. From kNear, rounding and
// the curvature of spheres take less than a thousandth of the radius.
constexpr double kFar = 0x1p11;
constexpr double kNear = 0x1p10;
// Of a distance in float64, and of the point's from the centre.
constexpr double kFarRounding = 0x1p-48;
// From here on the triangle that is nearest to a point at kNear will do: it is at most R / kNear
// further away than the nearest one, which is 2^-52 of the distance.
constexpr double kEndless = 0x1p42;
// From here on the sign is told at kNear. Between there and the point there is nothing.
constexpr double kFarSign = 0x1p24;

float below(double x) {
  return std::nextafter(static_cast<float>(x), -kInfinity);
}
float above(double x) {
  return std::nextafter(static_cast<float>(x), kInfinity);
}

/// Calls the body in an arena of at most `threads` threads: Embree takes its threads from the arena
/// that it is called in, and is in parallel by oneTBB even where the library is not.
template <class Body>
void with_threads([[maybe_unused]] int threads, const Body& body) {
#ifdef DIFMESH_WITH_TBB
  ArenaLease arena(threads);
  arena->execute(body);
#else
  tbb::task_arena arena(1);
  arena.execute(body);
#endif
}

/// A box that holds the triangle for sure.
void set_bounds(const Corners& corners, double zoom, RTCBounds& bounds) {
  Vec3 low = scaled(corners[0], zoom);
  Vec3 high = low;
  for (const Vec3& corner : corners) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], zoom * corner[axis]);
      high[axis] = std::max(high[axis], zoom * corner[axis]);
    }
  }
  bounds = {below(low[0]),  below(low[1]),  below(low[2]),  0.0F,
            above(high[0]), above(high[1]), above(high[2]), 0.0F};
}

/// The radius within which all boxes have to be visited to find all triangles within `distance` of
/// the centre, exact distances and float64 ones alike.
float search_radius(double distance, const Vec3& centre, double slack) {
  return above((distance + kPointRounding * length(centre) + slack) * kDistanceRounding +
               kLeastRadius);
}

RTCPointQuery query_at(const Vec3& centre, float radius) {
  RTCPointQuery query{};
  query.x = static_cast<float>(centre[0]);
  query.y = static_cast<float>(centre[1]);
  query.z = static_cast<float>(centre[2]);
  query.radius = radius;
  return query;
}

/// From where the boxes are searched for what is near a point: the point, or one between the two.
class Viewpoint {
 public:
  /// \param centre the point as seen from the middle of the boxes
  Viewpoint(const Vec3& centre, double radius, double zoom, double slack)
      : centre_(centre), surface_(radius), zoom_(zoom), slack_(slack), away_(length(centre)) {
    if (away_ > kFar * radius) {
      near_ = kNear * radius;
      centre_ = scaled(centre, near_ / away_);
    }
  }

  /// The radius within which all triangles are that lie within `distance` of the point.
  ///
  /// For a far point p, on the ray of unit vector u, and a point q of such a triangle: the distance
  /// is at least (p - q) u, so that q u >= s = |p| - distance. Seen from the viewpoint v = |v| u,
  /// |v - q|^2 = |v|^2 - 2 |v| q u + |q|^2 <= (|v| - s)^2 + R^2 - s^2, where R is the radius of the
  /// surface.
  [[nodiscard]] float radius(double distance) const {
    double reach = distance;
    if (near_ > 0.0) {
      const double rounding = kFarRounding * away_ + slack_;
      const double s = std::max(away_ - distance - rounding, -surface_);
      reach = std::sqrt((near_ - s) * (near_ - s) + std::max(0.0, surface_ * surface_ - s * s));
    }
    return search_radius(zoom_ * reach, scaled(centre_, zoom_), zoom_ * slack_);
  }
  [[nodiscard]] RTCPointQuery query(double distance) const {
    return query_at(scaled(centre_, zoom_), radius(distance));
  }

 private:
  Vec3 centre_;
  double surface_;
  double zoom_;
  double slack_;
  double away_;
  double near_ = 0.0;  ///< where the viewpoint is not the point: its distance from the middle
};

/// The search for the nearest triangle. Whatever the order of the visits, those at the least
/// distance are all among them, so the outcome is the same.
struct NearestSearch {
  const TriangleTree& tree;
  const Vec3& point;
  const Viewpoint& viewpoint;
  TriangleTree::Nearest best;

  /// Whether the triangle is the best so far.
  bool visit(std::uint32_t triangle) {
    const Vec3 way = closest_on_triangle(tree.corners(triangle, point));
    const double distance2 = squared_length(way);
    if (distance2 > best.distance2 || (distance2 == best.distance2 && triangle >= best.triangle)) {
      return false;
    }
    best = {triangle, way, distance2};
    return true;
  }
  [[nodiscard]] float radius() const { return viewpoint.radius(std::sqrt(best.distance2)); }
};

bool visit_nearest(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
  if (!search.visit(arguments->primID)) {
    return false;
  }
  // Never wider than before: Embree forbids it, and the radius hardly grows by rounding alone.
  arguments->query->radius = std::min(arguments->query->radius, search.radius());
  return true;
}

struct Collection {
  std::vector<std::uint32_t>& triangles;
  bool out_of_memory = false;
};

bool visit_all(RTCPointQueryFunctionArguments* arguments) {
  auto& collection = *static_cast<Collection*>(arguments->userPtr);
  try {
    collection.triangles.push_back(arguments->primID);
  } catch (const std::bad_alloc&) {
    // Embree would swallow the exception.
    collection.out_of_memory = true;
  }
  return false;
}

}  // namespace

void TriangleTree::ReleaseDevice::operator()(RTCDeviceTy* device) const noexcept {
  rtcReleaseDevice(device);
}
void TriangleTree::ReleaseScene::operator()(RTCSceneTy* scene) const noexcept {
  rtcReleaseScene(scene);
}

TriangleTree::TriangleTree(const SurfaceView& surface, int threads) : surface_(surface) {
  // The name of no triangle is kept free by Embree.
  if (surface.triangles.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::too_large, "distance: the " + std::string(surface.name) + " has " +
                                          std::to_string(surface.triangles.size()) +
                                          " triangles; 2^32 - 2 are possible");
  }
  const Box box = box_of(surface.positions);
  double half_side = 0.0;
  Vec3 half{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = surface.scale * box.low[axis];
    const double high = surface.scale * box.high[axis];
    centre_[axis] = 0.5 * low + 0.5 * high;
    half[axis] = 0.5 * high - 0.5 * low;
    half_side = std::max(half_side, half[axis]);
  }
  slack_ = 0x1p-40 * half_side;
  zoom_ = half_side > 0.0 ? std::ldexp(1.0, -std::max(std::ilogb(half_side), kLeastExponent)) : 1.0;
  radius_ = length(scaled(half, zoom_)) / zoom_ * kDistanceRounding;
  device_.reset(rtcNewDevice(kDeviceSettings));
  throw_failure("start");
  with_threads(threads, [this] { build(); });
  throw_failure("build its tree");
}

void TriangleTree::build() {
  scene_.reset(rtcNewScene(device_.get()));
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(surface_.triangles.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* arguments) {
        const auto& tree = *static_cast<const TriangleTree*>(arguments->geometryUserPtr);
        set_bounds(tree.corners(arguments->primID, tree.centre_), tree.zoom_, *arguments->bounds_o);
      },
      nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
}

void TriangleTree::throw_failure(const char* what) const {
  const RTCError code = rtcGetDeviceError(device_.get());
  if (code == RTC_ERROR_OUT_OF_MEMORY) {
    throw std::bad_alloc();
  }
  if (code != RTC_ERROR_NONE) {
    throw Error(ErrorCode::invalid_argument, std::string("distance: Embree could not ") + what +
                                                 "; its error code is " + std::to_string(code));
  }
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& point, std::uint32_t guess) const {
  if (const std::optional<Vec3> closer = from_nearby(point, kEndless)) {
    const std::uint32_t triangle = nearest(*closer, guess).triangle;
    const Vec3 way = closest_on_triangle(corners(triangle, point));
    return {triangle, way, squared_length(way)};
  }
  const Viewpoint viewpoint(minus(point, centre_), radius_, zoom_, slack_);
  const Vec3 way = closest_on_triangle(corners(guess, point));
  NearestSearch search{*this, point, viewpoint, {guess, way, squared_length(way)}};
  RTCPointQuery query = viewpoint.query(std::sqrt(search.best.distance2));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &query, &context, visit_nearest, &search);
  return search.best;
}

std::optional<Vec3> TriangleTree::from_nearby(const Vec3& point) const {
  return from_nearby(point, kFarSign);
}

std::optional<Vec3> TriangleTree::from_nearby(const Vec3& point, double radii) const {
  const Vec3 centre = minus(point, centre_);
  const double away = length(centre);
  if (!(away > radii * radius_)) {
    return std::nullopt;
  }
  // The middle keeps its digits: the sum is no further from it than kNear, rounding included twice.
  return plus(centre_, scaled(centre, kNear * radius_ / away));
}

void TriangleTree::collect(const Vec3& point, const Vec3& way, double radius,
                           std::vector<std::uint32_t>& triangles) const {
  triangles.clear();
  const Vec3 centre = plus(minus(point, centre_), way);
  Collection collection{triangles};
  const Vec3 zoomed = scaled(centre, zoom_);
  RTCPointQuery query = query_at(zoomed, search_radius(zoom_ * radius, zoomed, zoom_ * slack_));
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &query, &context, visit_all, &collection);
  if (collection.out_of_memory) {
    throw std::bad_alloc();
  }
  std::sort(triangles.begin(), triangles.end());
}

}  // namespace difmesh::detail
