#include "sampling/covered_prism.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace difmesh::detail {
namespace {

// Parts and overhangs smaller than this, in cells, are left as they are: they bear no more volume
// than rounding.
constexpr double kSmall = 1e-15;
// Rounding of a corner's distance from an edge.
constexpr double kOverhang = 1e-14;

using Point = std::array<double, 2>;  // y, z

/// a (y - y0) + b (z - z0), positive on one side of a line.
struct Line {
  Point through{};
  double a = 0.0;
  double b = 0.0;

  [[nodiscard]] double at(const Point& p) const {
    return a * (p[0] - through[0]) + b * (p[1] - through[1]);
  }
};

/// A convex part of the face of the box.
struct Part {
  static constexpr std::size_t kMost = 48;

  std::array<Point, kMost> corners{};
  std::size_t size = 0;

  void add(const Point& p) { corners[size++] = p; }
};

struct AreaAndCentre {
  double area = 0.0;
  Point centre{};
};

AreaAndCentre area_and_centre(const Part& part) {
  AreaAndCentre result{0.0, part.corners[0]};
  const Point& apex = part.corners[0];
  Point moment{};
  for (std::size_t i = 2; i < part.size; ++i) {
    const Point u{part.corners[i - 1][0] - apex[0], part.corners[i - 1][1] - apex[1]};
    const Point v{part.corners[i][0] - apex[0], part.corners[i][1] - apex[1]};
    const double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
    result.area += area;
    moment[0] += area * (u[0] + v[0]) / 3.0;
    moment[1] += area * (u[1] + v[1]) / 3.0;
  }
  if (result.area > 0.0) {
    result.centre = {apex[0] + moment[0] / result.area, apex[1] + moment[1] / result.area};
  }
  return result;
}

/// A piece as a height along x over the face.
struct Sheet {
  std::vector<Line> edges;  ///< positive inside; edge-on: along it, and at its ends
  bool edge_on = false;     ///< no line along x meets it
  Line height;              ///< plus `offset`
  double offset = 0.0;
  double step = 0.0;  ///< of the winding number along x

  [[nodiscard]] double x(const Point& p) const { return offset + height.at(p); }
};

/// The direction of a very short edge is rounding. If it is in line with its neighbours, these do
/// without it, and it must not cut off a part of the piece.
bool bounds(const Line& edge, const CellPiece& piece) {
  return std::all_of(piece.corners.begin(),
                     piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.size),
                     [&](const Vec3& corner) {
                       return edge.at({corner[1], corner[2]}) > -kOverhang;
                     });
}

/// A piece that is seen as a line. Along it, the winding number may change where lines along x
/// enter the box. None if it is seen as a point.
std::optional<Sheet> edge_on_sheet(const CellPiece& piece) {
  Point from{piece.corners[0][1], piece.corners[0][2]};
  Point to = from;
  double longest = 0.0;
  for (std::size_t i = 0; i < piece.size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point p{piece.corners[i][1], piece.corners[i][2]};
      const Point q{piece.corners[j][1], piece.corners[j][2]};
      const double length = std::hypot(p[0] - q[0], p[1] - q[1]);
      if (length > longest) {
        longest = length;
        from = p;
        to = q;
      }
    }
  }
  if (longest <= kSmall) {
    return std::nullopt;
  }
  const double y = (to[0] - from[0]) / longest;
  const double z = (to[1] - from[1]) / longest;
  Sheet sheet;
  sheet.edge_on = true;
  sheet.edges = {{from, -z, y}, {from, y, z}, {to, -y, -z}};
  return sheet;
}

/// None for pieces of no extent.
std::optional<Sheet> to_sheet(const CellPiece& piece, double sign) {
  const Vec3& apex = piece.corners[0];
  Vec3 area{};
  for (std::size_t i = 2; i < piece.size; ++i) {
    Vec3 u;
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) {
      u[a] = piece.corners[i - 1][a] - apex[a];
      v[a] = piece.corners[i][a] - apex[a];
    }
    area[0] += u[1] * v[2] - u[2] * v[1];
    area[1] += u[2] * v[0] - u[0] * v[2];
    area[2] += u[0] * v[1] - u[1] * v[0];
  }
  if (std::abs(area[0]) < kSmall) {
    return edge_on_sheet(piece);
  }
  Sheet sheet;
  sheet.step = area[0] > 0.0 ? -sign : sign;
  sheet.offset = apex[0];
  sheet.height = {{apex[1], apex[2]}, -area[1] / area[0], -area[2] / area[0]};
  const double turn = area[0] > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const Vec3& from = piece.corners[i];
    const Vec3& to = piece.corners[(i + 1) % piece.size];
    const double y = to[1] - from[1];
    const double z = to[2] - from[2];
    const double length = std::hypot(y, z);
    const Line edge{{from[1], from[2]}, -turn * z / length, turn * y / length};
    if (length > kSmall && bounds(edge, piece)) {
      sheet.edges.push_back(edge);
    }
  }
  return sheet;
}

/// The parts on either side of a line.
std::pair<Part, Part> split(const Part& part, const Line& line) {
  std::pair<Part, Part> sides;
  for (std::size_t i = 0; i < part.size; ++i) {
    const Point& p = part.corners[i];
    const Point& q = part.corners[(i + 1) % part.size];
    const double fp = line.at(p);
    const double fq = line.at(q);
    if (fp >= 0.0) {
      sides.first.add(p);
    }
    if (fp <= 0.0) {
      sides.second.add(p);
    }
    if ((fp < 0.0 && fq > 0.0) || (fp > 0.0 && fq < 0.0)) {
      const double t = fp / (fp - fq);
      const Point middle{p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
      sides.first.add(middle);
      sides.second.add(middle);
    }
  }
  return sides;
}

struct Range {
  double low;
  double high;
};

Range range_over(const Part& part, const Line& line, double offset = 0.0) {
  Range range{offset + line.at(part.corners[0]), offset + line.at(part.corners[0])};
  for (std::size_t i = 1; i < part.size; ++i) {
    const double value = offset + line.at(part.corners[i]);
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

/// What the pieces before a box add to the winding number where a line along x enters it. It
/// changes along the box's face only where surface passes through the face, and there lie edges of
/// the pieces inside: within a part it is the same everywhere.
///
/// Counts the edges that a line from the point along y crosses. Each is taken from its low z to its
/// high one, so that the pieces on both sides of an edge agree about it to the last bit.
double winding_before(const CoveredBox& box, const Point& p) {
  double winding = 0.0;
  for (const CellPiece& piece : box.before) {
    for (std::size_t i = 0; i < piece.size; ++i) {
      const Vec3& from = piece.corners[i];
      const Vec3& to = piece.corners[(i + 1) % piece.size];
      const bool rises = from[2] <= p[1] && to[2] > p[1];
      const bool falls = from[2] > p[1] && to[2] <= p[1];
      if (rises || falls) {
        const Vec3& low = rises ? from : to;
        const Vec3& high = rises ? to : from;
        const double share = (p[1] - low[2]) / (high[2] - low[2]);
        if (low[1] + share * (high[1] - low[1]) > p[0]) {
          winding -= rises ? box.sign : -box.sign;
        }
      }
    }
  }
  return winding;
}

class Arrangement {
 public:
  explicit Arrangement(const CoveredBox& box) : box_(box) {
    for (const CellPiece& piece : box.inside) {
      if (auto sheet = to_sheet(piece, box.sign)) {
        sheets_.push_back(std::move(*sheet));
      }
    }
  }

  Covered resolve() {
    const Vec3& low = box_.box.low;
    const Vec3& high = box_.box.high;
    Part face;
    face.add({low[1], low[2]});
    face.add({high[1], low[2]});
    face.add({high[1], high[2]});
    face.add({low[1], high[2]});
    std::vector<std::size_t> all(sheets_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    cut_along_edges(face, all, 0);
    return total_;
  }

 private:
  /// Cuts until each sheet covers all of a part or nothing; then along where sheets cross.
  void cut_along_edges(const Part& part, std::vector<std::size_t> sheets, std::size_t first) {
    if (part.size < 3) {
      return;
    }
    for (std::size_t n = first; n < sheets.size();) {
      const Line* cut = nullptr;
      bool beside = false;
      const Sheet& sheet = sheets_[sheets[n]];
      for (const Line& edge : sheet.edges) {
        const Range range = range_over(part, edge);
        const bool along = sheet.edge_on && &edge == sheet.edges.data();
        beside = beside || range.high <= kSmall || (along && range.low >= -kSmall);
        cut = cut == nullptr && range.low < -kSmall && (along || !sheet.edge_on) ? &edge : cut;
      }
      if (beside) {
        sheets.erase(sheets.begin() + static_cast<std::ptrdiff_t>(n));
      } else if (cut != nullptr && can_split(part)) {
        const auto [within, without] = split(part, *cut);
        cut_along_edges(within, sheets, n);
        sheets.erase(sheets.begin() + static_cast<std::ptrdiff_t>(n));
        cut_along_edges(without, std::move(sheets), n);
        return;
      } else if (sheet.edge_on) {
        sheets.erase(sheets.begin() + static_cast<std::ptrdiff_t>(n));
      } else {
        ++n;
      }
    }
    cut_along_crossings(part, sheets, {1, 0});
  }

  /// Pairs of sheets, (1,0), (2,0), (2,1), ..., from `pair` on. Each pair cuts a part once: where
  /// sheets are steep, rounding may leave them crossing, over next to nothing.
  void cut_along_crossings(const Part& part, const std::vector<std::size_t>& sheets,
                           std::pair<std::size_t, std::size_t> pair) {
    if (part.size < 3) {
      return;
    }
    for (auto [n, m] = pair; n < sheets.size(); ++n, m = 0) {
      for (; m < n; ++m) {
        const Sheet& s = sheets_[sheets[n]];
        const Sheet& t = sheets_[sheets[m]];
        Line difference{s.height.through, s.height.a - t.height.a, s.height.b - t.height.b};
        const double offset = s.offset - t.x(s.height.through);
        const Range range = range_over(part, difference, offset);
        if (range.low < -kSmall && range.high > kSmall && can_split(part)) {
          // The line where the difference is 0, as one through a point of its own.
          const double square = difference.a * difference.a + difference.b * difference.b;
          difference.through[0] -= offset * difference.a / square;
          difference.through[1] -= offset * difference.b / square;
          const auto [above, below] = split(part, difference);
          cut_along_crossings(above, sheets, {n, m + 1});
          cut_along_crossings(below, sheets, {n, m + 1});
          return;
        }
      }
    }
    integrate(part, sheets);
  }

  static bool can_split(const Part& part) {
    return part.size + 2 <= Part::kMost && area_and_centre(part).area > kSmall;
  }

  void integrate(const Part& part, const std::vector<std::size_t>& sheets) {
    const AreaAndCentre prism = area_and_centre(part);
    double winding = box_.base + winding_before(box_, prism.centre);
    crossings_.clear();
    for (const std::size_t n : sheets) {
      const Sheet& sheet = sheets_[n];
      crossings_.emplace_back(std::clamp(sheet.x(prism.centre), box_.box.low[0], box_.box.high[0]),
                              sheet.step);
    }
    std::sort(crossings_.begin(), crossings_.end());
    double from = box_.box.low[0];
    for (const auto& [x, step] : crossings_) {
      total_.add(prism.area * (x - from), winding);
      winding += step;
      from = x;
    }
    total_.add(prism.area * (box_.box.high[0] - from), winding);
  }

  const CoveredBox& box_;
  std::vector<Sheet> sheets_;
  std::vector<std::pair<double, double>> crossings_;
  Covered total_;
};

}  // namespace

Covered covered_volumes(const CoveredBox& box) {
  return Arrangement(box).resolve();
}

}  // namespace difmesh::detail
