#include "sampling/cell_overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/grid_mesh.hpp"
#include "sampling/clip_band.hpp"

namespace difmesh::detail {
namespace {

// Bisections along each axis in turn. 48 give boxes of 4e-15 of the cell, less than its rounding.
constexpr int kMostCuts = 48;
// So many pieces are arranged at once; more where cutting does not part them, as many that meet
// along a line or lie close upon each other. Hundreds are better cut on: seen edge-on, they cross
// too often.
constexpr std::size_t kFewPieces = 16;
constexpr std::size_t kMostPieces = 64;
// Steps to arrange the pieces of a box, for each, before the box is cut instead.
constexpr std::int64_t kStepsToArrange = 2000;
// The corners of a polygon within one clip at most double.
using Clipped = Polygon<2 * CellPiece::kMost>;

double spread(const CellPiece& piece, std::size_t axis, bool high) {
  double value = piece.corners[0][axis];
  for (std::size_t i = 1; i < piece.size; ++i) {
    const double x = piece.corners[i][axis];
    value = high ? std::max(value, x) : std::min(value, x);
  }
  return value;
}

/// Keeps what of a piece is in a band; false where nothing is. Triangles leave at most nine corners
/// in a box, and rounding hardly more; what does not fit is dropped by corners next to each other.
bool clip(CellPiece& piece, std::size_t axis, double low, double high) {
  Clipped out;
  switch (axis) {
    case 0:
      clip_band<0>(piece.corners.data(), piece.size, low, high, out);
      break;
    case 1:
      clip_band<1>(piece.corners.data(), piece.size, low, high, out);
      break;
    default:
      clip_band<2>(piece.corners.data(), piece.size, low, high, out);
      break;
  }
  piece.size = 0;
  for (std::size_t i = 0; i < out.size; ++i) {
    const Vec3& corner = out.corners[i];
    const bool again = corner == out.corners[(i + 1) % out.size];
    if (!again && piece.size < CellPiece::kMost) {
      piece.corners[piece.size++] = corner;
    }
  }
  return piece.size >= 3;
}

/// Signed area of a piece's projection along x, and the volume beyond it in the box.
std::pair<double, double> sums_of(const CellPiece& piece, double top) {
  const PieceSums sums = piece_sums(piece.corners.data(), piece.size, top);
  return {sums.area2 / 2.0, sums.beyond6 / 6.0};
}

/// The smallest corner first: what a piece is must not depend on which corner its triangle names
/// first.
void turn_to_first(CellPiece& piece) {
  const auto begin = piece.corners.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(piece.size);
  std::rotate(begin, std::min_element(begin, end), end);
}

bool comes_before(const CellPiece& a, const CellPiece& b) {
  const auto end = [](const CellPiece& piece) {
    return piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.size);
  };
  return std::lexicographical_compare(a.corners.begin(), end(a), b.corners.begin(), end(b));
}

/// The integral of the winding number.
double whole_sum(const CoveredBox& box) {
  double sum = box.base * box.box.volume();
  const double depth = box.box.high[0] - box.box.low[0];
  for (const CellPiece& piece : box.before) {
    sum -= box.sign * sums_of(piece, 0.0).first * depth;
  }
  for (const CellPiece& piece : box.inside) {
    sum -= box.sign * sums_of(piece, box.box.high[0]).second;
  }
  return sum;
}

/// Parts that are there twice have the same pieces, next to each other. They are cut but once.
std::size_t different_pieces(const std::vector<CellPiece>& pieces) {
  std::size_t count = 1;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    count += pieces[i].size != pieces[i - 1].size || pieces[i].corners != pieces[i - 1].corners;
  }
  return count;
}

/// Pieces before a box that all lines meet become part of its base.
void settle_before(CoveredBox& box) {
  const double face = (box.box.high[1] - box.box.low[1]) * (box.box.high[2] - box.box.low[2]);
  const auto settled = [&](const CellPiece& piece) {
    const double area = sums_of(piece, 0.0).first;
    if (std::abs(area) >= face) {
      box.base -= box.sign * (area > 0.0 ? 1.0 : -1.0);
    }
    return area == 0.0 || std::abs(area) >= face;
  };
  box.before.erase(std::remove_if(box.before.begin(), box.before.end(), settled), box.before.end());
}

/// What of the pieces lies in a half. What lies flat on the cut belongs to the half above it.
std::vector<CellPiece> half_of(const std::vector<CellPiece>& pieces, std::size_t axis,
                               const UnitBox& half, bool upper) {
  std::vector<CellPiece> result;
  const double cut = upper ? half.low[axis] : half.high[axis];
  for (const CellPiece& piece : pieces) {
    const double low = spread(piece, axis, false);
    const double high = spread(piece, axis, true);
    const bool flat = low == cut && high == cut;
    const bool within = upper ? low >= cut : high <= cut && !flat;
    const bool beside = upper ? high <= cut && !flat : low >= cut;
    if (!beside) {
      result.push_back(piece);
      if (!within && !clip(result.back(), axis, half.low[axis], half.high[axis])) {
        result.pop_back();
      }
    }
  }
  return result;
}

}  // namespace

bool CellOverlaps::is_plain(std::int64_t row, std::int64_t slot) {
  if (lists_->has_one(row, slot)) {
    return true;
  }
  triangles_.clear();
  lists_->append_triangles(row, slot, triangles_);
  return sheets_.is_sheet(triangles_);
}

void CellOverlaps::append_pieces(const Run& run, std::int64_t slot,
                                 std::vector<CellPiece>& pieces) {
  const std::int64_t across = rows_.end_j - rows_.first_j;
  const auto j = static_cast<double>(rows_.first_j + run.row % across);
  const auto k = static_cast<double>(rows_.first_k + run.row / across);
  const auto cell = static_cast<double>(run.slot - 1);
  const double low = slot == 0 ? -kGreatestCoordinate : static_cast<double>(slot - 1);
  triangles_.clear();
  lists_->append_triangles(run.row, slot, triangles_);
  for (const std::uint32_t t : triangles_) {
    CellPiece piece;
    piece.triangle = t;
    for (const std::uint32_t vertex : mesh_.triangles[t]) {
      piece.corners[piece.size++] = mesh_.corners[vertex];
    }
    if (clip(piece, 2, k, k + 1.0) && clip(piece, 1, j, j + 1.0) &&
        clip(piece, 0, low, static_cast<double>(slot))) {
      for (std::size_t i = 0; i < piece.size; ++i) {
        Vec3& corner = piece.corners[i];
        corner = {corner[0] - cell, corner[1] - j, corner[2] - k};
      }
      turn_to_first(piece);
      pieces.push_back(piece);
    }
  }
}

Covered CellOverlaps::resolve(const Run& run) {
  CoveredBox box;
  box.sign = sign_;
  box.base = run.base;
  for (std::int64_t slot = run.first; slot < run.slot; ++slot) {
    append_pieces(run, slot, box.before);
  }
  append_pieces(run, run.slot, box.inside);
  std::sort(box.before.begin(), box.before.end(), comes_before);
  std::sort(box.inside.begin(), box.inside.end(), comes_before);
  total_ = {};
  effort_ = steps_per_piece_ * static_cast<std::int64_t>(box.inside.size());
  resolve_box(std::move(box), {});
  return total_;
}

void CellOverlaps::resolve_box(CoveredBox&& box, Descent descent) {
  settle_before(box);
  effort_ -= static_cast<std::int64_t>(box.inside.size() + box.before.size());
  const double volume = box.box.volume();
  if (box.inside.empty()) {
    total_.add(volume, std::nearbyint(whole_sum(box) / volume));
    return;
  }
  triangles_.clear();
  for (const CellPiece& piece : box.inside) {
    triangles_.push_back(piece.triangle);
  }
  if (descent.cuts > 0 && sheets_.is_sheet(triangles_)) {
    total_.add(from_sum(volume, whole_sum(box)));
    return;
  }
  const std::size_t pieces = different_pieces(box.inside);
  if (const auto covered = arrange(box, pieces, descent)) {
    total_.add(*covered);
  } else if (descent.cuts == kMostCuts || effort_ <= descent.keep) {
    total_.add(from_sum(volume, whole_sum(box)));
    total_.undecided += volume;
  } else {
    descent.pieces = descent.cuts % 3 == 0 ? pieces : descent.pieces;
    bisect(std::move(box), descent);
  }
}

std::optional<Covered> CellOverlaps::arrange(const CoveredBox& box, std::size_t pieces,
                                             const Descent& descent) {
  const bool stuck = descent.cuts > 0 && descent.cuts % 3 == 0 && 2 * pieces > descent.pieces;
  if (pieces > (stuck ? kMostPieces : kFewPieces)) {
    return std::nullopt;
  }
  const std::int64_t granted =
      std::min(effort_ - descent.keep, kStepsToArrange * static_cast<std::int64_t>(pieces));
  std::int64_t left = granted;
  const std::optional<Covered> covered = covered_volumes(box, left);
  effort_ -= granted - left;
  return covered;
}

void CellOverlaps::bisect(CoveredBox&& box, const Descent& descent) {
  const auto axis = static_cast<std::size_t>(descent.cuts % 3);
  const double middle = 0.5 * (box.box.low[axis] + box.box.high[axis]);
  CoveredBox lower;
  CoveredBox upper;
  lower.sign = upper.sign = box.sign;
  lower.base = upper.base = box.base;
  lower.box = upper.box = box.box;
  lower.box.high[axis] = upper.box.low[axis] = middle;
  lower.inside = half_of(box.inside, axis, lower.box, false);
  upper.inside = half_of(box.inside, axis, upper.box, true);
  if (axis == 0) {
    upper.before = box.before;
    upper.before.insert(upper.before.end(), lower.inside.begin(), lower.inside.end());
    lower.before = std::move(box.before);
  } else {
    lower.before = half_of(box.before, axis, lower.box, false);
    upper.before = half_of(box.before, axis, upper.box, true);
  }
  box = {};
  // Half of what the second's pieces are worth is kept for it, and what the first does not need.
  const auto all = static_cast<double>(lower.inside.size() + upper.inside.size());
  const double share = all > 0.0 ? 0.5 * static_cast<double>(upper.inside.size()) / all : 0.0;
  const auto for_upper = static_cast<std::int64_t>(
      share * static_cast<double>(std::max<std::int64_t>(effort_ - descent.keep, 0)));
  resolve_box(std::move(lower), {descent.cuts + 1, descent.pieces, descent.keep + for_upper});
  resolve_box(std::move(upper), {descent.cuts + 1, descent.pieces, descent.keep});
}

}  // namespace difmesh::detail
