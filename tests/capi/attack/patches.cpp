// The triangles of single dual cells. What a cell must hold follows from its corners: on a face
// whose corners change sides twice along its border, one segment with the inside on its right, seen
// from outside the cell; on one where they change four times, two, which cut off the outside
// corners where the mean of the four fractions is at least 1/2, the inside ones elsewhere. Segments
// join to loops, and a loop of n vertices is filled by n - 2 triangles. Nothing here depends on
// where on their edges the vertices lie.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "judge.hpp"
#include "text.hpp"

namespace difmesh::attack {
namespace {

constexpr int kEdges = 12;
constexpr int kFaces = 6;
constexpr int kNone = -1;

// Edge 4 axis + b of a cell starts at the corner whose bits along the two other axes, in their
// order, are those of b.
int local_edge(const Index3& cell, const DualEdge& edge) {
  int bits = 0;
  int place = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t step = edge.node[a] - cell[a];
    if (step < 0 || step > (a == edge.axis ? 0 : 1)) {
      return kNone;
    }
    if (a != edge.axis) {
      bits |= static_cast<int>(step) << place++;
    }
  }
  return 4 * static_cast<int>(edge.axis) + bits;
}

struct Face {
  int corner[4];  // counter-clockwise seen from outside the cell
  int edge[4];    // from each corner to the next
};

constexpr int edge_between(int corner, int other) {
  const int axis = std::countr_zero(static_cast<unsigned>(corner ^ other));
  const int low = corner & other;
  const int first = axis == 0 ? 1 : 0;
  const int second = axis == 2 ? 1 : 2;
  return 4 * axis + ((low >> first & 1) | (low >> second & 1) << 1);
}

constexpr std::array<Face, kFaces> make_faces() {
  std::array<Face, kFaces> faces{};
  for (int f = 0; f < kFaces; ++f) {
    const int axis = f / 2;
    const int u = 1 << (axis + 1) % 3;
    const int v = 1 << (axis + 2) % 3;
    const int base = f % 2 << axis;
    const int round[4] = {0, u, u | v, v};
    for (int n = 0; n < 4; ++n) {
      faces[static_cast<std::size_t>(f)].corner[n] = base | round[f % 2 == 1 ? n : 3 - n];
    }
    Face& face = faces[static_cast<std::size_t>(f)];
    for (int n = 0; n < 4; ++n) {
      face.edge[n] = edge_between(face.corner[n], face.corner[(n + 1) % 4]);
    }
  }
  return faces;
}
constexpr std::array<Face, kFaces> kCellFaces = make_faces();

bool is_inside(unsigned corners, int corner) {
  return (corners >> corner & 1U) != 0;
}

// The segments on a face of a cell: from which edge, and to which one with the inside corners cut
// off and with the outside ones.
struct Segments {
  int count = 0;
  int from[2];
  int separated[2];
  int joined[2];
};

Segments segments_on(const Face& face, unsigned corners) {
  Segments segments;
  for (int n = 0; n < 4; ++n) {
    if (is_inside(corners, face.corner[n]) || !is_inside(corners, face.corner[(n + 1) % 4])) {
      continue;
    }
    int leaving = (n + 1) % 4;
    while (is_inside(corners, face.corner[(leaving + 1) % 4])) {
      leaving = (leaving + 1) % 4;
    }
    int before = (n + 3) % 4;
    while (!is_inside(corners, face.corner[before])) {
      before = (before + 3) % 4;
    }
    segments.from[segments.count] = face.edge[n];
    segments.separated[segments.count] = face.edge[leaving];
    segments.joined[segments.count++] = face.edge[before];
  }
  return segments;
}

}  // namespace

// In the order of their cells.
Finding Judge::place_triangles() {
  const std::span<const std::uint32_t> indices = surface_->triangles;
  edges_.clear();
  for (const std::uint64_t id : surface_->ids) {
    edges_.push_back(nodes_.edge_of(id));
  }
  placed_.clear();
  const Index3& dims = specimen_->dims;
  for (std::uint32_t t = 0; t < indices.size() / 3; ++t) {
    Index3 cell = edges_[indices[3 * t]].node;
    for (std::size_t n = 1; n < 3; ++n) {
      for (std::size_t a = 0; a < 3; ++a) {
        cell[a] = std::min(cell[a], edges_[indices[3 * t + n]].node[a]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] >= nodes_.last()[a]) {
        return {"a triangle in a face of the dual grid", text("triangle %u", t)};
      }
    }
    placed_.push_back(
        {((cell[2] + 1) * (dims[1] + 2) + cell[1] + 1) * (dims[0] + 2) + cell[0] + 1, t});
  }
  const auto before = [](const PlacedTriangle& a, const PlacedTriangle& b) {
    return a.cell < b.cell;
  };
  if (!std::is_sorted(placed_.begin(), placed_.end(), before)) {
    std::stable_sort(placed_.begin(), placed_.end(), before);
  }
  return {};
}

Finding Judge::check_patches() {
  if (Finding finding = place_triangles()) {
    return finding;
  }
  const Index3& dims = specimen_->dims;
  const Index3& last = nodes_.last();
  std::size_t from = 0;
  Finding finding;
  for_each_node(nodes_.first(), {last[0] - 1, last[1] - 1, last[2] - 1}, [&](const Index3& cell) {
    const std::int64_t number =
        ((cell[2] + 1) * (dims[1] + 2) + cell[1] + 1) * (dims[0] + 2) + cell[0] + 1;
    std::size_t to = from;
    while (to < placed_.size() && placed_[to].cell == number) {
      ++to;
    }
    if (!finding) {
      finding = check_cell(cell, std::span(placed_).subspan(from, to - from));
    }
    from = to;
  });
  if (!finding && from != placed_.size()) {
    return {"a triangle in no dual cell", text("triangle %u", placed_[from].triangle)};
  }
  return finding;
}

namespace {

// The triangles of one cell as its edges see them: bit b of to[a] is the directed edge from a to b.
struct Patch {
  unsigned to[kEdges] = {};
  int triangles = 0;

  // False if a directed edge comes twice.
  bool add(const int (&corner)[3]) {
    ++triangles;
    for (int n = 0; n < 3; ++n) {
      const unsigned bit = 1U << corner[(n + 1) % 3];
      if ((to[corner[n]] & bit) != 0) {
        return false;
      }
      to[corner[n]] |= bit;
    }
    return true;
  }
  // Where the border of the triangles leads from an edge; kNone if nowhere or to several.
  [[nodiscard]] int next_on_border(int edge) const {
    int next = kNone;
    for (int other = 0; other < kEdges; ++other) {
      if ((to[edge] >> other & 1U) != 0 && (to[other] >> edge & 1U) == 0) {
        if (next != kNone) {
          return kNone;
        }
        next = other;
      }
    }
    return next;
  }
};

int loops_of(const int (&next)[kEdges]) {
  unsigned seen = 0;
  int loops = 0;
  for (int start = 0; start < kEdges; ++start) {
    if (next[start] == kNone || (seen >> start & 1U) != 0) {
      continue;
    }
    ++loops;
    for (int edge = start; (seen >> edge & 1U) == 0; edge = next[edge]) {
      seen |= 1U << edge;
    }
  }
  return loops;
}

// The sum of the fractions of a face's corners, where they are known and leave no doubt about its
// mean.
std::optional<double> clear_sum(const DualNodes& nodes, const Index3& cell, const Face& face) {
  double sum = 0.0;
  for (const int corner : face.corner) {
    const std::optional<double> fraction = nodes.fraction(
        {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)});
    if (!fraction) {
      return std::nullopt;
    }
    sum += *fraction;
  }
  return std::abs(sum - 2.0) > 1e-12 ? std::optional(sum) : std::nullopt;
}

// What is wrong with where the border of a cell's triangles leads on one face, or nullptr.
const char* fault_on_face(const Segments& segments, const int (&next)[kEdges],
                          std::optional<double> sum) {
  bool separated = true;
  bool joined = true;
  for (int n = 0; n < segments.count; ++n) {
    separated = separated && next[segments.from[n]] == segments.separated[n];
    joined = joined && next[segments.from[n]] == segments.joined[n];
  }
  if (!separated && !joined) {
    return "triangles whose border does not part inside from outside";
  }
  if (segments.count == 2 && sum && joined != (*sum > 2.0)) {
    return "an ambiguous face settled against the mean of its fractions";
  }
  return nullptr;
}

}  // namespace

// What is wrong with the triangles of a cell, told by the edges of their vertices, or nullptr.
const char* Judge::fault_of_patch(const Index3& cell, unsigned corners,
                                  std::span<const PlacedTriangle> triangles) const {
  Patch patch;
  for (const PlacedTriangle& placed : triangles) {
    int corner[3];
    for (std::size_t n = 0; n < 3; ++n) {
      corner[n] = local_edge(cell, edges_[surface_->triangles[3 * placed.triangle + n]]);
      if (corner[n] == kNone) {
        return "a triangle in more than one dual cell";
      }
    }
    if (!patch.add(corner)) {
      return "a directed edge twice in a dual cell";
    }
  }
  int next[kEdges];
  int vertices = 0;
  for (int edge = 0; edge < kEdges; ++edge) {
    next[edge] = patch.next_on_border(edge);
    vertices += next[edge] != kNone ? 1 : 0;
  }
  int expected = 0;
  for (const Face& face : kCellFaces) {
    const Segments segments = segments_on(face, corners);
    expected += segments.count;
    const auto sum = segments.count == 2 ? clear_sum(nodes_, cell, face) : std::nullopt;
    if (const char* fault = fault_on_face(segments, next, sum)) {
      return fault;
    }
  }
  if (vertices != expected || patch.triangles != vertices - 2 * loops_of(next)) {
    return "loops that are not filled by disks";
  }
  return nullptr;
}

Finding Judge::check_cell(const Index3& cell, std::span<const PlacedTriangle> triangles) const {
  unsigned corners = 0;
  for (int c = 0; c < 8; ++c) {
    const Index3 node{cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
    corners |= (nodes_.inside(node) ? 1U : 0U) << c;
  }
  if ((corners == 0 || corners == 255) && triangles.empty()) {
    return {};
  }
  const char* const fault = fault_of_patch(cell, corners, triangles);
  return fault == nullptr ? Finding{} : Finding{fault, "dual cell " + node_text(cell)};
}

}  // namespace difmesh::attack
