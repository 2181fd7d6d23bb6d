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
// Cuts inside each other. Boxes that need more are better bisected, and the stack stays below 1 MB.
constexpr int kDeepest = 400;

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
  static constexpr std::size_t kMost = 32;

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

/// Two parts along a chord, with fewer corners.
std::pair<Part, Part> halves(const Part& part) {
  std::pair<Part, Part> sides;
  const std::size_t middle = part.size / 2;
  for (std::size_t i = 0; i <= middle; ++i) {
    sides.first.add(part.corners[i]);
  }
  for (std::size_t i = middle; i < part.size; ++i) {
    sides.second.add(part.corners[i]);
  }
  sides.second.add(part.corners[0]);
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
  Arrangement(const CoveredBox& box, std::int64_t& effort) : box_(box), effort_(effort) {
    for (const CellPiece& piece : box.inside) {
      if (auto sheet = to_sheet(piece, box.sign)) {
        sheets_.push_back(std::move(*sheet));
      }
    }
  }

  std::optional<Covered> resolve() {
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
    cut_along_edges(face, std::move(all), {});
    return given_up_ ? std::nullopt : std::optional(total_);
  }

 private:
  using Sheets = std::vector<std::size_t>;

  [[nodiscard]] bool give_up(int depth) {
    given_up_ = given_up_ || effort_ < 0 || depth > kDeepest;
    return given_up_;
  }

  /// How a sheet lies to a part: an edge of the sheet that cuts the part, or none; or beside it.
  struct Fit {
    const Line* cut = nullptr;
    bool beside = false;
  };
  Fit fit(const Sheet& sheet, const Part& part) {
    Fit fit;
    for (const Line& edge : sheet.edges) {
      const Range range = range_over(part, edge);
      const bool along = sheet.edge_on && &edge == sheet.edges.data();
      fit.beside = fit.beside || range.high <= kSmall || (along && range.low >= -kSmall);
      const bool cuts = range.low < -kSmall && (along || !sheet.edge_on);
      fit.cut = fit.cut == nullptr && cuts ? &edge : fit.cut;
    }
    effort_ -= static_cast<std::int64_t>(sheet.edges.size());
    return fit;
  }

  /// Where in the cutting: the sheets before `n` cover all of the part.
  struct Stage {
    std::size_t n = 0;
    int depth = 0;
  };

  /// Cuts until each sheet covers all of a part or nothing; then along where sheets cross.
  void cut_along_edges(const Part& part, Sheets sheets, Stage stage) {
    if (part.size < 3 || give_up(stage.depth)) {
      return;
    }
    ++stage.depth;
    while (stage.n < sheets.size()) {
      const auto place = sheets.begin() + static_cast<std::ptrdiff_t>(stage.n);
      const Sheet& sheet = sheets_[*place];
      const auto [cut, beside] = fit(sheet, part);
      if (!beside && cut != nullptr && is_large(part)) {
        const auto [one, other] = is_full(part) ? halves(part) : split(part, *cut);
        cut_along_edges(one, sheets, stage);
        if (!is_full(part)) {
          sheets.erase(place);
        }
        cut_along_edges(other, std::move(sheets), stage);
        return;
      }
      if (beside || sheet.edge_on) {
        sheets.erase(place);
      } else {
        ++stage.n;
      }
    }
    cut_along_crossings(part, sheets, stage.depth);
  }

  /// Where the difference of the heights of two sheets is 0, if a part lies on both sides of it.
  std::optional<Line> crossing(const Sheet& s, const Sheet& t, const Part& part) {
    --effort_;
    Line difference{s.height.through, s.height.a - t.height.a, s.height.b - t.height.b};
    const double offset = s.offset - t.x(s.height.through);
    const Range range = range_over(part, difference, offset);
    if (range.low >= -kSmall || range.high <= kSmall || !is_large(part)) {
      return std::nullopt;
    }
    // As a line through a point of its own.
    const double square = difference.a * difference.a + difference.b * difference.b;
    difference.through[0] -= offset * difference.a / square;
    difference.through[1] -= offset * difference.b / square;
    return difference;
  }

  /// Sheets that do not cross their neighbours in the order at one point have this order all over a
  /// part. Each pair cuts a part once: where sheets are steep, rounding may leave them crossing,
  /// over next to nothing.
  void cut_along_crossings(const Part& part, Sheets sheets, int depth) {
    if (part.size < 3 || give_up(depth)) {
      return;
    }
    sort_at(area_and_centre(part).centre, sheets);
    for (std::size_t i = 1; i < sheets.size(); ++i) {
      const auto line = crossing(sheets_[sheets[i - 1]], sheets_[sheets[i]], part);
      const std::pair<std::size_t, std::size_t> pair = std::minmax(sheets[i - 1], sheets[i]);
      if (!line || std::find(cut_.begin(), cut_.end(), pair) != cut_.end()) {
        continue;
      }
      const auto [one, other] = is_full(part) ? halves(part) : split(part, *line);
      const std::size_t before = cut_.size();
      if (!is_full(part)) {
        cut_.emplace_back(pair);
      }
      cut_along_crossings(one, sheets, depth + 1);
      cut_along_crossings(other, std::move(sheets), depth + 1);
      cut_.resize(before);
      return;
    }
    integrate(part, sheets);
  }

  /// By their heights at a point.
  void sort_at(const Point& p, Sheets& sheets) {
    crossings_.clear();
    for (const std::size_t n : sheets) {
      crossings_.push_back({sheets_[n].x(p), n});
    }
    std::sort(crossings_.begin(), crossings_.end());
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      sheets[i] = crossings_[i].second;
    }
  }

  static bool is_large(const Part& part) { return area_and_centre(part).area > kSmall; }

  /// Rounding may let a line cross the boundary of a part more than twice.
  static bool is_full(const Part& part) { return part.size + 8 > Part::kMost; }

  /// \param sheets as a line along x meets them
  void integrate(const Part& part, const Sheets& sheets) {
    const AreaAndCentre prism = area_and_centre(part);
    double winding = box_.base + winding_before(box_, prism.centre);
    effort_ -= static_cast<std::int64_t>(box_.before.size());
    double from = box_.box.low[0];
    for (const std::size_t n : sheets) {
      const double x = std::clamp(sheets_[n].x(prism.centre), box_.box.low[0], box_.box.high[0]);
      total_.add(prism.area * (x - from), winding);
      winding += sheets_[n].step;
      from = x;
    }
    total_.add(prism.area * (box_.box.high[0] - from), winding);
  }

  const CoveredBox& box_;
  std::int64_t& effort_;
  bool given_up_ = false;
  std::vector<Sheet> sheets_;
  std::vector<std::pair<double, std::size_t>> crossings_;  ///< of a line along x with sheets
  std::vector<std::pair<std::size_t, std::size_t>> cut_;   ///< sheets along whose line it was cut
  Covered total_;
};

}  // namespace

std::optional<Covered> covered_volumes(const CoveredBox& box, std::int64_t& effort) {
  return Arrangement(box, effort).resolve();
}

}  // namespace difmesh::detail
