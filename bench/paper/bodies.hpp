#pragma once
// The bodies of the paper, and fields of them at random places in a grid.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "difmesh/field_view.hpp"
#include "difmesh/grid.hpp"
#include "difmesh/mesh.hpp"
#include "difmesh/shapes.hpp"

namespace difmesh::paper {

/// A body whose surface is known: a shape, or the inside of a closed mesh.
struct Body {
  std::string name;
  std::string unit;              ///< what resolutions and errors refer to: "R" or "D"
  double size = 1.0;             ///< that length, in the body's unit
  std::shared_ptr<Shape> shape;  ///< null for meshes
  std::shared_ptr<Mesh> mesh;    ///< null for shapes

  /// Centre and radius of a sphere; D is the diagonal of the bounding box of the unturned body.
  [[nodiscard]] static Body sphere();
  [[nodiscard]] static Body genus();
  [[nodiscard]] static Body turned_genus();
  [[nodiscard]] static Body ellipsoid();
  [[nodiscard]] static Body smooth_box();
  [[nodiscard]] static Body golf_ball();
  /// \throw Error as read_mesh()
  [[nodiscard]] static Body from_file(const std::filesystem::path& path, std::string name);
};

/// A body in a grid of cubic cells.
struct Sample {
  Body body;
  Grid grid;
  Array<double> fractions;

  [[nodiscard]] FieldView field() const {
    return FieldView::x_fastest(fractions.data(), grid.dims);
  }
  [[nodiscard]] double spacing() const { return grid.spacing[0]; }
};

/// Exact fractions of a body with `cells` cells per size. Its place within a cell is random, the
/// same for the same number of a place. At least five cells are free on all sides.
/// \param threads of the library
[[nodiscard]] Sample sample(const Body& body, double cells, std::uint64_t place, int threads);

/// Mean and Gaussian curvature, positive for a ball.
struct Curvatures {
  double mean = 0.0;
  double gaussian = 0.0;
};

/// Of the exact surface, at its point closest to `point`, which is no further away than a cell or
/// so. Nothing for meshes and for the golf ball, which has edges.
[[nodiscard]] std::optional<Curvatures> exact_curvatures(const Body& body, const Vec3& point,
                                                         double distance);

}  // namespace difmesh::paper
