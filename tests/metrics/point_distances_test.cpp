#include "difmesh/metrics/point_distances.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "difmesh/error.hpp"
#include "io/files.hpp"
#include "metrics/surfaces.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

Mesh mesh_of(const TriangleMesh& from) {
  Mesh mesh;
  mesh.positions.assign(from.positions.begin(), from.positions.end());
  mesh.triangles.assign(from.triangles.begin(), from.triangles.end());
  return mesh;
}

std::vector<Vec3> random_points(std::size_t count, double reach) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  std::vector<Vec3> points(count);
  for (Vec3& point : points) {
    point = {coordinate(random), coordinate(random), coordinate(random)};
  }
  return points;
}

}  // namespace

TEST_CASE("points are as far from a box as its formula says, inside and outside") {
  const Vec3 half{1.0, 0.75, 0.5};
  const Mesh box = mesh_of(box_mesh({-1.0, -0.75, -0.5}, half));
  const std::vector<Vec3> points = random_points(3000, 2.0);
  const PointDistances found = point_distances(points, box);
  CHECK(found.has_sign);
  REQUIRE(found.distances.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(found.distances[i] == doctest::Approx(box_distance(points[i], half)).epsilon(1e-13));
  }
}

TEST_CASE("far from the origin and small the distances are those found one by one") {
  const Vec3 shift{1e6, -2e6, 3e6};
  TriangleMesh ball = icosphere(2);
  for (Vec3& p : ball.positions) {
    p = add(scaled(p, 0x1p-10), shift);
  }
  std::vector<Vec3> points = random_points(100, 0x1p-9);
  for (Vec3& p : points) {
    p = add(p, shift);
  }
  const PointDistances found = point_distances(points, mesh_of(ball));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double wanted = brute_force_distance(points[i], ball);
    REQUIRE(std::abs(found.distances[i]) == doctest::Approx(wanted).epsilon(1e-9));
  }
}

TEST_CASE("without a closed reference or on demand distances have no sign") {
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  const std::vector<Vec3> points = random_points(200, 1.5);
  const PointDistances of_open = point_distances(points, mesh_of(open));
  CHECK(!of_open.has_sign);
  const Mesh ball = mesh_of(icosphere(1));
  DistanceOptions options;
  options.with_sign = false;
  const PointDistances found = point_distances(points, ball, options);
  const PointDistances signed_ones = point_distances(points, ball);
  CHECK(!found.has_sign);
  bool some_inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(of_open.distances[i] >= 0.0);
    REQUIRE(found.distances[i] == std::abs(signed_ones.distances[i]));
    some_inside = some_inside || signed_ones.distances[i] < 0.0;
  }
  CHECK(some_inside);
}

TEST_CASE("vertices have the distances that distance() has, on any number of threads") {
  const TriangleMesh mesh = icosphere(3);
  const TriangleMesh reference = box_mesh({-0.9, -0.8, -0.7}, {0.8, 0.9, 1.0});
  PointDistances first;
  for (const int threads : {1, 2, 3}) {
    DistanceOptions options;
    options.threads = threads;
    double last = 0.0;
    options.progress = [&last](double share) {
      CHECK(share >= last);
      last = share;
      return true;
    };
    const PointDistances found = point_distances(mesh.positions, mesh_of(reference), options);
    CHECK(last == 1.0);
    const DistanceStatistics wanted = distance_of(mesh, reference).to_reference.vertices;
    CHECK(difference(statistics_of({found.distances.begin(), found.distances.end()}), wanted) <
          1e-15);
    if (threads == 1) {
      first = found;
    }
    CHECK(found.distances == first.distances);
  }
}

TEST_CASE("points and references that cannot be measured are named") {
  const Mesh ball = mesh_of(icosphere(0));
  std::vector<Vec3> points(5, Vec3{0, 0, 0});
  CHECK(point_distances({}, ball).distances.empty());
  points[3][1] = std::numeric_limits<double>::quiet_NaN();
  ::test::check_error([&] { (void)point_distances(points, ball); }, ErrorCode::invalid_argument,
                      {"point 3", "not finite"});
  points[3][1] = 0.0;
  ::test::check_error([&] { (void)point_distances(points, Mesh{}); }, ErrorCode::invalid_argument,
                      {"reference", "empty"});
  Mesh torn = ball;
  torn.triangles[2][1] = 99;
  ::test::check_error([&] { (void)point_distances(points, torn); }, ErrorCode::invalid_argument,
                      {"triangle 2", "99"});
  DistanceOptions options;
  options.progress = [](double) { return false; };
  ::test::check_error([&] { (void)point_distances(points, ball, options); }, ErrorCode::cancelled,
                      {"cancelled"});
}
