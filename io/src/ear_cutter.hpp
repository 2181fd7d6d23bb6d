#pragma once
/// \file ear_cutter.hpp
/// Cuts a polygon in the plane into triangles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "point_tree.hpp"

namespace difmesh::detail {

/// Cuts ears off: triangles of three successive corners that hold no other corner. A polygon that
/// does not cross itself has two at any time (Meisters 1975), and cutting one changes at most that
/// its two neighbours are ears, as what remains only shrinks: so each corner is asked at first, and
/// each neighbour again. Only corners where the polygon turns the other way, or not at all, can be
/// in the way; a tree finds them. Signs of areas are exact.
///
/// Ears are cut in rounds, and no two neighbours in one, which keeps triangles short. Thin ones
/// wait until there are no others, corners on a straight line until there are no thin ones. Corners
/// at the same place, as where a hole is tied in by a bridge, do not hinder each other.
class EarCutter {
 public:
  enum class Result : std::uint8_t { done, crossed, too_long };
  /// The corners of a polygon, counter-clockwise, of magnitude 1 or so; four at least, below 2^32.
  /// `crossed`: no ear was left at some time, and another corner was cut off.
  /// `too_long`: more than some hundred visits per corner to parts of the tree; not all is cut.
  Result cut(std::span<const Point2> points);

  /// Of the last polygon: two fewer than corners, each of three ascending corners but for a turn.
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> triangles() const {
    return triangles_;
  }

 private:
  enum class Shape : std::uint8_t { ear, thin_ear, flat, none };
  [[nodiscard]] Shape shape_of(std::uint32_t corner);
  void start();
  void cut_off(std::uint32_t corner);
  bool cut_one_round();
  bool cut_one_of(std::vector<std::uint32_t>& corners, Shape shape);
  [[nodiscard]] bool takes_too_long() const;
  void ask_again(std::uint32_t corner);
  [[nodiscard]] bool is_in_the_way(std::uint32_t corner) const;

  std::span<const Point2> points_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> round_of_;  ///< in which to ask; kCut once cut off
  std::vector<std::uint32_t> now_;       ///< to ask in this round
  std::vector<std::uint32_t> later_;     ///< in the next one
  std::vector<std::uint32_t> thin_;
  std::vector<std::uint32_t> flat_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  PointTree in_the_way_;
  std::uint32_t round_ = 0;
};

}  // namespace difmesh::detail
