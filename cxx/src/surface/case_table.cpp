#include "surface/case_table.hpp"

#include <cstddef>
#include <utility>

// The rule. Contour segments of the six faces chain to loops. Each loop is cut into triangles by
// diagonals, and a filling of the cell is valid when
// 1. no diagonal lies on a face of the cell, save those of face_cut_allowed(), and
// 2. no two diagonals through the cell cross, wherever on their edges their ends lie.
//
// Of the valid fillings with the fewest diagonals on faces the table holds the first in the order
// of the search.
//
// Why 2 is enough. Move the vertices along their edges. Triangles that do not intersect can begin
// to only when a vertex runs into a triangle or two sides cross. A triangle has no point on a cube
// edge but its own vertices, so the first cannot be; contour segments and face diagonals lie on the
// faces, where nothing crosses them; so two diagonals through the cell would have to cross. That
// triangles do not intersect to begin with, case_table_test shows with a separating plane for each
// pair.
//
// Why 1 has an exception. Loops of 12, of 9, and of 8 along two opposite faces run twice along some
// face, and each of their fillings has a diagonal on a face (140 cases). Two loops of 6 in a fully
// alternating cell would, without, need one diagonal each between opposite edges, through the
// middle of the cell, and either may lie above the other (12 cases).

namespace difmesh::detail {

namespace {

// ---- Corners ------------------------------------------------------------------------------------

constexpr bool is_inside(unsigned corners, unsigned corner) {
  return ((corners >> corner) & 1U) != 0;
}

constexpr unsigned find_ambiguous_faces(unsigned corners) {
  unsigned faces = 0;
  for (unsigned face = 0; face < kCubeFaces; ++face) {
    const std::array<unsigned, 4> c = face_corners(face);
    const bool first = is_inside(corners, c[0]);
    const bool alternating = is_inside(corners, c[3]) == first &&
                             is_inside(corners, c[1]) != first && is_inside(corners, c[2]) != first;
    if (alternating) faces |= 1U << face;
  }
  return faces;
}

constexpr unsigned find_crossed_edges(unsigned corners) {
  unsigned edges = 0;
  for (unsigned edge = 0; edge < kCubeEdges; ++edge) {
    const bool low = is_inside(corners, edge_low_corner(edge));
    if (low != is_inside(corners, edge_high_corner(edge))) edges |= 1U << edge;
  }
  return edges;
}

constexpr std::array<CubeCase, 256> make_cases() {
  std::array<CubeCase, 256> cases{};
  unsigned decision = 0;
  for (unsigned corners = 0; corners < 256; ++corners) {
    const unsigned faces = find_ambiguous_faces(corners);
    cases[corners] = {.crossed_edges = static_cast<std::uint16_t>(find_crossed_edges(corners)),
                      .first_decision = static_cast<std::uint16_t>(decision),
                      .ambiguous_faces = static_cast<std::uint8_t>(faces)};
    decision += 1U << static_cast<unsigned>(std::popcount(faces));
  }
  return cases;
}

}  // namespace

constexpr std::array<CubeCase, 256> kCubeCases = make_cases();

namespace {

// ---- Diagonals ----------------------------------------------------------------------------------

/// Pairs of edges with no common face; their diagonals run through the cell.
constexpr unsigned kInnerDiagonals = 30;
constexpr std::uint8_t kFaceCut = 30;  ///< on a face, around a corner that is this cell's to cut
constexpr std::uint8_t kBarred = 31;

constexpr std::uint8_t classify_on_face(unsigned a, unsigned b) {
  const auto face = static_cast<unsigned>(std::countr_zero(edge_faces(a) & edge_faces(b)));
  for (const unsigned corner : {edge_low_corner(a), edge_high_corner(a)}) {
    const bool common = corner == edge_low_corner(b) || corner == edge_high_corner(b);
    if (common && face_cut_allowed(face, corner)) return kFaceCut;
  }
  return kBarred;
}

/// For two edges the number of their inner diagonal, kFaceCut or kBarred.
using DiagonalNumbers = std::array<std::array<std::uint8_t, kCubeEdges>, kCubeEdges>;

constexpr DiagonalNumbers number_diagonals() {
  DiagonalNumbers numbers{};
  std::uint8_t next = 0;
  for (unsigned a = 0; a < kCubeEdges; ++a) {
    numbers[a][a] = kBarred;
    for (unsigned b = 0; b < a; ++b) {
      const bool inner = (edge_faces(a) & edge_faces(b)) == 0;
      numbers[a][b] = numbers[b][a] = inner ? next++ : classify_on_face(a, b);
    }
  }
  return numbers;
}

constexpr DiagonalNumbers kDiagonalNumbers = number_diagonals();

/// Directions with components -1, 0, 1, one of each opposite pair. Enough to separate what can be
/// separated here: larger components add nothing.
constexpr unsigned kDirections = 13;

/// What one diagonal sweeps while its ends run along their edges: the hull of four cube corners.
struct Sweep {
  unsigned ends = 0;  ///< bits of its two edges
  std::array<int, kDirections> low{};
  std::array<int, kDirections> high{};
};

constexpr Sweep sweep_of(unsigned a, unsigned b) {
  Sweep sweep{.ends = (1U << a) | (1U << b)};
  for (unsigned direction = 0; direction < kDirections; ++direction) {
    // Base 3 above the middle, 13 = (0, 0, 0): the first nonzero component is 1.
    const int code = static_cast<int>(direction) + 14;
    const std::array<int, 3> normal{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
    int low = 3;
    int high = -3;
    for (const unsigned corner :
         {edge_low_corner(a), edge_high_corner(a), edge_low_corner(b), edge_high_corner(b)}) {
      int height = 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        if (((corner >> axis) & 1U) != 0) height += normal[axis];
      }
      low = height < low ? height : low;
      high = height > high ? height : high;
    }
    sweep.low[direction] = low;
    sweep.high[direction] = high;
  }
  return sweep;
}

/// Two diagonals with four different ends cross for some positions of these exactly when their
/// sweeps overlap: through each point inside a sweep runs one position of its diagonal.
constexpr bool may_cross(const Sweep& one, const Sweep& other) {
  if ((one.ends & other.ends) != 0) return false;
  for (unsigned d = 0; d < kDirections; ++d) {
    if (one.high[d] <= other.low[d] || other.high[d] <= one.low[d]) return false;
  }
  return true;
}

/// For each inner diagonal the bits of those that it may cross.
constexpr std::array<std::uint32_t, kInnerDiagonals> find_crossings() {
  std::array<Sweep, kInnerDiagonals> sweeps{};
  for (unsigned a = 0; a < kCubeEdges; ++a) {
    for (unsigned b = 0; b < a; ++b) {
      if (kDiagonalNumbers[a][b] < kInnerDiagonals) sweeps[kDiagonalNumbers[a][b]] = sweep_of(a, b);
    }
  }
  std::array<std::uint32_t, kInnerDiagonals> crossings{};
  for (unsigned i = 0; i < kInnerDiagonals; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      if (!may_cross(sweeps[i], sweeps[j])) continue;
      crossings[i] |= 1U << j;
      crossings[j] |= 1U << i;
    }
  }
  return crossings;
}

constexpr std::array<std::uint32_t, kInnerDiagonals> kCrossings = find_crossings();

// ---- Loops --------------------------------------------------------------------------------------

/// A face seen from outside the cell: its corners counter-clockwise, edge k from corner k to k + 1.
/// Twice around, so that a walk of up to four steps needs no wrapping.
struct FaceCycle {
  std::array<unsigned, 8> corners{};
  std::array<std::uint8_t, 8> edges{};
};

constexpr FaceCycle cycle_of(unsigned face) {
  const std::array<unsigned, 4> c = face_corners(face);
  // Of a face across y the axes, x before z, are in the order that turns the cycle around.
  const bool as_listed = (face % 2U == 1U) != (face / 2U == 1U);
  const std::array<unsigned, 4> once{c[0], as_listed ? c[1] : c[2], c[3], as_listed ? c[2] : c[1]};
  FaceCycle cycle;
  for (unsigned k = 0; k < 8; ++k) {
    cycle.corners[k] = once[k % 4];
    cycle.edges[k] = static_cast<std::uint8_t>(edge_between(once[k % 4], once[(k + 1) % 4]));
  }
  return cycle;
}

constexpr std::array<FaceCycle, kCubeFaces> kFaceCycles{cycle_of(0), cycle_of(1), cycle_of(2),
                                                        cycle_of(3), cycle_of(4), cycle_of(5)};

/// For each crossed edge the one to which the contour runs on, inside to its right seen from
/// outside the cell: then the loops are counter-clockwise seen from the outside corners.
constexpr std::array<std::uint8_t, kCubeEdges> find_successors(unsigned corners, unsigned joined) {
  std::array<std::uint8_t, kCubeEdges> successors{};
  unsigned face_bit = 1;
  for (const FaceCycle& cycle : kFaceCycles) {
    for (unsigned k = 0; k < 4; ++k) {
      const bool leaves =
          is_inside(corners, cycle.corners[k]) && !is_inside(corners, cycle.corners[k + 1]);
      if (!leaves) continue;
      // The segment ends where the cycle leaves the inside. It begins where the cycle enters: after
      // the outside corners if joined, else before the inside corners that it cuts off.
      unsigned enter = k + 1;
      if ((joined & face_bit) != 0) {
        while (!is_inside(corners, cycle.corners[enter + 1])) {
          ++enter;
        }
      } else {
        enter = k + 3;
        while (is_inside(corners, cycle.corners[enter])) {
          --enter;
        }
      }
      successors[cycle.edges[enter]] = cycle.edges[k];
    }
    face_bit <<= 1U;
  }
  return successors;
}

// ---- Filling ------------------------------------------------------------------------------------

/// A polygon still to be filled: the vertices [first, last] of the ring, closed by their diagonal
/// or, for a whole loop, by the contour.
struct Polygon {
  unsigned first = 0;
  unsigned last = 0;
  const Polygon* rest = nullptr;  ///< the polygons after this one
};

/// The diagonals drawn so far, by what they leave to the others.
struct Drawn {
  std::uint32_t crossed = 0;  ///< inner diagonals that would cross one of them
  unsigned face_cuts_left = 0;
};

struct Filling {
  std::array<std::uint8_t, kCubeEdges> ring{};  ///< the crossed edges, loop after loop
  std::array<CubeTriangle, 10> triangles{};
  unsigned size = 0;
};

/// Draws the side of a triangle between two places of the ring; false where the rule bars it.
constexpr bool draw(const Filling& filling, unsigned first, unsigned last, Drawn& drawn) {
  if (last == first + 1) return true;
  const unsigned diagonal = kDiagonalNumbers[filling.ring[first]][filling.ring[last]];
  if (diagonal < kInnerDiagonals) {
    drawn.crossed |= kCrossings[diagonal];
    return ((drawn.crossed >> diagonal) & 1U) == 0;
  }
  if (diagonal == kBarred || drawn.face_cuts_left == 0) return false;
  --drawn.face_cuts_left;
  return true;
}

/// Depth-first search for triangles over the polygons `todo`; `size` of the triangles are fixed.
constexpr bool fill(Filling& filling, unsigned size, const Drawn& drawn, const Polygon* todo) {
  while (todo != nullptr && todo->last - todo->first < 2) {
    todo = todo->rest;
  }
  filling.size = size;
  if (todo == nullptr) return true;
  for (unsigned apex = todo->first + 1; apex < todo->last; ++apex) {
    Drawn next = drawn;
    if (!draw(filling, todo->first, apex, next) || !draw(filling, apex, todo->last, next)) continue;
    filling.triangles[size] = {filling.ring[todo->first], filling.ring[apex],
                               filling.ring[todo->last]};
    const Polygon after{apex, todo->last, todo->rest};
    const Polygon before{todo->first, apex, &after};
    if (fill(filling, size + 1, next, &before)) return true;
  }
  return false;
}

/// The triangles of one case. Loops in the order of their lowest edges, each from its lowest edge.
constexpr Filling fill_cell(unsigned corners, unsigned joined) {
  const std::array<std::uint8_t, kCubeEdges> successors = find_successors(corners, joined);
  Filling filling;
  std::array<Polygon, 4> loops{};
  const Polygon* todo = nullptr;
  unsigned vertices = 0;
  unsigned loop = 0;
  for (unsigned left = kCubeCases[corners].crossed_edges; left != 0; ++loop) {
    loops[loop].first = vertices;
    for (auto edge = static_cast<unsigned>(std::countr_zero(left)); ((left >> edge) & 1U) != 0;
         edge = successors[edge]) {
      filling.ring[vertices++] = static_cast<std::uint8_t>(edge);
      left &= ~(1U << edge);
    }
    loops[loop].last = vertices - 1;
    loops[loop].rest = todo;
    todo = &loops[loop];
  }
  for (Drawn drawn; !fill(filling, 0, drawn, todo);) {
    ++drawn.face_cuts_left;
  }
  return filling;
}

// ---- Tables -------------------------------------------------------------------------------------

/// Bit i of `rank` moved to the i-th of the bits of `faces`.
constexpr unsigned decided_faces(unsigned rank, unsigned faces) {
  unsigned joined = 0;
  for (; faces != 0; faces &= faces - 1U, rank >>= 1U) {
    if ((rank & 1U) != 0) joined |= faces & (~faces + 1U);
  }
  return joined;
}

/// The decisions of the cases without corner 7 inside, which come first.
constexpr unsigned kHalfDecisions = kCubeDecisions / 2;

/// They are filled in slices, each a constant of its own, since clang limits the steps of each.
constexpr unsigned kSliceDecisions = 41;

struct Slice {
  std::array<std::uint8_t, kSliceDecisions> sizes{};  ///< triangles by decision
  std::array<CubeTriangle, 10 * kSliceDecisions> triangles{};
  unsigned size = 0;
};

constexpr Slice fill_slice(unsigned number) {
  const unsigned first = kSliceDecisions * number;
  Slice slice;
  for (unsigned corners = 0; corners < 128; ++corners) {
    const CubeCase& cube = kCubeCases[corners];
    const unsigned end = kCubeCases[corners + 1].first_decision;
    for (unsigned decision = cube.first_decision; decision < end; ++decision) {
      if (decision < first || decision >= first + kSliceDecisions) continue;
      const unsigned joined = decided_faces(decision - cube.first_decision, cube.ambiguous_faces);
      const Filling filling = fill_cell(corners, joined);
      for (unsigned i = 0; i < filling.size; ++i) {
        slice.triangles[slice.size++] = filling.triangles[i];
      }
      slice.sizes[decision - first] = static_cast<std::uint8_t>(filling.size);
    }
  }
  return slice;
}

template <unsigned kNumber>
constexpr Slice kSlice = fill_slice(kNumber);

template <unsigned... kNumbers>
constexpr std::array<const Slice*, sizeof...(kNumbers)> list_slices(
    std::integer_sequence<unsigned, kNumbers...>) {
  return {&kSlice<kNumbers>...};
}

constexpr auto kSlices =
    list_slices(std::make_integer_sequence<unsigned, kHalfDecisions / kSliceDecisions>{});

/// Exchanging inside and outside, and joined and separated, maps decision d to the last one minus
/// d. So the second half of the table is the first in reverse, its triangles turned around.
constexpr std::array<std::uint16_t, kCubeDecisions + 1> make_first_triangles() {
  std::array<std::uint16_t, kCubeDecisions + 1> first{};
  unsigned decision = 0;
  for (const Slice* slice : kSlices) {
    for (const std::uint8_t size : slice->sizes) {
      first[decision + 1] = static_cast<std::uint16_t>(first[decision] + size);
      ++decision;
    }
  }
  for (; decision < kCubeDecisions; ++decision) {
    const unsigned mirror = kCubeDecisions - 1 - decision;
    first[decision + 1] =
        static_cast<std::uint16_t>(first[decision] + first[mirror + 1] - first[mirror]);
  }
  return first;
}

constexpr std::array<CubeTriangle, kCubeTriangleCount> make_triangles() {
  std::array<CubeTriangle, kCubeTriangleCount> triangles{};
  std::size_t low = 0;
  for (const Slice* slice : kSlices) {
    for (unsigned i = 0; i < slice->size; ++i) {
      triangles[low++] = slice->triangles[i];
    }
  }
  const std::array<std::uint16_t, kCubeDecisions + 1> first = make_first_triangles();
  for (unsigned decision = kHalfDecisions; decision < kCubeDecisions; ++decision) {
    std::size_t from = first[kCubeDecisions - 1 - decision];
    for (std::size_t to = first[decision]; to < first[decision + 1]; ++to, ++from) {
      triangles[to] = {triangles[from][0], triangles[from][2], triangles[from][1]};
    }
  }
  return triangles;
}

}  // namespace

constexpr std::array<std::uint16_t, kCubeDecisions + 1> kFirstTriangle = make_first_triangles();
constexpr std::array<CubeTriangle, kCubeTriangleCount> kCubeTriangles = make_triangles();
static_assert(kCubeCases.back().first_decision + 1 == kCubeDecisions);
static_assert(kFirstTriangle.back() == kCubeTriangleCount);

}  // namespace difmesh::detail
