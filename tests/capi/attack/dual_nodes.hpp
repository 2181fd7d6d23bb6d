#pragma once
/// \file dual_nodes.hpp
/// The dual grid as the documentation has it: its nodes, where they lie, which are inside, and
/// which edges must carry a vertex. Knows nothing of the library but the names of edges.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "finding.hpp"
#include "specimen.hpp"

namespace difmesh::attack {

/// From `node` to its upper neighbour along `axis`.
struct DualEdge {
  Index3 node{0, 0, 0};
  std::size_t axis = 0;
};

/// A node of open faces, where the plane of its cell may decide whether it is inside.
struct OpenNode {
  Index3 node{};
  Index3 cell{};  ///< that it stands for
  Index3 face{};  ///< -1, 1: it lies on that open face of the cell
  bool inside = false;
};

class DualNodes {
 public:
  /// Nodes of open faces, where planes decide, and cells near 1/2, where curved surfaces do, are
  /// told by the edges that carry a vertex; all others by the field. Then exactly the edges between
  /// an inside and an outside node may be named.
  /// \param ids ascending, of edges that exist; see edge_of() and exists()
  [[nodiscard]] Finding build(const Specimen& specimen, std::span<const std::uint64_t> ids);

  /// Sets what first(), last(), exists() and coordinate() say.
  void measure(const Specimen& specimen);

  /// Indices of nodes: 0 to n - 1 are cells, -1 and n lie on the faces of the domain or beyond.
  [[nodiscard]] const Index3& first() const { return first_; }
  [[nodiscard]] const Index3& last() const { return last_; }
  [[nodiscard]] DualEdge edge_of(std::uint64_t id) const;
  [[nodiscard]] std::uint64_t id_of(const DualEdge& edge) const;
  [[nodiscard]] bool exists(const DualEdge& edge) const;
  [[nodiscard]] double coordinate(std::size_t axis, std::int64_t index) const {
    return coordinates_[axis][static_cast<std::size_t>(index + 1)];
  }
  [[nodiscard]] bool inside(const Index3& node) const { return inside_[number(node)] != 0; }
  /// The fraction that decides whether a node is inside; none where a plane or surface may.
  [[nodiscard]] std::optional<double> fraction(const Index3& node) const;
  void for_each_open(const std::function<void(const OpenNode&)>& visit) const;

 private:
  struct Stand {
    Index3 cell;         // that the node stands for
    bool empty = false;  // beyond an empty side
    bool full = false;   // beyond a full one, and no empty one
    int open_faces = 0;  // that it lies on
  };

  [[nodiscard]] std::size_t number(const Index3& node) const {
    return static_cast<std::size_t>(((node[2] + 1) * size_[1] + node[1] + 1) * size_[0] + node[0] +
                                    1);
  }
  [[nodiscard]] Stand stand_of(const Index3& node) const;
  [[nodiscard]] bool is_open_face(std::size_t axis, std::int64_t index) const;
  [[nodiscard]] bool is_free(const Stand& stand) const;
  void settle(const Index3& node);
  void settle_by_neighbours();
  [[nodiscard]] Finding check_edges() const;

  const Specimen* specimen_ = nullptr;
  bool with_planes_ = false;
  bool with_surfaces_ = false;
  Index3 first_{};
  Index3 last_{};
  Index3 size_{};  // dims + 2
  std::array<std::vector<double>, 3> coordinates_;
  std::vector<std::uint8_t> inside_;
  std::vector<std::uint8_t> named_;  // by id
};

/// Calls visit(node) for all nodes in [first, last], x fastest.
template <class Visit>
void for_each_node(const Index3& first, const Index3& last, const Visit& visit) {
  Index3 node{};
  for (node[2] = first[2]; node[2] <= last[2]; ++node[2]) {
    for (node[1] = first[1]; node[1] <= last[1]; ++node[1]) {
      for (node[0] = first[0]; node[0] <= last[0]; ++node[0]) {
        visit(node);
      }
    }
  }
}

}  // namespace difmesh::attack
