#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "metrics/surfaces.hpp"

namespace {

using namespace difmesh;
using namespace difmesh::test;
using doctest::Approx;

#ifdef DIFMESH_SANITIZED
constexpr int kEffort = 1;
#else
constexpr int kEffort = 6;
#endif

DistanceOptions one_way() {
  DistanceOptions options;
  options.both_ways = false;
  return options;
}

std::vector<Vec3> random_points(Random& random, int count, double reach, const Vec3& centre) {
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    Vec3 p{};
    for (double& x : p) {
      x = random.uniform(-reach, reach);
    }
    points.push_back(add(p, centre));
  }
  return points;
}

/// Triangles of all shapes in [-1,1]: common ones, needles, caps, collinear ones and points.
TriangleMesh random_soup(Random& random, int count) {
  TriangleMesh soup;
  for (int n = 0; n < count; ++n) {
    const double size = std::exp2(random.uniform(-8.0, 0.0));
    const double thinness = std::exp2(random.uniform(-48.0, -20.0));
    const Vec3 a = random_points(random, 1, 1.0, {0, 0, 0})[0];
    const Vec3 u = scaled(random.direction(), size);
    const Vec3 v = scaled(random.direction(), size);
    Vec3 b = add(a, u);
    Vec3 c = add(a, v);
    switch (n % 8) {
      case 0:
        c = add(b, scaled(v, thinness));
        break;
      case 1:
        c = add(add(a, scaled(u, random.uniform(0.2, 0.8))), scaled(v, thinness));
        break;
      case 2:
        c = add(a, scaled(u, 0.5));
        break;
      case 3:
        c = n % 16 == 3 ? b : a;
        b = n % 32 == 3 ? a : b;
        break;
      default:
        break;
    }
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), {a, b, c});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Of these points, distances from the mesh one by one.
std::vector<double> brute_force_distances(const TriangleMesh& points, const TriangleMesh& mesh) {
  std::vector<double> distances;
  for (const Vec3& p : points.positions) {
    distances.push_back(brute_force_distance(p, mesh));
  }
  return distances;
}

/// A surface around the origin that every ray from there meets once, its corners in and out at
/// random.
TriangleMesh star(Random& random, int levels, double depth) {
  TriangleMesh mesh = icosphere(levels);
  for (Vec3& p : mesh.positions) {
    p = scaled(p, 1.0 + depth * random.uniform(-1.0, 1.0));
  }
  return mesh;
}

/// Whether a point lies in one of the tetrahedra over the triangles of a star about a centre, by
/// its coordinates there.
bool in_star(const Vec3& point, const TriangleMesh& mesh, const Vec3& centre) {
  const auto triple = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return dot(a, product(b, c));
  };
  const Vec3 p = subtract(point, centre);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = subtract(mesh.positions[t[0]], centre);
    const Vec3 b = subtract(mesh.positions[t[1]], centre);
    const Vec3 c = subtract(mesh.positions[t[2]], centre);
    const double whole = triple(a, b, c);
    const Vec3 share{triple(p, b, c) / whole, triple(a, p, c) / whole, triple(a, b, p) / whole};
    if (share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0) {
      return share[0] + share[1] + share[2] < 1.0;
    }
  }
  return false;
}

bool in_convex(const Vec3& p, const TriangleMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const Vec3& a = mesh.positions[t[0]];
    return dot(product(subtract(mesh.positions[t[1]], a), subtract(mesh.positions[t[2]], a)),
               subtract(p, a)) < 0.0;
  });
}

/// The same surface as a soup. One triangle at the edge between vertices 0 and 1 is cut in two
/// there, and a third one, without area, fills what gap there is.
TriangleMesh with_broken_edge(const TriangleMesh& mesh, const Vec3& broken) {
  TriangleMesh soup;
  const auto push = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    soup.append({{p, q, r}, {{0, 1, 2}}});
  };
  bool done = false;
  for (const Triangle& t : mesh.triangles) {
    const auto far = static_cast<std::size_t>(std::max_element(t.begin(), t.end()) - t.begin());
    const Vec3& apex = mesh.positions[t[far]];
    const Vec3& from = mesh.positions[t[(far + 1) % 3]];
    const Vec3& to = mesh.positions[t[(far + 2) % 3]];
    if (!done && t[(far + 1) % 3] + t[(far + 2) % 3] == 1) {
      push(apex, from, broken);
      push(apex, broken, to);
      push(from, to, broken);
      done = true;
    } else {
      push(apex, from, to);
    }
  }
  return soup;
}

std::optional<TriangleMesh> bunny() {
  const std::string path = std::string(DIFMESH_SHARED_DATA) + "/bunny00_75k.off";
  auto mesh = read_off(path);
  if (!mesh) {
    MESSAGE("skipped: no " << path);
  }
  return mesh;
}

}  // namespace

TEST_CASE("a cube and a cube moved along x are the shift apart") {
  const TriangleMesh cube = box_mesh({0, 0, 0}, {1, 1, 1});
  const MeshDistance d = distance_of(cube, box_mesh({0.25, 0, 0}, {1.25, 1, 1}));
  CHECK(d.to_reference.has_sign);
  CHECK(d.from_reference.has_sign);
  // Four corners stick out, the other four lie on edges.
  CHECK(d.to_reference.vertices.points == 8);
  CHECK(d.to_reference.vertices.rms == Approx(0.25 * std::sqrt(0.5)).epsilon(1e-15));
  CHECK(d.to_reference.vertices.mean == 0.125);
  CHECK(d.to_reference.vertices.highest == 0.25);
  CHECK(d.to_reference.vertices.lowest == 0.0);
  CHECK(d.to_reference.vertices.maximum_index == 0);
  CHECK(d.from_reference.vertices.highest == 0.25);
  CHECK(d.from_reference.vertices.maximum_index == 1);
  // The side at x = 1 lies within.
  CHECK(d.to_reference.facets.lowest == -0.25);
  CHECK(d.to_reference.facets.highest == 0.25);
  CHECK(d.hausdorff == 0.25);
}

TEST_CASE("distances from a turned box are those of its formula") {
  Random random(11);
  for (int n = 0; n < 4 * kEffort; ++n) {
    const Vec3 h{random.uniform(0.1, 1.0), random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)};
    const Motion motion{random.direction(), random.uniform(0.0, 3.0),
                        random_points(random, 1, 0.7, {0, 0, 0})[0]};
    const TriangleMesh box = motion.forth(box_mesh(scaled(h, -1.0), h));
    // Through the box and around it: facets, edges and corners of the box are all closest to some.
    const TriangleMesh ball = icosphere(3);
    const auto formula = [&](const Vec3& p) { return box_distance(motion.back(p), h); };
    const Distance expected = distance_of(ball, formula);
    const Distance found = distance_of(ball, box, one_way()).to_reference;
    CHECK(found.has_sign);
    CHECK(difference(found.vertices, expected.vertices) < 3e-15);
    CHECK(difference(found.facets, expected.facets) < 3e-15);
    CHECK(found.vertices.maximum_index == expected.vertices.maximum_index);
    CHECK(found.facets.maximum_index == expected.facets.maximum_index);
    CHECK(found.facets.points == expected.facets.points);
    // Inside out, outside is inside.
    const Distance inside_out = distance_of(ball, box.reversed(), one_way()).to_reference;
    CHECK(inside_out.vertices.signed_mean == Approx(-found.vertices.signed_mean).epsilon(1e-14));
    CHECK(inside_out.facets.lowest == Approx(-found.facets.highest).epsilon(1e-14));
    CHECK(inside_out.facets.highest == Approx(-found.facets.lowest).epsilon(1e-14));
    CHECK(inside_out.facets.rms == Approx(found.facets.rms).epsilon(1e-14));
  }
}

TEST_CASE("distances from soups of slivers and points are those found one by one") {
  Random random(5);
  const TriangleMesh soup = random_soup(random, 300 * kEffort);
  // Around the soup, and close to its triangles and their corners.
  std::vector<Vec3> points = random_points(random, 100 * kEffort, 1.5, {0, 0, 0});
  for (const auto& [a, b, c] : soup.triangles) {
    const double s = random.uniform();
    const double t = random.uniform();
    const Vec3 on =
        add(scaled(soup.positions[a], s * t),
            add(scaled(soup.positions[b], s * (1.0 - t)), scaled(soup.positions[c], 1.0 - s)));
    points.push_back(add(on, scaled(random.direction(), std::exp2(random.uniform(-50.0, -3.0)))));
    points.push_back(random.uniform() < 0.5 ? soup.positions[b] : on);
  }
  const TriangleMesh mesh = as_mesh(std::move(points));
  const std::vector<double> expected = brute_force_distances(mesh, soup);
  const Distance found = distance_of(mesh, soup, one_way()).to_reference;
  CHECK_FALSE(found.has_sign);
  CHECK(difference(found.vertices, statistics_of(expected)) < 1e-14);
  // Means hide a single wrong point: one triangle at a time.
  double worst = 0.0;
  for (std::size_t t = 0; t + 2 < mesh.positions.size(); t += 3) {
    const TriangleMesh one{{mesh.positions[t], mesh.positions[t + 1], mesh.positions[t + 2]},
                           {{0, 1, 2}}};
    const auto each = distance_of(one, soup, one_way()).to_reference.vertices;
    const auto three = statistics_of({expected[t], expected[t + 1], expected[t + 2]});
    worst = std::max(worst, difference(each, three));
    if (t > 600) {
      break;
    }
  }
  CHECK(worst < 1e-13);
}

TEST_CASE("far from the origin and at any size no digit is lost") {
  struct Place {
    double size;
    double offset;
  };
  for (const Place& place : {Place{1e-6, 0.0}, Place{1e6, 0.0}, Place{1.0, 1e6}, Place{1e-6, 1e6},
                             Place{1e-6, 1e-6}, Place{1e150, 0.0}, Place{1e-250, 0.0}}) {
    CAPTURE(place.size);
    CAPTURE(place.offset);
    Random random(3);
    const Vec3 offset{place.offset, -0.7 * place.offset, 0.3 * place.offset};
    const auto put = [&](TriangleMesh mesh) {
      for (Vec3& p : mesh.positions) {
        p = add(scaled(p, place.size), offset);
      }
      return mesh;
    };
    // Rounding moves the points; what is compared is between those that are there.
    const TriangleMesh soup = put(random_soup(random, 60 * kEffort));
    const TriangleMesh mesh = put(as_mesh(random_points(random, 90, 1.5, {0, 0, 0})));
    const Distance found = distance_of(mesh, soup, one_way()).to_reference;
    const DistanceStatistics expected = statistics_of(brute_force_distances(mesh, soup));
    CHECK(difference(found.vertices, expected) < 3e-15 * place.size);
    CHECK(found.vertices.maximum_index == expected.maximum_index);
  }
}

TEST_CASE("surfaces closer together than float32 can tell are told apart") {
  // Sheets 1e-10 to 1e-8 apart in no order, and one that keeps the others off the middle of it all.
  Random random(41);
  for (int n = 0; n < 4 * kEffort; ++n) {
    const double gap = std::pow(10.0, random.uniform(-10.0, -8.0));
    TriangleMesh sheets{{{-3, -3, -1}, {3, -3, -1}, {0, 5, -1}}, {{0, 1, 2}}};
    const double height = random.uniform(0.3, 1.0);
    for (int k = 0; k < 60; ++k) {
      const double z = height + gap * ((k * 37) % 60);
      sheets.append({{{-3, -3, z}, {3, -3, z}, {0, 5, z}}, {{0, 1, 2}}});
    }
    std::vector<Vec3> points = random_points(random, 60, 1.0, {0, 0, height + 1.0});
    for (const Vec3& p : random_points(random, 60, 1.0, {0, 0, 0})) {
      points.push_back({p[0], p[1], height + 1e-6 * p[2]});
    }
    const TriangleMesh mesh = as_mesh(std::move(points));
    const Distance found = distance_of(mesh, sheets, one_way()).to_reference;
    const DistanceStatistics expected = statistics_of(brute_force_distances(mesh, sheets));
    CHECK(difference(found.vertices, expected) < 2e-15);
  }
}

TEST_CASE("a mesh many sizes away from its reference is measured all the same") {
  Random random(17);
  const TriangleMesh soup = random_soup(random, 200);
  for (const double away : {1e2, 1e3, 1.3e3, 5e3, 1e5, 1e7, 1e9, 1e12, 1e14, 1e20, 1e60, 1e130}) {
    CAPTURE(away);
    const TriangleMesh mesh =
        as_mesh(random_points(random, 30, 0.1 * away, {away, 2.0 * away, -away}));
    const std::vector<double> expected = brute_force_distances(mesh, soup);
    const Distance found = distance_of(mesh, soup, one_way()).to_reference;
    CHECK(difference(found.vertices, statistics_of(expected)) < 1e-15 * away);
  }
}

TEST_CASE("large meshes far apart are measured at once and with the right sign") {
  Random random(29);
  for (const double away : {3e4, 1e8, 1e11, 1e13}) {
    CAPTURE(away);
    // Triangle by triangle the large ones would be some 4e9 distances.
    const int levels = away == 1e8 ? 4 + kEffort / 6 : 3;
    const TriangleMesh near = star(random, levels, 0.2);
    const Vec3 shift = scaled({0.48, -0.6, 0.64}, away);
    TriangleMesh far = icosphere(levels);
    for (Vec3& p : far.positions) {
      p = add(p, shift);
    }
    const MeshDistance found = distance_of(far, near);
    for (const Distance& way : {found.to_reference, found.from_reference}) {
      CHECK(way.has_sign);
      CHECK(way.vertices.lowest > away - 2.3);
      CHECK(way.vertices.highest < away + 2.3);
    }
  }
}

TEST_CASE("inside and outside of a spiky surface are told apart everywhere") {
  Random random(23);
  for (int n = 0; n < kEffort; ++n) {
    // Every second time small and far away, where rounding makes it a little spikier.
    const double size = n % 2 == 0 ? 1.0 : 1e-6;
    const Vec3 offset = n % 2 == 0 ? Vec3{0, 0, 0} : Vec3{1e6, -7e5, 3e5};
    const auto put = [&](const Vec3& p) { return add(scaled(p, size), offset); };
    TriangleMesh body = star(random, 2, n % 3 == 0 ? 0.1 : 0.45);
    std::vector<Vec3> points = random_points(random, 600, 1.6, {0, 0, 0});
    // Near corners and edges the closest point is mostly one of theirs.
    for (const auto& [a, b, c] : body.triangles) {
      const Vec3 middle = scaled(add(body.positions[a], body.positions[b]), 0.5);
      points.push_back(
          add(body.positions[c], scaled(random.direction(), random.uniform(0.0, 0.1))));
      points.push_back(add(middle, scaled(random.direction(), random.uniform(0.0, 0.05))));
    }
    TriangleMesh mesh = as_mesh(std::move(points));
    std::transform(mesh.positions.begin(), mesh.positions.end(), mesh.positions.begin(), put);
    std::transform(body.positions.begin(), body.positions.end(), body.positions.begin(), put);
    std::vector<double> expected = brute_force_distances(mesh, body);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expected[i] *= in_star(mesh.positions[i], body, offset) ? -1.0 : 1.0;
    }
    const Distance found = distance_of(mesh, body, one_way()).to_reference;
    CHECK(found.has_sign);
    // One wrong sign of the 1,200 would show unless the point is within 1e-11 of the surface.
    CHECK(difference(found.vertices, statistics_of(expected)) < 1e-14 * size);
  }
}

TEST_CASE("the sign needs neither shared vertices nor triangles of good shape") {
  Random random(2);
  for (int n = 0; n < 8 * kEffort; ++n) {
    // The second time on, the vertex on the edge is off it by rounding.
    const Motion motion{random.direction(), n == 0 ? 0.0 : random.uniform(0.1, 3.0)};
    const double share = n == 0 ? 0.625 : random.uniform(0.1, 0.9);
    const std::array<Vec3, 4> corners{motion.forth({-1, 0, 0}), motion.forth({1, 0, 0}),
                                      motion.forth({0, 1, 0.1}), motion.forth({0, 1, -0.1})};
    const Vec3 broken = add(scaled(corners[0], 1.0 - share), scaled(corners[1], share));
    const TriangleMesh wedge = tetrahedron_mesh(corners);
    const TriangleMesh soup = with_broken_edge(wedge, broken);
    CHECK(soup.triangles.size() == 6);
    std::vector<Vec3> points = random_points(random, 150, 1.5, {0, 0, 0});
    // In front of the sharp edge, above and below it, along it and next to the vertex in it.
    for (int k = 0; k < 150; ++k) {
      const double height = random.uniform(-0.2, 0.2);
      const double x = k % 3 == 0 ? 2.0 * share - 1.0 : random.uniform(-0.9, 0.9);
      points.push_back(motion.forth({x, -random.uniform(0.001, 1.0) * std::abs(height), height}));
    }
    const TriangleMesh mesh = as_mesh(std::move(points));
    std::vector<double> expected = brute_force_distances(mesh, wedge);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expected[i] *= in_convex(mesh.positions[i], wedge) ? -1.0 : 1.0;
    }
    for (const TriangleMesh& reference : {wedge, soup}) {
      const Distance found = distance_of(mesh, reference, one_way()).to_reference;
      CHECK(found.has_sign);
      CHECK(difference(found.vertices, statistics_of(expected)) < 1e-14);
    }
  }
}

TEST_CASE("solids that touch along an edge keep their sign") {
  TriangleMesh pair = box_mesh({-1, -1, 0}, {0, 0, 1});
  pair.append(box_mesh({0, 0, 0}, {1, 1, 1}));
  Random random(29);
  const TriangleMesh mesh = as_mesh(random_points(random, 900, 0.3, {0, 0, 0.5}));
  std::vector<double> expected = brute_force_distances(mesh, pair);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    expected[i] *= (p[0] < 0.0) == (p[1] < 0.0) ? -1.0 : 1.0;
  }
  const Distance found = distance_of(mesh, pair, one_way()).to_reference;
  CHECK(found.has_sign);
  CHECK(difference(found.vertices, statistics_of(expected)) < 1e-14);
}

TEST_CASE("a reference that bounds nothing gives no sign") {
  const TriangleMesh ball = icosphere(1);
  TriangleMesh open = box_mesh({-2, -2, -2}, {2, 2, 2});
  TriangleMesh mixed = open;
  std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
  open.triangles.pop_back();
  for (const TriangleMesh& reference : {open, mixed}) {
    const MeshDistance d = distance_of(ball, reference);
    CHECK_FALSE(d.to_reference.has_sign);
    CHECK(d.to_reference.vertices.lowest > 0.9);
    CHECK(d.from_reference.has_sign);
  }
  const TriangleMesh closed = box_mesh({-2, -2, -2}, {2, 2, 2});
  CHECK(distance_of(ball, closed).to_reference.vertices.highest < -0.9);
  DistanceOptions without = one_way();
  without.with_sign = false;
  const Distance d = distance_of(ball, closed, without).to_reference;
  CHECK_FALSE(d.has_sign);
  CHECK(d.vertices.lowest > 0.9);
}

TEST_CASE("one way alone does not see what the mesh lacks") {
  // The reference has a second body.
  const TriangleMesh ball = icosphere(2);
  TriangleMesh two = ball;
  two.append(Motion{{0, 0, 1}, 0.0, {5, 0, 0}}.forth(ball));
  const MeshDistance d = distance_of(ball, two);
  CHECK(d.to_reference.vertices.maximum == 0.0);
  CHECK(d.from_reference.vertices.maximum == Approx(5.0).epsilon(0.01));
  CHECK(d.hausdorff >= d.from_reference.vertices.maximum);
  const MeshDistance half = distance_of(ball, two, one_way());
  CHECK(half.hausdorff < 1e-15);
  CHECK(half.from_reference.vertices.points == 0);
  CHECK(half.from_reference.facets.maximum_index == -1);
}

TEST_CASE("the bunny is nowhere from itself and within the shift of its copy") {
  const auto mesh = bunny();
  if (!mesh) {
    return;
  }
  const MeshDistance self = distance_of(*mesh, *mesh);
  CHECK(self.to_reference.has_sign);
  CHECK(self.to_reference.vertices.points == 37706);
  CHECK(self.to_reference.vertices.maximum == 0.0);
  CHECK(self.from_reference.vertices.maximum == 0.0);
  CHECK(self.hausdorff < 2e-16);

  const Vec3 shift{0.003, -0.002, 0.001};
  const MeshDistance moved = distance_of(*mesh, Motion{{0, 0, 1}, 0.0, shift}.forth(*mesh));
  const double size = length(shift);
  for (const Distance& d : {moved.to_reference, moved.from_reference}) {
    CHECK(d.has_sign);
    CHECK(d.vertices.maximum <= size * (1.0 + 1e-12));
    CHECK(d.facets.maximum <= size * (1.0 + 1e-12));
    // Somewhere the surface faces along the shift, both ways.
    CHECK(d.facets.highest > 0.99 * size);
    CHECK(d.facets.lowest < -0.99 * size);
    // To first order d = ±shift·n, and the integral of shift·n over a closed surface is 0.
    CHECK(std::abs(d.facets.signed_mean) < 0.02 * size);
  }
  // To first order d² = (shift·n)²: the integral of that over the facets.
  double flux = 0.0;
  double area = 0.0;
  for (const auto& [a, b, c] : mesh->triangles) {
    const Vec3 normal = product(subtract(mesh->positions[b], mesh->positions[a]),
                                subtract(mesh->positions[c], mesh->positions[a]));
    const double twice = length(normal);
    area += 0.5 * twice;
    flux += 0.5 * dot(normal, shift) * dot(normal, shift) / twice;
  }
  CHECK(moved.to_reference.area == Approx(area).epsilon(1e-12));
  CHECK(moved.to_reference.facets.rms == Approx(std::sqrt(flux / area)).epsilon(0.05));
}

TEST_CASE("the bunny's distances are those found one by one") {
  const auto mesh = bunny();
  if (!mesh) {
    return;
  }
  Random random(31);
  const TriangleMesh points = as_mesh(random_points(random, 15 * kEffort, 0.6, {0, 0, 0}));
  DistanceOptions options = one_way();
  options.with_sign = false;
  const Distance found = distance_of(points, *mesh, options).to_reference;
  const DistanceStatistics expected = statistics_of(brute_force_distances(points, *mesh));
  CHECK(difference(found.vertices, expected) < 1e-15);
  CHECK(found.vertices.maximum_index == expected.maximum_index);
}
