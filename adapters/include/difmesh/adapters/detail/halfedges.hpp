#pragma once
/// \file halfedges.hpp
/// The halfedges of a whole triangle soup at once, in linear time: what the adapters write into the
/// structures of other libraries, instead of having these search for edges face by face.
/// Internal to the adapters.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "difmesh/adapters/mesh_view.hpp"

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

/// Finds for each corner the one whose halfedge runs the other way along its edge, or kNone, with
/// one look at each. Corners whose mates are still to come hang in chains, one per vertex for the
/// edges to vertices of higher index; `mates` holds the chains until it holds the mates, so that
/// hardly any memory is touched but what is kept. Two pairs along one edge go unnoticed here.
/// \pre indices are in range and differ within each face
/// \return false if two halfedges were seen to be the same, or the chains are too long, as they are
///   where thousands of faces meet in an unlucky order; mates are then of no use
[[nodiscard]] inline bool chain_mates(const Corners& corners, Array<std::uint32_t>& mates) {
  std::vector<std::uint32_t> heads(corners.vertices, kNone);
  mates.resize(corners.count);
  std::uint64_t steps_left = 32 * std::uint64_t{corners.count};
  for (std::uint32_t c = 0; c < corners.count; ++c) {
    const std::uint32_t from = corners.from(c);
    const std::uint32_t to = corners.to(c);
    std::uint32_t* link = &heads[std::min(from, to)];
    std::uint32_t other = *link;
    // The lower ends agree: so do the edges if the sums of the ends do.
    const std::uint64_t ends = std::uint64_t{from} + to;
    while (other != kNone && std::uint64_t{corners.from(other)} + corners.to(other) != ends) {
      link = &mates[other];
      other = *link;
      if (steps_left-- == 0) {
        return false;
      }
    }
    if (other == kNone) {
      mates[c] = heads[std::min(from, to)];
      heads[std::min(from, to)] = c;
    } else if (corners.from(other) == from) {
      return false;
    } else {
      *link = mates[other];
      mates[other] = c;
      mates[c] = other;
    }
  }
  for (std::uint32_t corner : heads) {
    while (corner != kNone) {
      corner = std::exchange(mates[corner], kNone);
    }
  }
  return true;
}

/// The same for soups of any kind, by sorting: slower.
[[nodiscard]] inline bool sort_mates(const Corners& corners, Array<std::uint32_t>& mates) {
  struct Entry {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t corner;
    [[nodiscard]] bool same_edge(const Entry& e) const { return low == e.low && high == e.high; }
  };
  std::vector<Entry> entries(corners.count);
  for (std::uint32_t c = 0; c < corners.count; ++c) {
    const auto [low, high] = std::minmax({corners.from(c), corners.to(c)});
    entries[c] = {low, high, c};
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  mates.assign(corners.count, kNone);
  for (std::size_t n = 1; n < entries.size(); ++n) {
    const Entry& a = entries[n - 1];
    const Entry& b = entries[n];
    if (!a.same_edge(b)) {
      continue;
    }
    if (mates[a.corner] != kNone || corners.from(a.corner) == corners.from(b.corner)) {
      return false;
    }
    mates[a.corner] = b.corner;
    mates[b.corner] = a.corner;
  }
  return true;
}

/// Finds for each vertex a corner from which the others are reached by turning one way, or kNone.
/// \return false if the faces of some vertex are more than one fan, or have more than two faces
///   along an edge: the vertex at its other end is then met twice on the way round
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
  std::vector<std::uint32_t> met_by(corners.vertices, kNone);
  for (std::uint32_t v = 0; v < corners.vertices; ++v) {
    for (std::uint32_t c = first[v]; c != kNone;) {
      const std::uint32_t neighbour = corners.to(c);
      if (std::exchange(met_by[neighbour], v) == v) {
        return false;
      }
      --faces[v];
      const std::uint32_t previous = Corners::previous(c);
      c = mates[previous];
      if (c == kNone && met_by[corners.from(previous)] == v) {
        return false;
      }
      c = c == first[v] ? kNone : c;
    }
    if (faces[v] != 0) {
      return false;
    }
  }
  return true;
}

/// Numbers the halfedges of a soup that is an oriented manifold.
/// \pre as chain_mates()
/// \return false if it is not
[[nodiscard]] inline bool connect(const Corners& corners, Halfedges& halfedges) {
  Array<std::uint32_t>& of_corner = halfedges.of_corner;
  if ((!chain_mates(corners, of_corner) && !sort_mates(corners, of_corner)) ||
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
