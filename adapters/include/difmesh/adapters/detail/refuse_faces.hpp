#pragma once
/// \file refuse_faces.hpp
/// Which faces of a broken soup have to go, so that the others are an oriented manifold; the same
/// ones in every library. Internal to the adapters; at 0.5 to 1 µs per face much slower than what
/// clean meshes need, for it sorts.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "difmesh/adapters/detail/halfedges.hpp"

namespace difmesh::detail {

using Fates = std::vector<std::optional<Refusal>>;  ///< one per face; empty for those that stay

[[nodiscard]] inline std::optional<Refusal> fate_alone(const Corners& corners, std::uint32_t face) {
  const std::uint32_t* v = corners.indices + std::size_t{3} * face;
  if (std::any_of(v, v + 3, [&](std::uint32_t i) { return i >= corners.vertices; })) {
    return Refusal::index_out_of_range;
  }
  if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
    return Refusal::degenerate;
  }
  return std::nullopt;
}

/// Refuses faces until no two run along an edge the same way. A flipped face is in conflict along
/// three edges, its neighbours along one each: it goes and they stay, wherever they stand.
class EdgeConflicts {
 public:
  EdgeConflicts(const Corners& corners, Fates& fates) : fates_(fates), scores_(fates.size(), 0) {
    std::vector<Claim> all;
    for (std::uint32_t c = 0; c < corners.count; ++c) {
      if (!fates[c / 3]) {
        all.push_back({std::uint64_t{corners.from(c)} << 32U | corners.to(c), c / 3});
      }
    }
    std::sort(all.begin(), all.end(), [](const Claim& a, const Claim& b) {
      return a.what < b.what || (a.what == b.what && a.face < b.face);
    });
    for (std::size_t first = 0; first < all.size();) {
      std::size_t last = first + 1;
      while (last < all.size() && all[last].what == all[first].what) {
        ++last;
      }
      if (last - first > 1) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
        edges_.push_back({claimants_.size(), claimants_.size() + last - first, last - first});
        for (auto claim = begin; claim != begin + static_cast<std::ptrdiff_t>(last - first);
             ++claim) {
          claimants_.push_back(claim->face);
          claims_.push_back({edges_.size() - 1, claim->face});
        }
      }
      first = last;
    }
    std::sort(claims_.begin(), claims_.end(), by_face);
  }

  void resolve() {
    for (const Claim& claim : claims_) {
      ++scores_[claim.face];
    }
    for (const Claim& claim : claims_) {
      queue_.emplace(scores_[claim.face], claim.face);
    }
    while (!queue_.empty()) {
      const auto [score, face] = queue_.top();
      queue_.pop();
      // Entries are not updated: those whose score has changed since are stale.
      if (!fates_[face] && score == scores_[face] && score != 0) {
        fates_[face] = Refusal::edge_taken;
        release(face);
      }
    }
  }

 private:
  struct Claim {
    std::uint64_t what;  // both ends of a halfedge, later the place of the contested edge
    std::uint32_t face;
  };
  struct Edge {
    std::size_t first;  // of its faces in claimants_
    std::size_t last;
    std::size_t left;  // faces not refused
  };
  static bool by_face(const Claim& a, const Claim& b) { return a.face < b.face; }

  /// An edge with one claimant left is no conflict any more.
  void release(std::uint32_t face) {
    const auto [first, last] =
        std::equal_range(claims_.begin(), claims_.end(), Claim{0, face}, by_face);
    for (auto claim = first; claim != last; ++claim) {
      Edge& edge = edges_[claim->what];
      if (--edge.left == 1) {
        const auto winner =
            std::find_if(claimants_.begin() + static_cast<std::ptrdiff_t>(edge.first),
                         claimants_.begin() + static_cast<std::ptrdiff_t>(edge.last),
                         [&](std::uint32_t candidate) { return !fates_[candidate].has_value(); });
        queue_.emplace(--scores_[*winner], *winner);
      }
    }
  }

  Fates& fates_;
  std::vector<std::uint32_t> scores_;  // contested edges per face
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> claimants_;
  std::vector<Claim> claims_;
  std::priority_queue<std::pair<std::uint32_t, std::uint32_t>> queue_;
};

/// Refuses faces until those round each vertex are one fan.
/// \pre faces without a fate have no conflict of edges
class FanConflicts {
 public:
  FanConflicts(const Corners& corners, Fates& fates)
      : corners_(corners),
        fates_(fates),
        fan_of_(corners.count, 0),
        starts_(corners.vertices + 1U) {
    // Faces refused before are left out of the search for mates.
    std::vector<std::uint32_t> kept;
    Array<std::uint32_t> kept_mates;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t c = 0; c < corners.count; ++c) {
      if (!fates[c / 3]) {
        kept.push_back(c);
        indices.push_back(corners.from(c));
        ++starts_[corners.from(c) + 1];
      }
    }
    (void)sort_mates({indices.data(), static_cast<std::uint32_t>(indices.size()), corners.vertices},
                     kept_mates);
    mates_.assign(corners.count, kNone);
    for (std::size_t n = 0; n < kept.size(); ++n) {
      mates_[kept[n]] = kept_mates[n] == kNone ? kNone : kept[kept_mates[n]];
    }
    for (std::size_t v = 1; v < starts_.size(); ++v) {
      starts_[v] += starts_[v - 1];
    }
    around_.resize(kept.size());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end());
    for (const std::uint32_t c : kept) {
      around_[next[corners.from(c)]++] = c;
    }
  }

  /// In rounds: a face that goes may cut the fans of its other corners in two.
  void resolve() {
    std::vector<std::uint32_t> vertices(corners_.vertices);
    for (std::uint32_t v = 0; v < corners_.vertices; ++v) {
      vertices[v] = v;
    }
    while (!vertices.empty()) {
      touched_.clear();
      for (const std::uint32_t v : vertices) {
        keep_largest_fan(v);
      }
      std::sort(touched_.begin(), touched_.end());
      touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
      vertices.swap(touched_);
    }
  }

 private:
  [[nodiscard]] std::uint32_t mate(std::uint32_t c) const {
    const std::uint32_t other = mates_[c];
    return other == kNone || fates_[other / 3] ? kNone : other;
  }

  /// Marks all corners of a fan by the lowest of them plus one. \return how many they are
  std::uint32_t mark_fan(std::uint32_t first) {
    std::uint32_t size = 0;
    std::uint32_t c = first;
    for (; c != kNone && (size == 0 || c != first); c = mate(Corners::previous(c))) {
      fan_of_[c] = first + 1;
      ++size;
    }
    if (c == kNone) {
      for (c = mate(first); c != kNone; c = mate(c)) {
        c = Corners::next(c);
        fan_of_[c] = first + 1;
        ++size;
      }
    }
    return size;
  }

  void keep_largest_fan(std::uint32_t v) {
    const auto first = around_.begin() + starts_[v];
    const auto last = around_.begin() + starts_[v + 1];
    std::for_each(first, last, [&](std::uint32_t c) { fan_of_[c] = 0; });
    std::uint32_t largest = 0;
    std::uint32_t chosen = 0;
    for (auto c = first; c != last; ++c) {
      if (!fates_[*c / 3] && fan_of_[*c] == 0) {
        const std::uint32_t size = mark_fan(*c);
        if (size > largest) {
          largest = size;
          chosen = *c + 1;
        }
      }
    }
    for (auto c = first; c != last; ++c) {
      const std::uint32_t face = *c / 3;
      if (!fates_[face] && fan_of_[*c] != chosen) {
        fates_[face] = Refusal::vertex_taken;
        for (std::uint32_t i = 0; i < 3; ++i) {
          touched_.push_back(corners_.from(3 * face + i));
        }
      }
    }
  }

  const Corners& corners_;
  Fates& fates_;
  Array<std::uint32_t> mates_;
  std::vector<std::uint32_t> fan_of_;  // per corner; see mark_fan()
  std::vector<std::uint32_t> starts_;  // of each vertex in around_
  std::vector<std::uint32_t> around_;  // corners at each vertex, ascending
  std::vector<std::uint32_t> touched_;
};

/// Decides about all faces of a soup of any kind.
[[nodiscard]] inline Fates refuse_faces(const Corners& corners) {
  Fates fates(corners.count / 3);
  for (std::uint32_t face = 0; face < fates.size(); ++face) {
    fates[face] = fate_alone(corners, face);
  }
  EdgeConflicts(corners, fates).resolve();
  FanConflicts(corners, fates).resolve();
  return fates;
}

}  // namespace difmesh::detail
