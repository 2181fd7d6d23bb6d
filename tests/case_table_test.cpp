// Geometry of the case table: loops, disks, faces, and triangles that never intersect. Positions
// are integers on a cell of kSide units, so that every sign below is exact.

#include "surface/case_table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace difmesh::detail;

namespace {

using Point = std::array<std::int64_t, 3>;
using TrianglePoints = std::array<Point, 3>;
using Side = std::pair<unsigned, unsigned>;

constexpr std::int64_t kSide = 1000;

struct Case {
  std::uint8_t corners;
  std::uint8_t joined;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (unsigned corners = 0; corners < 256; ++corners) {
    for (unsigned joined = 0; joined < 64; ++joined) {
      const unsigned faces = ambiguous_faces(static_cast<std::uint8_t>(corners));
      if ((joined & ~faces) != 0) continue;
      cases.push_back({static_cast<std::uint8_t>(corners), static_cast<std::uint8_t>(joined)});
    }
  }
  return cases;
}

bool inside(const Case& c, unsigned corner) {
  return ((c.corners >> corner) & 1U) != 0;
}

bool ambiguous(const Case& c, unsigned face) {
  const unsigned faces = ambiguous_faces(c.corners);
  return ((faces >> face) & 1U) != 0;
}

bool joined(const Case& c, unsigned face) {
  return ((c.joined >> face) & 1U) != 0;
}

Point corner_point(unsigned corner) {
  Point point{};
  for (unsigned axis = 0; axis < 3; ++axis)
    point[axis] = ((corner >> axis) & 1U) * kSide;
  return point;
}

Point edge_point(unsigned edge, std::int64_t t) {
  Point point = corner_point(edge_low_corner(edge));
  point[edge_axis(edge)] = t;
  return point;
}

// ---- Exact predicates ---------------------------------------------------------------------------

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::int64_t dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int sign(std::int64_t x) {
  return (x > 0) - (x < 0);
}

/// Side of the plane a, b, c on which d lies: 1 where the triangle looks counter-clockwise.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  return sign(dot(cross(minus(b, a), minus(c, a)), minus(d, a)));
}

/// Orientation of three points seen along one axis.
int turn(const Point& a, const Point& b, const Point& c, unsigned axis) {
  return sign(cross(minus(b, a), minus(c, a))[axis]);
}

unsigned widest_axis(const TrianglePoints& t) {
  const Point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  unsigned best = 0;
  for (unsigned axis = 1; axis < 3; ++axis) {
    if (std::abs(n[axis]) > std::abs(n[best])) best = axis;
  }
  return best;
}

bool same_side(int a, int b, int c) {
  return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0;
}

bool segments_meet(const Point& p, const Point& q, const Point& a, const Point& b, unsigned axis) {
  const int sides[4] = {turn(p, q, a, axis), turn(p, q, b, axis), turn(a, b, p, axis),
                        turn(a, b, q, axis)};
  if (sides[0] * sides[1] < 0 && sides[2] * sides[3] < 0) return true;
  const auto between = [](const Point& x, const Point& from, const Point& to) {
    return dot(minus(x, from), minus(x, to)) <= 0;
  };
  return (sides[0] == 0 && between(a, p, q)) || (sides[1] == 0 && between(b, p, q)) ||
         (sides[2] == 0 && between(p, a, b)) || (sides[3] == 0 && between(q, a, b));
}

/// True where the segment p, q, with no end among the triangle's vertices, has a point of the
/// triangle.
bool free_segment_meets(const Point& p, const Point& q, const TrianglePoints& t) {
  const int at_p = orientation(t[0], t[1], t[2], p);
  const int at_q = orientation(t[0], t[1], t[2], q);
  if (at_p * at_q > 0) return false;
  if (at_p != 0 || at_q != 0) {
    return same_side(orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]),
                     orientation(p, q, t[2], t[0]));
  }
  const unsigned axis = widest_axis(t);
  const bool holds_p =
      same_side(turn(t[0], t[1], p, axis), turn(t[1], t[2], p, axis), turn(t[2], t[0], p, axis));
  return holds_p || segments_meet(p, q, t[0], t[1], axis) ||
         segments_meet(p, q, t[1], t[2], axis) || segments_meet(p, q, t[2], t[0], axis);
}

/// A triangle with names of its vertices; equal names are equal points.
struct Named {
  std::array<unsigned, 3> names;
  TrianglePoints points;

  [[nodiscard]] unsigned place(unsigned name) const {
    return static_cast<unsigned>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

/// True where side i of `one` meets `other` beyond what the names tell.
bool side_meets(const Named& one, unsigned i, const Named& other) {
  unsigned from = i;
  unsigned to = (i + 1) % 3;
  if (other.place(one.names[from]) == 3) std::swap(from, to);
  const unsigned shared = other.place(one.names[from]);
  if (shared == 3) return free_segment_meets(one.points[from], one.points[to], other.points);
  const TrianglePoints& t = other.points;
  const Point& q = one.points[to];
  if (other.place(one.names[to]) != 3 || orientation(t[0], t[1], t[2], q) != 0) return false;
  const Point& a = t[shared];
  const Point& b = t[(shared + 1) % 3];
  const Point& c = t[(shared + 2) % 3];
  const unsigned axis = widest_axis(t);
  const int way = turn(a, b, c, axis);
  return turn(a, b, q, axis) * way >= 0 && turn(a, q, c, axis) * way >= 0;
}

/// The intersection of two triangles is spanned by points on their sides, so sides are all there is
/// to try.
bool intersect(const Named& one, const Named& other) {
  for (unsigned i = 0; i < 3; ++i) {
    if (side_meets(one, i, other) || side_meets(other, i, one)) return true;
  }
  return false;
}

// ---- Proof for all positions --------------------------------------------------------------------

/// A vertex anywhere on its edge (0..11), or corner c of the cell (12 + c).
using Site = unsigned;
enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1, mixed };

/// Sign of orientation() over all positions of the vertices, strictly between the ends of their
/// edges. The determinant is linear in each position, so its signs at the ends of the edges decide.
Sign sign_everywhere(const std::array<Site, 4>& sites) {
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      if (sites[i] == sites[j]) return Sign::zero;
    }
  }
  bool positive = false;
  bool negative = false;
  for (unsigned ends = 0; ends < 16 && !(positive && negative); ++ends) {
    std::array<Point, 4> p;
    for (unsigned i = 0; i < 4; ++i) {
      const bool high = ((ends >> i) & 1U) != 0;
      const Site s = sites[i];
      p[i] = s < 12 ? edge_point(s, high ? kSide : 0) : corner_point(s - 12);
    }
    const int side = orientation(p[0], p[1], p[2], p[3]);
    positive = positive || side > 0;
    negative = negative || side < 0;
  }
  if (positive && negative) return Sign::mixed;
  return positive ? Sign::positive : negative ? Sign::negative : Sign::zero;
}

/// Looks for planes that keep two triangles apart. Results are kept: the same few thousand come
/// again.
class Separator {
 public:
  /// True where a plane through three corners or vertices has one triangle strictly on one side,
  /// but for the vertices in common, and no point of the other on that side, for all positions.
  bool separates(const CubeTriangle& one, const CubeTriangle& other) {
    const auto [known, fresh] = pairs_.try_emplace({one, other}, false);
    if (!fresh) return known->second;
    std::set<Site> vertices(one.begin(), one.end());
    vertices.insert(other.begin(), other.end());
    std::vector<Site> sites{12, 13, 14, 15, 16, 17, 18, 19};
    sites.insert(sites.end(), vertices.begin(), vertices.end());
    for (std::size_t i = 2; i < sites.size() && !known->second; ++i) {
      for (std::size_t j = 1; j < i && !known->second; ++j) {
        for (std::size_t k = 0; k < j && !known->second; ++k) {
          known->second = plane_separates({sites[k], sites[j], sites[i]}, one, other);
        }
      }
    }
    return known->second;
  }

 private:
  bool plane_separates(const std::array<Site, 3>& plane, const CubeTriangle& one,
                       const CubeTriangle& other) {
    for (const Sign side : {Sign::positive, Sign::negative}) {
      const Sign beyond = side == Sign::positive ? Sign::negative : Sign::positive;
      if (on_side(plane, one, side, &other) && on_side(plane, other, beyond, nullptr)) return true;
      if (on_side(plane, other, side, &one) && on_side(plane, one, beyond, nullptr)) return true;
    }
    return false;
  }

  /// All vertices on that side or on the plane; on the plane, where `strict_but` is given, only
  /// vertices of that triangle.
  bool on_side(const std::array<Site, 3>& plane, const CubeTriangle& triangle, Sign side,
               const CubeTriangle* strict_but) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint8_t vertex) {
      const Sign at = sign_at(plane, vertex);
      if (at == side) return true;
      return at == Sign::zero &&
             (strict_but == nullptr ||
              std::find(strict_but->begin(), strict_but->end(), vertex) != strict_but->end());
    });
  }

  Sign sign_at(const std::array<Site, 3>& plane, Site site) {
    const std::array<Site, 4> sites{plane[0], plane[1], plane[2], site};
    const std::size_t key = ((plane[0] * 20U + plane[1]) * 20U + plane[2]) * 20U + site;
    if (signs_[key] == kUnknown) signs_[key] = static_cast<std::int8_t>(sign_everywhere(sites));
    return static_cast<Sign>(signs_[key]);
  }

  static constexpr std::int8_t kUnknown = 9;
  std::map<std::pair<CubeTriangle, CubeTriangle>, bool> pairs_;
  std::vector<std::int8_t> signs_ = std::vector<std::int8_t>(160000, kUnknown);
};

// ---- Contour ------------------------------------------------------------------------------------

unsigned other_end(unsigned edge, unsigned corner) {
  return edge_low_corner(edge) ^ edge_high_corner(edge) ^ corner;
}

/// Segments on one face, from the face alone, directed with the inside to the right seen from
/// outside the cell.
std::vector<Side> face_segments(const Case& c, unsigned face) {
  std::vector<unsigned> crossed;
  for (unsigned edge = 0; edge < kCubeEdges; ++edge) {
    const bool on_face = ((edge_faces(edge) >> face) & 1U) != 0;
    if (on_face && inside(c, edge_low_corner(edge)) != inside(c, edge_high_corner(edge))) {
      crossed.push_back(edge);
    }
  }
  Point outward{};
  outward[face / 2] = face % 2 == 1 ? 1 : -1;
  std::vector<Side> segments;
  for (const unsigned a : crossed) {
    for (const unsigned b : crossed) {
      if (a == b) continue;
      const unsigned in = inside(c, edge_low_corner(a)) ? edge_low_corner(a) : edge_high_corner(a);
      // With four crossings a segment cuts off one corner: an outside one where the face is joined.
      const unsigned cut = joined(c, face) ? other_end(a, in) : in;
      const bool cuts = cut == edge_low_corner(b) || cut == edge_high_corner(b);
      if (crossed.size() == 4 && !cuts) continue;
      const Point along = minus(edge_point(b, kSide / 2), edge_point(a, kSide / 2));
      const Point to_inside = minus(corner_point(in), edge_point(a, kSide / 2));
      if (dot(cross(along, to_inside), outward) < 0) segments.emplace_back(a, b);
    }
  }
  return segments;
}

std::set<Side> contour(const Case& c) {
  std::set<Side> sides;
  for (unsigned face = 0; face < kCubeFaces; ++face) {
    for (const Side& side : face_segments(c, face))
      sides.insert(side);
  }
  return sides;
}

std::map<Side, int> sides_of(CubeTriangles triangles) {
  std::map<Side, int> sides;
  for (const CubeTriangle& t : triangles) {
    for (unsigned i = 0; i < 3; ++i)
      ++sides[{t[i], t[(i + 1) % 3]}];
  }
  return sides;
}

/// Sides of triangles that are no segments of the contour, once per undirected pair.
std::vector<Side> diagonals(const Case& c) {
  const std::set<Side> segments = contour(c);
  std::vector<Side> found;
  for (const auto& [side, count] : sides_of(cube_triangles(c.corners, c.joined))) {
    if (side.first < side.second && !segments.contains(side) &&
        !segments.contains({side.second, side.first})) {
      found.push_back(side);
    }
  }
  return found;
}

}  // namespace

TEST_CASE("numbers of corners and edges and faces agree") {
  for (unsigned edge = 0; edge < kCubeEdges; ++edge) {
    const unsigned low = edge_low_corner(edge);
    const unsigned high = edge_high_corner(edge);
    CHECK((low ^ high) == 1U << edge_axis(edge));
    CHECK(low < high);
    CHECK(edge_between(low, high) == edge);
    CHECK(edge_between(high, low) == edge);
    for (unsigned face = 0; face < kCubeFaces; ++face) {
      const std::array<unsigned, 4> corners = face_corners(face);
      const auto holds = [&](unsigned c) { return std::count(corners.begin(), corners.end(), c); };
      CHECK((((edge_faces(edge) >> face) & 1U) != 0) == (holds(low) + holds(high) == 2));
    }
  }
  CHECK(edge_low_corner(4 * 0 + 2) == 4);  // along x, at y = 0 and z = 1
  CHECK(edge_low_corner(4 * 1 + 2) == 4);  // along y, at x = 0 and z = 1
  CHECK(edge_low_corner(4 * 2 + 2) == 2);  // along z, at x = 0 and y = 1
  for (unsigned face = 0; face < kCubeFaces; ++face) {
    const std::array<unsigned, 4> corners = face_corners(face);
    CHECK(std::is_sorted(corners.begin(), corners.end()));
    for (const unsigned corner : corners)
      CHECK(((corner >> (face / 2)) & 1U) == face % 2);
  }
}

TEST_CASE("crossed edges and ambiguous faces follow from the corners") {
  for (unsigned corners = 0; corners < 256; ++corners) {
    const Case c{static_cast<std::uint8_t>(corners), 0};
    unsigned crossed = 0;
    for (unsigned edge = 0; edge < kCubeEdges; ++edge) {
      const bool differ = inside(c, edge_low_corner(edge)) != inside(c, edge_high_corner(edge));
      crossed |= (differ ? 1U : 0U) << edge;
    }
    CHECK(crossed_edges(c.corners) == crossed);
    for (unsigned face = 0; face < kCubeFaces; ++face) {
      const bool four = face_segments(c, face).size() == 2;
      CHECK(ambiguous(c, face) == four);
    }
  }
  CHECK(all_cases().size() == kCubeDecisions);
}

TEST_CASE("one corner is cut off by a triangle that looks away from the inside") {
  for (unsigned corner = 0; corner < kCubeCorners; ++corner) {
    const CubeTriangles one = cube_triangles(static_cast<std::uint8_t>(1U << corner), 0);
    REQUIRE(one.size() == 1);
    const auto at = [&](unsigned i) { return edge_point(one[0][i], kSide / 3); };
    CHECK(orientation(at(0), at(1), at(2), corner_point(corner)) < 0);
  }
}

TEST_CASE("decisions of unambiguous faces are ignored") {
  for (const Case& c : all_cases()) {
    const unsigned noise = 0x3FU & ~static_cast<unsigned>(ambiguous_faces(c.corners));
    const auto noisy = static_cast<std::uint8_t>(c.joined | noise);
    CHECK(cube_triangles(c.corners, noisy).data() == cube_triangles(c.corners, c.joined).data());
  }
}

TEST_CASE("each loop of the contour is filled by one disk") {
  for (const Case& c : all_cases()) {
    CAPTURE(c.corners);
    CAPTURE(c.joined);
    const CubeTriangles triangles = cube_triangles(c.corners, c.joined);
    const std::set<Side> segments = contour(c);
    // Each segment once, each diagonal once in each direction: oriented surfaces bounded by the
    // contour.
    bool oriented = true;
    std::set<Side> bounding;
    for (const auto& [side, count] : sides_of(triangles)) {
      const bool paired = sides_of(triangles).contains({side.second, side.first});
      oriented = oriented && count == 1;
      if (!paired) bounding.insert(side);
    }
    CHECK(oriented);
    CHECK(bounding == segments);

    // Loops are the cycles of the contour; each crossed edge lies in one.
    std::map<unsigned, unsigned> next(segments.begin(), segments.end());
    unsigned edges = 0;
    for (const auto& [from, to] : next)
      edges |= 1U << from;
    CHECK(edges == crossed_edges(c.corners));
    CHECK(next.size() == segments.size());
    while (!next.empty()) {
      std::set<unsigned> loop;
      for (unsigned at = next.begin()->first; next.contains(at);) {
        loop.insert(at);
        const unsigned after = next[at];
        next.erase(at);
        at = after;
      }
      // A surface bounded by one cycle of n vertices needs n - 2 triangles at least, and needs more
      // if it is anything but a disk on these vertices.
      std::vector<CubeTriangle> filling;
      for (const CubeTriangle& t : triangles) {
        const auto foreign =
            std::count_if(t.begin(), t.end(), [&](unsigned v) { return !loop.contains(v); });
        CHECK((foreign == 0 || foreign == 3));
        if (foreign == 0) filling.push_back(t);
      }
      std::set<Side> lines;
      for (const auto& [side, count] : sides_of(filling))
        lines.insert(std::minmax(side.first, side.second));
      CHECK(filling.size() == loop.size() - 2);
      CHECK(static_cast<int>(loop.size() + filling.size()) - static_cast<int>(lines.size()) == 1);
    }
  }
}

TEST_CASE("exchanging inside and outside turns the triangles around") {
  for (const Case& c : all_cases()) {
    const CubeTriangles triangles = cube_triangles(c.corners, c.joined);
    const CubeTriangles turned =
        cube_triangles(static_cast<std::uint8_t>(~c.corners), static_cast<std::uint8_t>(~c.joined));
    CHECK(std::equal(triangles.begin(), triangles.end(), turned.begin(), turned.end(),
                     [](const CubeTriangle& a, const CubeTriangle& b) {
                       return a[0] == b[0] && a[1] == b[2] && a[2] == b[1];
                     }));
  }
}

TEST_CASE("two cells draw the same segments on their face and never the same diagonal") {
  int cases_with_face_diagonals = 0;
  for (const Case& c : all_cases()) {
    std::set<unsigned> faces;
    for (const auto& [a, b] : diagonals(c)) {
      const unsigned common = edge_faces(a) & edge_faces(b);
      if (common == 0) continue;
      const auto face = static_cast<unsigned>(std::countr_zero(common));
      const unsigned corners_of_b = (1U << edge_low_corner(b)) | (1U << edge_high_corner(b));
      const unsigned low = edge_low_corner(a);
      const unsigned corner = ((corners_of_b >> low) & 1U) != 0 ? low : edge_high_corner(a);
      CHECK(((corners_of_b >> corner) & 1U) != 0);
      CHECK(face_cut_allowed(face, corner));
      CHECK_FALSE(face_cut_allowed(face ^ 1U, corner ^ (1U << (face / 2))));
      CHECK(faces.insert(face).second);
    }
    cases_with_face_diagonals += faces.empty() ? 0 : 1;
  }
  CHECK(cases_with_face_diagonals == 152);

  // All cases that agree on a face, from either side of it, agree on its segments but for their
  // direction.
  std::map<std::array<unsigned, 3>, std::set<Side>> seen;
  for (const Case& c : all_cases()) {
    for (unsigned face = 0; face < kCubeFaces; ++face) {
      unsigned pattern = 0;
      for (const unsigned corner : face_corners(face))
        pattern = 2 * pattern + (inside(c, corner) ? 1U : 0U);
      const std::map<Side, int> sides = sides_of(cube_triangles(c.corners, c.joined));
      std::set<Side> drawn;
      for (const auto& [a, b] : face_segments(c, face)) {
        CHECK(sides.contains({a, b}));
        // Names by the edges of the low face: of an edge on the high face, the one below it.
        const auto below = [&](unsigned edge) {
          const unsigned low = edge_low_corner(edge) & ~(1U << (face / 2));
          return edge_between(low, low | (1U << edge_axis(edge)));
        };
        drawn.insert(face % 2 == 0 ? Side{below(a), below(b)} : Side{below(b), below(a)});
      }
      const unsigned decision = ambiguous(c, face) && joined(c, face) ? 1U : 0U;
      const auto [known, fresh] = seen.try_emplace({face / 2, pattern, decision}, drawn);
      CHECK(known->second == drawn);
    }
  }
  CHECK(seen.size() == 3 * (16 + 2));
}

TEST_CASE("a plane separates any two triangles of a cell for all positions of its vertices") {
  Separator separator;
  for (const Case& c : all_cases()) {
    const CubeTriangles triangles = cube_triangles(c.corners, c.joined);
    bool separated = true;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        separated = separated && separator.separates(triangles[i], triangles[j]);
      }
    }
    CAPTURE(c.corners);
    CAPTURE(c.joined);
    CHECK(separated);
  }
}

namespace {

/// A position that is often extreme.
std::int64_t draw_position(std::mt19937& random) {
  const std::array<std::int64_t, 3> special{1, kSide / 2, kSide - 1};
  const unsigned choice = static_cast<unsigned>(random() % 4);
  return choice < 3 ? special[choice] : 1 + static_cast<std::int64_t>(random() % (kSide - 1));
}

/// White noise on a block of cells: nodes inside or outside, faces joined or separated, all by
/// chance.
class NoiseMesh {
 public:
  static constexpr unsigned kCells = 4;

  explicit NoiseMesh(unsigned seed) : random_(seed) {
    for (auto& node : inside_)
      node = random_() % 2 == 0;
    for (auto& face : joined_)
      face = random_() % 2 == 0;
    for (auto& position : positions_)
      position = draw_position(random_);
    for (unsigned cell = 0; cell < kCells * kCells * kCells; ++cell)
      add_cell(cell);
  }

  /// Triangles by cell; the first corner of cell x + kCells * (y + kCells * z) is the node (x, y,
  /// z).
  std::vector<std::vector<Named>> cells;

  /// True for a dual edge on the outside of the block.
  [[nodiscard]] static bool is_open(unsigned name) {
    const std::array<unsigned, 3> node = split(name / 3, kNodes);
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (axis != name % 3 && (node[axis] == 0 || node[axis] == kCells)) return true;
    }
    return false;
  }

  [[nodiscard]] static std::array<unsigned, 3> split(unsigned index, unsigned n) {
    return {index % n, index / n % n, index / n / n};
  }

 private:
  static constexpr unsigned kNodes = kCells + 1;

  void add_cell(unsigned cell) {
    const std::array<unsigned, 3> base = split(cell, kCells);
    const auto node = [&](unsigned corner) {
      return base[0] + (corner & 1U) +
             kNodes * (base[1] + ((corner >> 1U) & 1U) + kNodes * (base[2] + (corner >> 2U)));
    };
    unsigned corners = 0;
    unsigned joined = 0;
    for (unsigned c = 0; c < kCubeCorners; ++c)
      corners |= (inside_[node(c)] ? 1U : 0U) << c;
    for (unsigned face = 0; face < kCubeFaces; ++face) {
      // A face has the name of its first node and its axis, from both its cells.
      const unsigned name = 3 * node((face % 2) << (face / 2)) + face / 2;
      joined |= (joined_[name] ? 1U : 0U) << face;
    }
    auto& triangles = cells.emplace_back();
    for (const CubeTriangle& t :
         cube_triangles(static_cast<std::uint8_t>(corners), static_cast<std::uint8_t>(joined))) {
      Named& named = triangles.emplace_back();
      for (unsigned i = 0; i < 3; ++i) {
        named.names[i] = 3 * node(edge_low_corner(t[i])) + edge_axis(t[i]);
        named.points[i] = edge_point(t[i], positions_[named.names[i]]);
        for (unsigned axis = 0; axis < 3; ++axis)
          named.points[i][axis] += kSide * base[axis];
      }
    }
  }

  std::mt19937 random_;
  std::array<bool, kNodes * kNodes * kNodes> inside_{};
  std::array<bool, 3 * kNodes * kNodes * kNodes> joined_{};
  std::array<std::int64_t, 3 * kNodes * kNodes * kNodes> positions_{};
};

}  // namespace

TEST_CASE("triangles of a cell do not intersect at random and extreme positions") {
  std::mt19937 random(1);
  for (const Case& c : all_cases()) {
    bool apart = true;
    for (int trial = 0; trial < 200; ++trial) {
      std::array<Point, kCubeEdges> vertices;
      for (unsigned edge = 0; edge < kCubeEdges; ++edge) {
        vertices[edge] = edge_point(edge, draw_position(random));
      }
      std::vector<Named> triangles;
      for (const CubeTriangle& t : cube_triangles(c.corners, c.joined)) {
        triangles.push_back({{t[0], t[1], t[2]}, {vertices[t[0]], vertices[t[1]], vertices[t[2]]}});
      }
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
          apart = apart && !intersect(triangles[i], triangles[j]);
      }
    }
    CAPTURE(c.corners);
    CAPTURE(c.joined);
    CHECK(apart);
  }
}

TEST_CASE("the mesh of white noise is a manifold") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const NoiseMesh mesh(seed);
    std::map<Side, int> sides;
    std::map<unsigned, std::map<unsigned, unsigned>>
        links;  // about a vertex, from neighbour to next
    for (const auto& cell : mesh.cells) {
      for (const Named& t : cell) {
        for (unsigned i = 0; i < 3; ++i) {
          ++sides[{t.names[i], t.names[(i + 1) % 3]}];
          links[t.names[i]][t.names[(i + 1) % 3]] = t.names[(i + 2) % 3];
        }
      }
    }
    bool edge_manifold = true;
    for (const auto& [side, count] : sides) {
      const bool open = NoiseMesh::is_open(side.first) && NoiseMesh::is_open(side.second);
      edge_manifold =
          edge_manifold && count == 1 && (open || sides.contains({side.second, side.first}));
    }
    CHECK(edge_manifold);
    bool vertex_manifold = true;
    for (const auto& [vertex, link] : links) {
      if (NoiseMesh::is_open(vertex)) continue;
      std::size_t length = 0;
      unsigned at = link.begin()->first;
      do {
        at = link.contains(at) ? link.at(at) : link.begin()->first;
        ++length;
      } while (at != link.begin()->first && length <= link.size());
      vertex_manifold = vertex_manifold && length == link.size();
    }
    CHECK(vertex_manifold);
  }
}

TEST_CASE("triangles of neighbouring cells do not intersect") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const NoiseMesh mesh(seed);
    bool apart = true;
    for (unsigned i = 0; i < mesh.cells.size(); ++i) {
      for (unsigned j = 0; j < i; ++j) {
        const std::array<unsigned, 3> a = NoiseMesh::split(i, NoiseMesh::kCells);
        const std::array<unsigned, 3> b = NoiseMesh::split(j, NoiseMesh::kCells);
        bool near = true;
        for (unsigned axis = 0; axis < 3; ++axis)
          near = near && a[axis] <= b[axis] + 1 && b[axis] <= a[axis] + 1;
        if (!near) continue;
        for (const Named& one : mesh.cells[i]) {
          for (const Named& other : mesh.cells[j])
            apart = apart && !intersect(one, other);
        }
      }
    }
    CHECK(apart);
  }
}
