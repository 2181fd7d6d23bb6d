#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "metrics/surfaces.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;

double sphere(const Vec3& p) {
  return length(p) - 1.0;
}

TriangleMesh small() {
  return box_mesh({-1, -1, -1}, {1, 1, 1});
}

void check_equal(const DistanceStatistics& a, const DistanceStatistics& b) {
  CHECK(a.points == b.points);
  CHECK(a.rms == b.rms);
  CHECK(a.mean == b.mean);
  CHECK(a.signed_mean == b.signed_mean);
  CHECK(a.lowest == b.lowest);
  CHECK(a.highest == b.highest);
  CHECK(a.maximum == b.maximum);
  CHECK(a.maximum_index == b.maximum_index);
  CHECK(a.maximum_position == b.maximum_position);
}

void check_equal(const Distance& a, const Distance& b) {
  check_equal(a.vertices, b.vertices);
  check_equal(a.facets, b.facets);
  CHECK(a.area == b.area);
  CHECK(a.reach == b.reach);
  CHECK(a.has_sign == b.has_sign);
}

std::pair<ErrorCode, std::string> failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  FAIL("no error was thrown");
  return {};
}

/// The call fails with this code, and the message holds these words.
void check_failure(const std::function<void()>& call, ErrorCode code,
                   const std::vector<std::string>& words) {
  const auto failure = failure_of(call);
  const std::string& message = failure.second;
  CAPTURE(message);
  CHECK(failure.first == code);
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(message.find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("no bit depends on the number of threads or on the progress") {
  const Motion motion{unit({1, 2, 3}), 0.3, {0.02, 0.01, -0.03}};
  const TriangleMesh mesh = icosphere(4);
  const TriangleMesh reference = motion.forth(icosphere(5));
  DistanceOptions options;
  options.threads = 1;
  const Distance shape_first = distance_of(mesh, sphere, options);
  const MeshDistance first = distance_of(mesh, reference, options);
  for (const int threads : {2, 3, 8, 0}) {
    CAPTURE(threads);
    options.threads = threads;
    options.progress = threads == 3 ? Progress{[](double) { return true; }} : Progress{};
    check_equal(shape_first, distance_of(mesh, sphere, options));
    const MeshDistance again = distance_of(mesh, reference, options);
    check_equal(first.to_reference, again.to_reference);
    check_equal(first.from_reference, again.from_reference);
    CHECK(first.hausdorff == again.hausdorff);
  }
}

TEST_CASE("the overloads for meshes give the same") {
  const TriangleMesh box = small();
  const TriangleMesh ball = icosphere(2);
  Mesh mesh;
  mesh.positions.assign(box.positions.begin(), box.positions.end());
  mesh.triangles.assign(box.triangles.begin(), box.triangles.end());
  Mesh reference;
  reference.positions.assign(ball.positions.begin(), ball.positions.end());
  reference.triangles.assign(ball.triangles.begin(), ball.triangles.end());
  check_equal(distance(mesh, sphere), distance_of(box, sphere));
  check_equal(distance(mesh, reference).from_reference, distance_of(box, ball).from_reference);
}

TEST_CASE("meshes that cannot be measured are refused by name") {
  const auto code = ErrorCode::invalid_argument;
  const TriangleMesh good = small();
  const auto with_shape = [](const TriangleMesh& mesh) { (void)distance_of(mesh, sphere); };
  const auto as_mesh_of_two = [&](const TriangleMesh& mesh) { (void)distance_of(mesh, good); };
  const auto as_reference = [&](const TriangleMesh& mesh) { (void)distance_of(good, mesh); };
  const std::vector<std::pair<std::function<void(const TriangleMesh&)>, std::string>> ways{
      {with_shape, "mesh"}, {as_mesh_of_two, "mesh"}, {as_reference, "reference"}};
  for (const auto& way : ways) {
    const auto& call = way.first;
    const std::string& name = way.second;
    check_failure([&] { call({}); }, code, {name, "empty"});
    check_failure([&] { call({{{0, 0, 0}}, {}}); }, code, {name, "empty"});
    TriangleMesh bad = good;
    bad.triangles[5][2] = 8;
    check_failure([&] { call(bad); }, code, {name, "triangle 5", "vertex 8"});
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      bad = good;
      bad.positions[6][1] = value;
      check_failure([&] { call(bad); }, code, {name, "vertex 6", "not finite"});
    }
  }
  const TriangleMesh flat{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}, {0, 0, 1}}};
  check_failure([&] { with_shape(flat); }, code, {"mesh", "area 0"});
  check_failure([&] { as_reference(flat); }, code, {"reference", "area 0"});
  // As a reference that nothing is measured on, a line will do.
  DistanceOptions one_way;
  one_way.both_ways = false;
  CHECK(distance_of(good, flat, one_way).to_reference.vertices.points == 8);
}

TEST_CASE("options out of range are refused") {
  const auto code = ErrorCode::invalid_argument;
  DistanceOptions options;
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    options.facet_spacing = bad;
    check_failure([&] { (void)distance_of(small(), sphere, options); }, code, {"facet_spacing"});
    check_failure([&] { (void)distance_of(small(), small(), options); }, code, {"facet_spacing"});
  }
  options.facet_spacing = 1e-5;
  check_failure([&] { (void)distance_of(small(), sphere, options); }, code,
                {"facet_spacing", "triangle 0"});
  options = {};
  options.threads = -1;
  check_failure([&] { (void)distance_of(small(), sphere, options); }, code, {"threads"});
  check_failure([&] { (void)distance_of(small(), SignedDistance{}); }, code, {"empty"});
}

TEST_CASE("a shape without a distance is refused at the first such point") {
  const TriangleMesh ball = icosphere(4);
  const std::size_t first = 1234;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    const auto at_vertices = [&](const Vec3& p) {
      const auto v = std::find(ball.positions.begin(), ball.positions.end(), p);
      return static_cast<std::size_t>(v - ball.positions.begin()) >= first ? bad : 0.0;
    };
    const auto off_vertices = [&](const Vec3& p) { return length(p) < 1.0 - 1e-9 ? bad : 0.0; };
    for (const int threads : {1, 4}) {
      DistanceOptions options;
      options.threads = threads;
      const std::string value = std::isnan(bad) ? "nan" : "-inf";
      check_failure([&] { (void)distance_of(ball, at_vertices, options); },
                    ErrorCode::invalid_value, {"vertex " + std::to_string(first) + " ", value});
      check_failure([&] { (void)distance_of(ball, off_vertices, options); },
                    ErrorCode::invalid_value, {"triangle 0 ", value});
    }
  }
}

TEST_CASE("what the function throws passes through") {
  for (const int threads : {1, 4}) {
    DistanceOptions options;
    options.threads = threads;
    const auto shape = [](const Vec3& p) -> double {
      if (p[2] > 0.9) {
        throw std::out_of_range("too high");
      }
      return 0.0;
    };
    CHECK_THROWS_AS((void)distance_of(icosphere(3), shape, options), std::out_of_range);
  }
}

TEST_CASE("progress rises to one on the calling thread and cancels") {
  const TriangleMesh mesh = icosphere(4);
  std::vector<double> shares;
  DistanceOptions options;
  options.progress = [&](double share) {
    shares.push_back(share);
    return true;
  };
  (void)distance_of(mesh, mesh, options);
  CHECK(shares.size() > 20);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.back() == 1.0);
  options.progress = [](double share) { return share < 0.5; };
  check_failure([&] { (void)distance_of(mesh, mesh, options); }, ErrorCode::cancelled, {});
  check_failure([&] { (void)distance_of(mesh, sphere, options); }, ErrorCode::cancelled, {});
}

TEST_CASE("calls from several threads do not meet") {
  const TriangleMesh mesh = icosphere(3);
  const TriangleMesh reference = Motion{unit({1, 1, 2}), 0.2, {0.1, 0, 0}}.forth(icosphere(3));
  const MeshDistance alone = distance_of(mesh, reference);
  std::vector<MeshDistance> found(8);
  std::vector<std::thread> callers;
  for (MeshDistance& d : found) {
    callers.emplace_back([&] { d = distance_of(mesh, reference); });
  }
  for (std::thread& caller : callers) {
    caller.join();
  }
  for (const MeshDistance& d : found) {
    check_equal(d.to_reference, alone.to_reference);
    check_equal(d.from_reference, alone.from_reference);
  }
}

TEST_CASE("floating-point arithmetic is left as it was") {
  // The tree is built with denormal numbers flushed to zero; not so afterwards.
  (void)distance_of(small(), small());
  volatile float denormal = std::numeric_limits<float>::min();
  denormal = denormal / 8.0F;
  CHECK(denormal > 0.0F);
}
