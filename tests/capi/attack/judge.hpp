#pragma once
/// \file judge.hpp
/// Holds a surface against what is promised of every surface.

#include <array>
#include <cstdint>
#include <vector>

#include "dual_nodes.hpp"
#include "finding.hpp"
#include "specimen.hpp"
#include "surface.hpp"

namespace difmesh::attack {

/// Keeps its memory from one surface to the next.
class Judge {
 public:
  /// The first thing that is wrong with the surface of the whole specimen:
  /// - edge ids ascend; each vertex is finite, strictly inside its edge and off its ends by the
  ///   clearance;
  /// - exactly the edges between inside and outside nodes have one (see DualNodes);
  /// - the triangles of each dual cell fill, by disks without further vertices, the loops that its
  ///   corners ask for, counter-clockwise seen from the outside ones (see patches.cpp);
  /// - each directed edge comes once; the triangles of a vertex are one fan; edges with one
  ///   triangle lie on the faces of the dual grid;
  /// - the report says how many cells of which kind there are, what they hold, whether the surface
  ///   is closed and what it encloses, which lies between what its dual cells allow.
  [[nodiscard]] Finding check(const Specimen& specimen, const Surface& surface,
                              const dif_report& report);

  /// Of the last surface.
  [[nodiscard]] const DualNodes& nodes() const { return nodes_; }

 private:
  struct Corner {  // of a triangle, at its vertex
    std::uint32_t next;
    std::uint32_t previous;
  };
  struct PlacedTriangle {
    std::int64_t cell;
    std::uint32_t triangle;
  };

  [[nodiscard]] Finding check_arrays() const;
  [[nodiscard]] Finding check_vertices() const;
  [[nodiscard]] Finding check_normals() const;
  [[nodiscard]] Finding check_patches();
  [[nodiscard]] Finding place_triangles();
  [[nodiscard]] Finding check_cell(const Index3& cell,
                                   std::span<const PlacedTriangle> triangles) const;
  [[nodiscard]] const char* fault_of_patch(const Index3& cell, unsigned corners,
                                           std::span<const PlacedTriangle> triangles) const;
  [[nodiscard]] Finding check_fans();
  [[nodiscard]] Finding check_fan(std::uint32_t vertex, std::span<const Corner> corners);
  [[nodiscard]] bool on_one_end(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Finding check_field_facts() const;
  [[nodiscard]] Finding check_volume() const;
  [[nodiscard]] double sum_of_volumes() const;

  const Specimen* specimen_ = nullptr;
  const Surface* surface_ = nullptr;
  const dif_report* report_ = nullptr;
  DualNodes nodes_;
  std::vector<DualEdge> edges_;  // by vertex
  std::vector<PlacedTriangle> placed_;
  std::vector<std::uint32_t> corner_start_;  // by vertex
  std::vector<Corner> corners_;
  std::int64_t boundary_edges_ = 0;
};

}  // namespace difmesh::attack
