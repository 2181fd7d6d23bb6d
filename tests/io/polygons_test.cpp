// Polygons of files as triangles: their edges and area are those of the polygon, whatever its
// shape.

#include "polygons.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "io/files.hpp"
#include "point_tree.hpp"

namespace {

using difmesh::Mesh;
using difmesh::Triangle;
using difmesh::Vec3;
using difmesh::detail::Point2;
using difmesh::detail::Polygons;

using Outline = std::vector<Point2>;

double area_of(const Outline& outline) {
  double area = 0.0;
  for (std::size_t c = 0; c < outline.size(); ++c) {
    const Point2& a = outline[c];
    const Point2& b = outline[(c + 1) % outline.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

Outline from_corner(const Outline& outline, std::size_t first) {
  Outline turned;
  for (std::size_t c = 0; c < outline.size(); ++c) {
    turned.push_back(outline[(first + c) % outline.size()]);
  }
  return turned;
}

struct Cut {
  Mesh mesh;
  Polygons::Report report;
};

Cut cut(const difmesh::Array<Vec3>& positions) {
  Cut result;
  result.mesh.positions = positions;
  std::vector<std::uint32_t> corners(positions.size());
  std::iota(corners.begin(), corners.end(), 0U);
  Polygons polygons;
  polygons.add(result.mesh.triangles, corners);
  result.report = polygons.cut("m.obj", result.mesh);
  return result;
}

/// In the plane z = 2 x + 3 y + 7, which keeps areas in its shadow on z = 0.
Vec3 lifted(const Point2& p) {
  return {p[0], p[1], 2 * p[0] + 3 * p[1] + 7};
}

/// Each edge of the outline once, each other edge once in each direction.
bool has_edges_of_outline(const difmesh::Array<Triangle>& triangles, std::size_t corners) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const Triangle& t : triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      ++count[{t[e], t[(e + 1) % 3]}];
    }
  }
  bool good = true;
  for (const auto& [edge, times] : count) {
    const bool is_side = (edge.first + 1) % corners == edge.second;
    const auto back = count.find({edge.second, edge.first});
    good = good && times == 1 && (back != count.end()) == !is_side;
  }
  return good;
}

/// Area and least area of the triangles seen along z.
struct Shadow {
  double area = 0.0;
  double least = HUGE_VAL;
};

Shadow shadow_of(const Mesh& mesh) {
  Shadow shadow;
  for (const Triangle& t : mesh.triangles) {
    const double area = area_of({{mesh.positions[t[0]][0], mesh.positions[t[0]][1]},
                                 {mesh.positions[t[1]][0], mesh.positions[t[1]][1]},
                                 {mesh.positions[t[2]][0], mesh.positions[t[2]][1]}});
    shadow.area += area;
    shadow.least = std::min(shadow.least, area);
  }
  return shadow;
}

/// From each corner on, both ways round: triangles that all face as the outline, and fill it. With
/// `may_be_flat` triangles without area may be among them.
void check_filled(const Outline& outline, bool may_be_flat = false) {
  const double area = area_of(outline);
  REQUIRE(area > 0.0);
  const std::size_t step = outline.size() < 40 ? 1 : outline.size() / 3;
  for (std::size_t first = 0; first < outline.size(); first += step) {
    for (const bool backward : {false, true}) {
      CAPTURE(first);
      CAPTURE(backward);
      Outline turned = from_corner(outline, first);
      if (backward) {
        std::reverse(turned.begin(), turned.end());
      }
      difmesh::Array<Vec3> positions;
      for (const Point2& p : turned) {
        positions.push_back(lifted(p));
      }
      const Cut result = cut(positions);
      CHECK(result.report.crossed == 0);
      CHECK(result.mesh.triangles.size() == outline.size() - 2);
      CHECK(has_edges_of_outline(result.mesh.triangles, outline.size()));
      Mesh seen = result.mesh;
      if (backward) {
        for (Triangle& t : seen.triangles) {
          std::swap(t[1], t[2]);
        }
      }
      const Shadow shadow = shadow_of(seen);
      CHECK(shadow.area == doctest::Approx(area).epsilon(1e-12));
      CHECK((may_be_flat ? shadow.least > -1e-15 * area : shadow.least > 0.0));
    }
  }
}

Outline star(std::size_t corners, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.05, 1.0);
  Outline outline;
  for (std::size_t c = 0; c < corners; ++c) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(c) / static_cast<double>(corners);
    const double r = radius(random);
    outline.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return outline;
}

/// A rectangle with teeth of different lengths, whose corners lie on straight lines.
Outline comb(std::size_t teeth) {
  Outline outline{{0, -1}, {2.0 * static_cast<double>(teeth), -1}};
  for (std::size_t t = teeth; t-- > 0;) {
    const double x = 2.0 * static_cast<double>(t);
    const double height = static_cast<double>(1 + t * 7 % 5);
    outline.push_back({x + 2, 0});
    outline.push_back({x + 1.5, height});
    outline.push_back({x + 1, height});
    outline.push_back({x + 1, 0});
  }
  outline.push_back({0, 0});
  return outline;
}

/// A strip wound up, so narrow that no triangle of a fan fits.
Outline spiral(std::size_t turns) {
  Outline outline;
  constexpr std::size_t kSteps = 24;
  const auto point = [](std::size_t n, double inset) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(n) / kSteps;
    const double r = 1.0 + angle / (2.0 * std::numbers::pi) - inset;
    return Point2{r * std::cos(angle), r * std::sin(angle)};
  };
  for (std::size_t n = 0; n <= turns * kSteps; ++n) {
    outline.push_back(point(n, 0.0));
  }
  for (std::size_t n = turns * kSteps + 1; n-- > 0;) {
    outline.push_back(point(n, 0.4));
  }
  return outline;
}

/// Lines through the middle of each side: corners on straight lines, exactly.
Outline with_middles(const Outline& outline) {
  Outline result;
  for (std::size_t c = 0; c < outline.size(); ++c) {
    const Point2& a = outline[c];
    const Point2& b = outline[(c + 1) % outline.size()];
    result.push_back(a);
    result.push_back({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])});
  }
  return result;
}

const Outline kDart{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};
const Outline kU{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};

}  // namespace

TEST_CASE("polygons that are not convex are filled from every corner on") {
  for (std::size_t first = 0; first < 4; ++first) {
    check_filled(from_corner(kDart, first));
  }
  check_filled(kU);
  check_filled(comb(1));
  check_filled(comb(9));
  check_filled(comb(200));
  for (std::uint32_t seed = 1; seed < 60; ++seed) {
    CAPTURE(seed);
    check_filled(star(4 + seed, seed));
  }
  check_filled(star(3000, 7));
}

TEST_CASE("spirals are filled") {
  for (const std::size_t turns : {std::size_t{1}, std::size_t{3}, std::size_t{20}}) {
    Outline outline = spiral(turns);
    if (area_of(outline) < 0.0) {
      std::reverse(outline.begin(), outline.end());
    }
    check_filled(outline);
  }
}

TEST_CASE("corners on straight lines give no triangles without area") {
  check_filled({{0, 0}, {1, 0}, {2, 0}, {0, 2}});
  check_filled(with_middles({{0, 0}, {2, 0}, {0, 2}}));
  check_filled(with_middles({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  check_filled(with_middles(with_middles(with_middles(kU))));
  check_filled(with_middles(with_middles(kDart)));
  check_filled(with_middles(comb(5)));
}

TEST_CASE("convex polygons stay fans about their first corner") {
  for (const std::size_t corners :
       {std::size_t{4}, std::size_t{5}, std::size_t{17}, std::size_t{1000}}) {
    difmesh::Array<Vec3> positions;
    for (std::size_t c = 0; c < corners; ++c) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(c) / static_cast<double>(corners);
      positions.push_back(lifted({1e-3 * std::cos(angle), 1e-3 * std::sin(angle)}));
    }
    const Cut result = cut(positions);
    REQUIRE(result.mesh.triangles.size() == corners - 2);
    for (std::uint32_t t = 0; t < corners - 2; ++t) {
      REQUIRE(result.mesh.triangles[t] == Triangle{0, t + 1, t + 2});
    }
  }
}

TEST_CASE("polygons may be bent a little and of any size and place") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  for (const double scale : {1e-300, 1e-160, 1e-3, 1.0, 1e150, 5e306}) {
    for (const double offset : {0.0, 17.0}) {
      CAPTURE(scale);
      CAPTURE(offset);
      difmesh::Array<Vec3> positions;
      Mesh unit;
      for (const Point2& p : kU) {
        const Vec3 at = lifted(p);
        const Vec3 bent{at[0] + noise(random), at[1] + noise(random), at[2] + noise(random)};
        unit.positions.push_back(bent);
        positions.push_back(
            {scale * (bent[0] + offset), scale * (bent[1] - offset), scale * bent[2]});
      }
      const Cut result = cut(positions);
      CHECK(result.report.crossed == 0);
      CHECK(has_edges_of_outline(result.mesh.triangles, kU.size()));
      unit.triangles = result.mesh.triangles;
      Outline outline;
      for (const Vec3& p : unit.positions) {
        outline.push_back({p[0], p[1]});
      }
      CHECK(shadow_of(unit).area == doctest::Approx(area_of(outline)));
      CHECK(shadow_of(unit).least > 0.0);
    }
  }
}

TEST_CASE("a hole that is tied in by a bridge stays a hole") {
  // The bridge is run along twice, so that two pairs of corners lie at the same places.
  check_filled({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 4}},
               true);
  check_filled(
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 4}, {2, 4}, {4, 6}, {6, 4}, {4, 2}, {2, 4}, {0, 4}},
      true);
}

TEST_CASE("corners at one place and spikes cost triangles without area only") {
  check_filled({{0, 0}, {0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
               true);
  check_filled({{0, 0},
                {3, 0},
                {3, 3},
                {2, 3},
                {2, 1},
                {1, 1},
                {1, 3},
                {0.5, 3},
                {0.5, 5},
                {0.5, 3},
                {0, 3}},
               true);
}

TEST_CASE("polygons without area or that cross themselves keep their edges and are counted") {
  const auto edges_stay = [](const Outline& outline, std::int64_t crossed) {
    difmesh::Array<Vec3> positions;
    for (const Point2& p : outline) {
      positions.push_back(lifted(p));
    }
    const Cut result = cut(positions);
    CHECK(result.report.crossed == crossed);
    CHECK(result.report.first_crossed == crossed - 1);
    CHECK(result.mesh.triangles.size() == outline.size() - 2);
    CHECK(has_edges_of_outline(result.mesh.triangles, outline.size()));
  };
  edges_stay({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 0}}, 0);
  edges_stay({{1, 1}, {1, 1}, {1, 1}, {1, 1}}, 0);
  edges_stay({{0, 0}, {4, 4}, {4, 0}, {0, 3}}, 1);
  // Any corners in any order, in the time that a simple one takes.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  Outline scribble;
  for (int c = 0; c < 5000; ++c) {
    scribble.push_back({place(random), place(random)});
  }
  edges_stay(scribble, 1);
}

TEST_CASE("a corner that comes twice in succession counts once") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Polygons polygons;
  const auto add = [&](const std::vector<std::uint32_t>& corners) {
    const std::size_t before = mesh.triangles.size();
    polygons.add(mesh.triangles, corners);
    return difmesh::Array<Triangle>(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(before),
                                    mesh.triangles.end());
  };
  const difmesh::Array<Triangle> square{{0, 1, 2}, {0, 2, 3}};
  CHECK(add({0, 1, 2, 3}) == square);
  CHECK(add({0, 1, 2, 3, 0}) == square);
  CHECK(add({0, 0, 1, 1, 1, 2, 3, 3, 0, 0}) == square);
  CHECK(add({0, 1, 1}) == difmesh::Array<Triangle>{{0, 1, 1}});
  CHECK(add({1, 1, 1, 1}).size() == 1);
  CHECK(add({0, 1, 0, 1}).size() == 2);
  CHECK(polygons.cut("m.obj", mesh).crossed == 0);
  CHECK(mesh.triangles.size() == 10);
}

TEST_CASE("many polygons of different sizes are each cut where they are") {
  Mesh mesh;
  Polygons polygons;
  double area = 0.0;
  std::mt19937 random(11);
  for (std::uint32_t n = 0; n < 500; ++n) {
    const Outline outline = star(3 + random() % 12, n);
    std::vector<std::uint32_t> corners;
    for (const Point2& p : outline) {
      corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(lifted(p));
    }
    area += area_of(outline);
    polygons.add(mesh.triangles, corners);
  }
  CHECK(polygons.cut("m.obj", mesh).crossed == 0);
  CHECK(shadow_of(mesh).area == doctest::Approx(area).epsilon(1e-12));
  CHECK(shadow_of(mesh).least > 0.0);
}

TEST_CASE("turns have the right sign where rounding hides it") {
  using difmesh::detail::turn;
  // Points of a straight line and their neighbours in the last place, in integers of 128 bits.
  std::mt19937_64 random(2);
  int zeros = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto whole = [&] { return static_cast<std::int64_t>(random() >> 12U); };
    const std::array<std::int64_t, 2> a{whole(), whole()};
    const std::array<std::int64_t, 2> b{whole(), whole()};
    std::array<std::int64_t, 2> c{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    c[0] += static_cast<std::int64_t>(random() % 3) - 1;
    __extension__ typedef __int128 Wide;
    const Wide exact = static_cast<Wide>(a[0] - c[0]) * (b[1] - c[1]) -
                       static_cast<Wide>(a[1] - c[1]) * (b[0] - c[0]);
    const auto point = [](const std::array<std::int64_t, 2>& p) {
      return Point2{std::ldexp(static_cast<double>(p[0]), -52),
                    std::ldexp(static_cast<double>(p[1]), -52)};
    };
    const double found = turn(point(a), point(b), point(c));
    REQUIRE((found > 0.0) == (exact > 0));
    REQUIRE((found < 0.0) == (exact < 0));
    zeros += exact == 0 ? 1 : 0;
  }
  CHECK(zeros > 0);
}

TEST_CASE("solids with faces that are not convex have their volume in every format") {
  const test::TempFolder folder;
  std::string points;
  for (const char* z : {"0", "1"}) {
    for (const Point2& p : kU) {
      points += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + z + "\n";
    }
  }
  std::vector<std::vector<int>> faces{{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (int c = 0; c < 8; ++c) {
    faces.push_back({c, (c + 1) % 8, (c + 1) % 8 + 8, c + 8});
  }
  std::string obj = "v " + points;
  for (std::size_t at = 0; (at = obj.find('\n', at)) + 1 < obj.size(); at += 3) {
    obj.insert(at + 1, "v ");
  }
  std::string off = "OFF\n16 10 0\n" + points;
  std::string early;
  for (const std::vector<int>& face : faces) {
    early += "f";
    off += std::to_string(face.size());
    for (const int v : face) {
      early += " " + std::to_string(v + 1);
      off += " " + std::to_string(v);
    }
    early += "\n";
    off += "\n";
  }
  // Faces before and after their vertices.
  struct Sample {
    std::string name;
    std::string text;
  };
  for (const Sample& sample :
       {Sample{"a.obj", obj + early}, Sample{"b.obj", early + obj}, Sample{"m.off", off}}) {
    CAPTURE(sample.name);
    const difmesh::Measure m =
        difmesh::measure(difmesh::read_mesh(folder.file(sample.name, sample.text)));
    CHECK(m.closed);
    CHECK(m.triangles == 28);
    CHECK(m.volume == doctest::Approx(7.0));
    CHECK(m.area == doctest::Approx(30.0));
  }
}
