#include "difmesh/measure.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"

namespace {

using difmesh::Measure;
using difmesh::Triangle;
using difmesh::Vec3;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  [[nodiscard]] Measure measure() const { return difmesh::measure(positions, triangles); }
};

Soup tetrahedron(const Vec3& at = {0, 0, 0}) {
  return {{at, {at[0] + 1, at[1], at[2]}, {at[0], at[1] + 1, at[2]}, {at[0], at[1], at[2] + 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A box with the corner (x + 2 y + 4 z) at each combination of low and high.
Soup box(const Vec3& low, const Vec3& size) {
  Soup soup;
  for (std::uint32_t n = 0; n < 8; ++n) {
    soup.positions.push_back({low[0] + ((n & 1) != 0 ? size[0] : 0.0),
                              low[1] + ((n & 2) != 0 ? size[1] : 0.0),
                              low[2] + ((n & 4) != 0 ? size[2] : 0.0)});
  }
  soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}

/// A regular m-gon of radius `tube` swept round a regular n-gon of radius `ring`.
Soup torus(std::uint32_t n, std::uint32_t m, double ring, double tube) {
  Soup soup;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double theta = 2.0 * std::numbers::pi * i / n;
    for (std::uint32_t j = 0; j < m; ++j) {
      const double phi = 2.0 * std::numbers::pi * j / m;
      const double rho = ring + tube * std::cos(phi);
      soup.positions.push_back(
          {rho * std::cos(theta), rho * std::sin(theta), tube * std::sin(phi)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = i * m + j;
      const std::uint32_t b = i * m + (j + 1) % m;
      const std::uint32_t c = ((i + 1) % n) * m + j;
      const std::uint32_t d = ((i + 1) % n) * m + (j + 1) % m;
      soup.triangles.push_back({a, c, b});
      soup.triangles.push_back({b, c, d});
    }
  }
  return soup;
}

/// Area of that torus: its faces are isosceles trapezoids.
double torus_area(std::uint32_t n, std::uint32_t m, double ring, double tube) {
  const double half_angle = std::numbers::pi / n;
  double area = 0.0;
  for (std::uint32_t j = 0; j < m; ++j) {
    const double phi0 = 2.0 * std::numbers::pi * j / m;
    const double phi1 = 2.0 * std::numbers::pi * (j + 1) / m;
    const double rho0 = ring + tube * std::cos(phi0);
    const double rho1 = ring + tube * std::cos(phi1);
    const double height =
        std::hypot(tube * (std::sin(phi1) - std::sin(phi0)), (rho1 - rho0) * std::cos(half_angle));
    area += n * (rho0 + rho1) * std::sin(half_angle) * height;
  }
  return area;
}

void append(Soup& soup, const Soup& other) {
  const auto shift = static_cast<std::uint32_t>(soup.positions.size());
  soup.positions.insert(soup.positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles) {
    soup.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
}

Soup read_off(const std::string& path) {
  std::ifstream in(path);
  std::string word;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t ignored = 0;
  in >> word >> vertices >> faces >> ignored;
  Soup soup;
  soup.positions.resize(vertices);
  soup.triangles.resize(faces);
  for (Vec3& p : soup.positions) {
    in >> p[0] >> p[1] >> p[2];
  }
  for (Triangle& t : soup.triangles) {
    in >> ignored >> t[0] >> t[1] >> t[2];
  }
  REQUIRE(in);
  return soup;
}

std::pair<difmesh::ErrorCode, std::string> failure_of(const Soup& soup) {
  try {
    (void)soup.measure();
  } catch (const difmesh::Error& error) {
    return {error.code(), error.what()};
  }
  FAIL("no error was thrown");
  return {};
}

}  // namespace

TEST_CASE("a tetrahedron has its closed-form area and volume and the topology of a ball") {
  const Measure m = tetrahedron().measure();
  CHECK(m.vertices == 4);
  CHECK(m.edges == 6);
  CHECK(m.triangles == 4);
  CHECK(m.components == 1);
  CHECK(m.euler_number == 2);
  CHECK(m.closed);
  CHECK(m.manifold);
  CHECK(m.volume == doctest::Approx(1.0 / 6.0).epsilon(1e-15));
  CHECK(m.area == doctest::Approx(1.5 + std::sqrt(3.0) / 2.0).epsilon(1e-15));
  CHECK(m.low == Vec3{0, 0, 0});
  CHECK(m.high == Vec3{1, 1, 1});
}

TEST_CASE("a box far from the origin keeps all digits of its volume") {
  // About the origin the terms would be 1e24 times the volume: nothing would be left of it.
  const Measure near = box({-1, -2, -3}, {2, 3, 5}).measure();
  const Measure far =
      box({1099511627776.0, -1099511627776.0, 1099511627776.0}, {2, 3, 5}).measure();
  for (const Measure& m : {near, far}) {
    CHECK(m.volume == doctest::Approx(30.0).epsilon(1e-15));
    CHECK(m.area == doctest::Approx(62.0).epsilon(1e-15));
    CHECK(m.vertices == 8);
    CHECK(m.edges == 18);
    CHECK(m.euler_number == 2);
    CHECK(m.closed);
    CHECK(m.manifold);
  }
  CHECK(near.low == Vec3{-1, -2, -3});
  CHECK(near.high == Vec3{1, 1, 2});
}

TEST_CASE("a box turned inside out has the opposite volume") {
  Soup soup = box({0, 0, 0}, {1, 1, 1});
  for (Triangle& t : soup.triangles) {
    std::swap(t[0], t[1]);
  }
  const Measure m = soup.measure();
  CHECK(m.volume == doctest::Approx(-1.0).epsilon(1e-15));
  CHECK(m.manifold);
}

TEST_CASE("a polygonal torus has its closed-form area and volume and Euler number 0") {
  const std::uint32_t n = 37;
  const std::uint32_t m_sides = 22;
  const double ring = 1.5;
  const double tube = 0.4;
  const Measure m = torus(n, m_sides, ring, tube).measure();
  // The horizontal sections are n-gons: Pappus with the area of an n-gon for that of a disc.
  const double volume = n * std::sin(2 * std::numbers::pi / n) * ring * 0.5 * m_sides * tube *
                        tube * std::sin(2 * std::numbers::pi / m_sides);
  CHECK(m.volume == doctest::Approx(volume).epsilon(1e-13));
  CHECK(m.area == doctest::Approx(torus_area(n, m_sides, ring, tube)).epsilon(1e-13));
  CHECK(m.euler_number == 0);
  CHECK(m.edges == 3 * n * m_sides);
  CHECK(m.components == 1);
  CHECK(m.closed);
  CHECK(m.manifold);
}

TEST_CASE("a torus without one triangle has three boundary edges and stays manifold") {
  Soup soup = torus(8, 6, 2.0, 0.5);
  soup.triangles.pop_back();
  const Measure m = soup.measure();
  CHECK(m.boundary_edges == 3);
  CHECK_FALSE(m.closed);
  CHECK(m.manifold);
  CHECK(m.euler_number == -1);
}

TEST_CASE("two bodies are two components whose volumes add") {
  Soup soup = tetrahedron();
  append(soup, box({5, 5, 5}, {1, 2, 3}));
  const Measure m = soup.measure();
  CHECK(m.components == 2);
  CHECK(m.euler_number == 4);
  CHECK(m.volume == doctest::Approx(6.0 + 1.0 / 6.0).epsilon(1e-14));
  CHECK(m.closed);
  CHECK(m.manifold);
}

TEST_CASE("two tetrahedra that share one vertex make it non-manifold") {
  Soup soup = tetrahedron();
  append(soup, tetrahedron({-3, -3, -3}));
  for (Triangle& t : soup.triangles) {
    for (std::uint32_t& v : t) {
      v = v == 4 ? 0 : v;
    }
  }
  const Measure m = soup.measure();
  CHECK(m.non_manifold_vertices == 1);
  CHECK(m.non_manifold_edges == 0);
  CHECK(m.components == 2);  // joined by a vertex is not joined by an edge
  CHECK(m.isolated_vertices == 1);
  CHECK(m.euler_number == 3);
  CHECK(m.closed);
  CHECK_FALSE(m.manifold);
}

TEST_CASE("two triangles that touch in one vertex make it non-manifold") {
  const Soup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                  {{0, 1, 2}, {0, 3, 4}}};
  const Measure m = soup.measure();
  CHECK(m.non_manifold_vertices == 1);
  CHECK(m.boundary_edges == 6);
  CHECK(m.components == 2);
  CHECK_FALSE(m.manifold);
}

TEST_CASE("a fan about a boundary vertex is manifold in any order of its triangles") {
  const Soup soup{{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-2, 0, 0}, {-1, -1, 0}},
                  {{0, 4, 5}, {0, 1, 2}, {0, 3, 4}, {0, 2, 3}}};
  const Measure m = soup.measure();
  CHECK(m.manifold);
  CHECK(m.boundary_edges == 6);
  CHECK(m.components == 1);
  CHECK(m.euler_number == 1);
}

TEST_CASE("three triangles on one edge make it and its two ends non-manifold") {
  const Soup soup{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                  {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}};
  const Measure m = soup.measure();
  CHECK(m.non_manifold_edges == 1);
  CHECK(m.non_manifold_vertices == 2);
  CHECK(m.misoriented_edges == 0);
  CHECK(m.boundary_edges == 6);
  CHECK(m.unbalanced_edges == 1);
  CHECK(m.components == 1);
  CHECK_FALSE(m.manifold);
  CHECK_FALSE(m.has_volume);
}

TEST_CASE("a flipped triangle is misoriented along its three edges") {
  Soup soup = box({0, 0, 0}, {1, 1, 1});
  std::swap(soup.triangles[4][1], soup.triangles[4][2]);
  const Measure m = soup.measure();
  CHECK(m.misoriented_edges == 3);
  CHECK(m.non_manifold_edges == 0);
  CHECK(m.non_manifold_vertices == 0);
  CHECK(m.closed);
  CHECK_FALSE(m.has_volume);
  CHECK_FALSE(m.manifold);
}

TEST_CASE("a face twice leaves no volume, twice and once back leaves it") {
  // Four vertices, of whose faces the slanted one comes twice.
  Soup soup = tetrahedron();
  soup.triangles.push_back({1, 2, 3});
  const Measure doubled = soup.measure();
  CHECK(doubled.non_manifold_edges == 3);
  CHECK(doubled.unbalanced_edges == 3);
  CHECK(doubled.boundary_edges == 0);
  CHECK_FALSE(doubled.closed);
  CHECK_FALSE(doubled.has_volume);
  CHECK_FALSE(doubled.manifold);

  soup.triangles.push_back({1, 3, 2});
  const Measure cancelled = soup.measure();
  CHECK(cancelled.non_manifold_edges == 3);
  CHECK(cancelled.unbalanced_edges == 0);
  CHECK(cancelled.closed);
  CHECK(cancelled.has_volume);
  CHECK(cancelled.volume == doctest::Approx(1.0 / 6.0).epsilon(1e-15));

  soup.triangles.back() = {1, 2, 3};  // three times the same way
  const Measure tripled = soup.measure();
  CHECK(tripled.unbalanced_edges == 3);
  CHECK(tripled.closed);  // four triangles on each edge
  CHECK_FALSE(tripled.has_volume);
}

TEST_CASE("two cubes that share an edge have the volume of two, turned apart none") {
  Soup soup = box({0, 0, 0}, {1, 1, 1});
  // The other's corners 0 and 4 are this one's 3 and 7.
  const std::vector<std::uint32_t> other{3, 8, 9, 10, 7, 11, 12, 13};
  for (const std::uint32_t n : {1U, 2U, 3U, 5U, 6U, 7U}) {
    soup.positions.push_back({1.0 + (n & 1), 1.0 + (n >> 1 & 1), static_cast<double>(n >> 2 & 1)});
  }
  for (const Triangle& t : box({0, 0, 0}, {1, 1, 1}).triangles) {
    soup.triangles.push_back({other[t[0]], other[t[1]], other[t[2]]});
  }
  const Measure balanced = soup.measure();
  CHECK(balanced.non_manifold_edges == 1);
  CHECK(balanced.unbalanced_edges == 0);
  CHECK(balanced.closed);
  CHECK(balanced.has_volume);
  CHECK(balanced.volume == doctest::Approx(2.0).epsilon(1e-15));
  CHECK(balanced.area == doctest::Approx(12.0).epsilon(1e-15));

  // One of the four triangles at the edge turned round: three run along it one way.
  for (Triangle& t : soup.triangles) {
    if (std::count(t.begin(), t.end(), 3U) == 1 && std::count(t.begin(), t.end(), 7U) == 1) {
      std::swap(t[1], t[2]);
      break;
    }
  }
  const Measure turned = soup.measure();
  CHECK(turned.closed);
  CHECK(turned.unbalanced_edges == 1);
  CHECK(turned.misoriented_edges == 2);
  CHECK_FALSE(turned.has_volume);
}

TEST_CASE("a box of split vertices is open by index and has its volume") {
  const Soup whole = box({-2, 1, 0}, {1, 2, 3});
  Soup split;
  for (const Triangle& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(split.positions.size());
    for (const std::uint32_t v : t) {
      split.positions.push_back(whole.positions[v]);
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  split.positions[2][2] = -0.0;  // which equals 0
  const Measure m = split.measure();
  CHECK(m.boundary_edges == 36);
  CHECK_FALSE(m.closed);
  CHECK(m.has_volume);
  CHECK(m.volume == doctest::Approx(6.0).epsilon(1e-15));

  split.positions[3][1] += 1e-15;  // a crack, however thin
  CHECK_FALSE(split.measure().has_volume);
  CHECK(whole.measure().has_volume);
}

TEST_CASE("triangles without area are counted and leave the topology right") {
  Soup soup = box({0, 0, 0}, {1, 1, 1});
  soup.triangles.push_back({3, 3, 7});
  soup.triangles.push_back({5, 5, 5});
  const Measure index_twice = soup.measure();
  CHECK(index_twice.triangles == 14);
  CHECK(index_twice.degenerate_triangles == 2);
  CHECK(index_twice.edges == 18);
  CHECK(index_twice.euler_number == 2);
  CHECK(index_twice.components == 1);
  CHECK(index_twice.closed);
  CHECK(index_twice.manifold);
  CHECK(index_twice.volume == doctest::Approx(1.0).epsilon(1e-15));

  // A point put into the edge 0-1 of a tetrahedron, seen by one of its faces only: a needle fills
  // it.
  const Soup needle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}},
                    {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 1, 4}}};
  const Measure m = needle.measure();
  CHECK(m.degenerate_triangles == 1);
  CHECK(m.closed);
  CHECK(m.manifold);
  CHECK(m.volume == doctest::Approx(1.0 / 6.0).epsilon(1e-15));
}

TEST_CASE("vertices in no triangle are isolated and widen the box only") {
  Soup soup = tetrahedron();
  soup.positions.push_back({9, -9, 0.5});
  const Measure m = soup.measure();
  CHECK(m.vertices == 5);
  CHECK(m.isolated_vertices == 1);
  CHECK(m.euler_number == 2);
  CHECK(m.volume == doctest::Approx(1.0 / 6.0).epsilon(1e-14));
  CHECK(m.low == Vec3{0, -9, 0});
  CHECK(m.high == Vec3{9, 1, 1});
}

TEST_CASE("the empty mesh is closed and measures nothing") {
  const Measure m = difmesh::measure(difmesh::Mesh{});
  CHECK(m.closed);
  CHECK(m.manifold);
  CHECK(m.vertices + m.edges + m.triangles + m.components + m.euler_number == 0);
  CHECK(m.area == 0.0);
  CHECK(m.volume == 0.0);
  CHECK(m.low == Vec3{0, 0, 0});
}

TEST_CASE("many small boxes far away keep the digits of their volumes") {
#ifdef DIFMESH_SANITIZED
  const int count = 2000;
#else
  const int count = 80000;
#endif
  Soup soup;
  for (int n = 0; n < count; ++n) {
    append(soup, box({3.0 * n, 7.0, -1e6}, {0.5, 0.25, 0.125}));
  }
  const Measure m = soup.measure();
  CHECK(m.components == count);
  CHECK(m.euler_number == 2 * count);
  CHECK(m.volume == doctest::Approx(count * 0.015625).epsilon(1e-12));
  CHECK(m.area == doctest::Approx(count * 0.4375).epsilon(1e-14));
}

TEST_CASE("an index out of range names its triangle") {
  Soup soup = tetrahedron();
  soup.triangles[2][1] = 4;
  const auto [code, message] = failure_of(soup);
  CHECK(code == difmesh::ErrorCode::invalid_argument);
  CHECK(message.find("triangle 2") != std::string::npos);
  CHECK(message.find("vertex 4") != std::string::npos);
}

TEST_CASE("a position that is not finite names its vertex") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    Soup soup = tetrahedron();
    soup.positions[3][1] = bad;
    const auto [code, message] = failure_of(soup);
    CHECK(code == difmesh::ErrorCode::invalid_argument);
    CHECK(message.find("vertex 3") != std::string::npos);
  }
}

TEST_CASE("meshes from elsewhere have their published counts and volumes") {
  struct Known {
    std::string file;
    std::int64_t vertices, triangles, euler_number;
    double volume;
  };
  for (const Known& known : {Known{"bunny00_75k.off", 37706, 75408, 2, 0.1992055537},
                             Known{"golfball_openscad_45k.off", 22379, 44754, 2, 3.704174810},
                             Known{"fandisk_cgal.off", 6475, 12946, 2, 0.1403603163},
                             Known{"knot1_genus1.off", 3200, 6400, 0, 0.09517472677}}) {
    const std::string path = std::string(DIFMESH_SHARED_DATA) + "/" + known.file;
    if (!std::ifstream(path)) {
      MESSAGE("skipped: no " << path);
      continue;
    }
    CAPTURE(known.file);
    const Measure m = read_off(path).measure();
    CHECK(m.vertices == known.vertices);
    CHECK(m.triangles == known.triangles);
    CHECK(m.euler_number == known.euler_number);
    CHECK(m.components == 1);
    CHECK(m.closed);
    CHECK(m.manifold);
    CHECK(m.volume == doctest::Approx(known.volume).epsilon(1e-9));
  }
}
