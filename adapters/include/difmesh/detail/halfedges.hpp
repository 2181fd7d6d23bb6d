#pragma once
/// \file halfedges.hpp
/// The halfedges of a whole triangle soup at once, in linear time: what the adapters write into the
/// structures of other libraries, instead of having these search for edges face by face.
/// Internal to the adapters.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/mesh_view.hpp"

namespace difmesh::detail {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Corner c = 3 f + i is vertex i of face f, and stands for the halfedge from there to the face's
/// next corner.
struct Corners {
  const std::uint32_t* indices = nullptr;
  std::uint32_t count = 0;
  std::uint32_t vertices = 0;

  [[nodiscard]] static std::uint32_t next(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t c) {
    return c % 3 == 0 ? c + 2 : c - 1;
  }
  [[nodiscard]] std::uint32_t from(std::uint32_t c) const { return indices[c]; }
  [[nodiscard]] std::uint32_t to(std::uint32_t c) const { return indices[next(c)]; }
};

/// Halfedges 2e and 2e + 1 of edge e are opposite. Edges are numbered as they first appear along
/// the corners, 2e being the halfedge of that corner: as the libraries' own builders do.
struct Halfedges {
  Array<std::uint32_t> of_corner;
  /// Of each vertex, one that leaves it, the border one where there is one; kNone without faces.
  Array<std::uint32_t> leaving;
  /// Corners whose opposite halfedge is border: it runs from to(c) to from(c), and then along
  /// leaving[from(c)].
  std::vector<std::uint32_t> border;
  std::uint32_t edges = 0;
};

/// The ends of the halfedges that leave each vertex for one of higher index. About three per vertex:
/// one cache line holds them.
class RisingHalfedges {
 public:
  struct Entry {
    std::uint32_t end;
    std::uint32_t corner;
  };

  explicit RisingHalfedges(const Corners& corners)
      : ends_(static_cast<std::size_t>(corners.vertices) + 1, 0) {
    for (std::uint32_t c = 0; c < corners.count; ++c) {
      ends_[corners.from(c) + 1] += corners.from(c) < corners.to(c) ? 1U : 0U;
    }
    for (std::size_t v = 1; v < ends_.size(); ++v) {
      ends_[v] += ends_[v - 1];
    }
    entries_.resize(ends_.back());
    // Counting up from the starts turns ends_[v] from the start of v into its end.
    for (std::uint32_t c = 0; c < corners.count; ++c) {
      if (corners.from(c) < corners.to(c)) {
        entries_[ends_[corners.from(c)]++] = {corners.to(c), c};
      }
    }
  }

  /// Sorts the entries of vertices that have many. \return whether all halfedges differ
  [[nodiscard]] bool prepare() {
    for (std::size_t v = 0; v + 1 < ends_.size(); ++v) {
      Entry* const first = entries_.data() + start(v);
      Entry* const last = entries_.data() + ends_[v];
      if (last - first > kMany) {
        std::sort(first, last, [](const Entry& a, const Entry& b) { return a.end < b.end; });
        if (std::adjacent_find(first, last, same_end) != last) {
          return false;
        }
        continue;
      }
      for (Entry* entry = first; entry != last; ++entry) {
        if (std::any_of(first, entry, [&](const Entry& e) { return same_end(e, *entry); })) {
          return false;
        }
      }
    }
    return true;
  }

  /// The corner of the halfedge from `from` to `to`, from < to, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint32_t from, std::uint32_t to) const {
    const Entry* entry = entries_.data() + start(from);
    const Entry* const last = entries_.data() + ends_[from];
    if (last - entry > kMany) {
      entry = std::lower_bound(entry, last, to,
                               [](const Entry& e, std::uint32_t end) { return e.end < end; });
    } else {
      while (entry != last && entry->end != to) {
        ++entry;
      }
    }
    return entry != last && entry->end == to ? entry->corner : kNone;
  }

 private:
  static constexpr std::ptrdiff_t kMany = 24;
  static bool same_end(const Entry& a, const Entry& b) { return a.end == b.end; }
  [[nodiscard]] std::size_t start(std::size_t v) const { return v == 0 ? 0 : ends_[v - 1]; }

  std::vector<std::uint32_t> ends_;
  Array<Entry> entries_;
};

/// Finds for each corner the one whose halfedge runs the other way along its edge, or kNone.
/// \pre indices are in range and differ within each face
/// \return false if two halfedges are the same: mates are then of no use
[[nodiscard]] inline bool find_mates(const Corners& corners, Array<std::uint32_t>& mates) {
  RisingHalfedges rising(corners);
  if (!rising.prepare()) {
    return false;
  }
  mates.assign(corners.count, kNone);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> single;
  for (std::uint32_t c = 0; c < corners.count; ++c) {
    const std::uint32_t from = corners.from(c);
    const std::uint32_t to = corners.to(c);
    if (from < to) {
      continue;
    }
    const std::uint32_t mate = rising.find(to, from);
    if (mate == kNone) {
      single.emplace_back(from, to);
    } else if (mates[mate] != kNone) {
      return false;
    } else {
      mates[mate] = c;
      mates[c] = mate;
    }
  }
  std::sort(single.begin(), single.end());
  return std::adjacent_find(single.begin(), single.end()) == single.end();
}

/// Finds for each vertex a corner from which the others are reached by turning one way, or kNone.
/// \return false if the faces of some vertex are more than one fan
[[nodiscard]] inline bool find_first_corners(const Corners& corners,
                                             const Array<std::uint32_t>& mates,
                                             Array<std::uint32_t>& first) {
  std::vector<std::uint32_t> faces(corners.vertices, 0);
  first.assign(corners.vertices, kNone);
  for (std::uint32_t c = 0; c < corners.count; ++c) {
    const std::uint32_t v = corners.from(c);
    ++faces[v];
    if (first[v] == kNone) {
      first[v] = c;
    } else if (mates[c] == kNone) {
      if (mates[first[v]] == kNone) {
        return false;
      }
      first[v] = c;
    }
  }
  for (std::uint32_t v = 0; v < corners.vertices; ++v) {
    if (first[v] == kNone) {
      continue;
    }
    std::uint32_t reached = 1;
    for (std::uint32_t c = mates[Corners::previous(first[v])]; c != kNone && c != first[v];
         c = mates[Corners::previous(c)]) {
      ++reached;
    }
    if (reached != faces[v]) {
      return false;
    }
  }
  return true;
}

/// Numbers the halfedges of a soup that is an oriented manifold.
/// \pre as find_mates()
/// \return false if it is not
[[nodiscard]] inline bool connect(const Corners& corners, Halfedges& halfedges) {
  Array<std::uint32_t>& of_corner = halfedges.of_corner;
  if (!find_mates(corners, of_corner) ||
      !find_first_corners(corners, of_corner, halfedges.leaving)) {
    return false;
  }
  // In place: the mate of a corner gives way to its halfedge, the lower corner of each edge first.
  halfedges.edges = 0;
  halfedges.border.clear();
  for (std::uint32_t c = 0; c < corners.count; ++c) {
    const std::uint32_t mate = of_corner[c];
    if (mate < c) {
      of_corner[c] = of_corner[mate] ^ 1U;
      continue;
    }
    of_corner[c] = 2 * halfedges.edges++;
    if (mate == kNone) {
      halfedges.border.push_back(c);
    }
  }
  for (std::uint32_t& corner : halfedges.leaving) {
    corner = corner == kNone ? kNone : of_corner[corner];
  }
  for (const std::uint32_t c : halfedges.border) {
    halfedges.leaving[corners.to(c)] = of_corner[c] ^ 1U;
  }
  return true;
}

}  // namespace difmesh::detail
