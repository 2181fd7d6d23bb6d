#pragma once
// What the calls are made with: fields, options, meshes and callbacks, drawn from an input.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "difmesh/difmesh.h"
#include "input.hpp"

namespace difmesh::fuzz {

using Index3 = std::array<std::int64_t, 3>;

/// A struct of the C interface with its defaults.
template <class Struct>
Struct prepared(dif_status (*init)(Struct*, std::uint64_t)) {
  Struct result;
  demand(init(&result, sizeof result) == DIF_OK);
  return result;
}

/// Cells of side 1.
dif_grid unit_cells(const Index3& dims);

struct MeshDeleter {
  void operator()(dif_mesh* mesh) const { dif_mesh_free(mesh); }
};
using Mesh = std::unique_ptr<dif_mesh, MeshDeleter>;

/// A status that bad numbers may lead to: a defect of the library is none, nor is an unknown one.
void demand_honest(dif_status status);
/// The same of a call that gives a mesh: one where it succeeded, NULL where not.
Mesh taken(dif_status status, dif_mesh* mesh);

/// One to nine cells along each axis, at most `most_cells` of them.
Index3 draw_dims(Input& input, std::int64_t most_cells);

/// A field of any layout in a block of memory that holds its elements and nothing more.
class Field {
 public:
  /// All but the elements. \param types values of the first so many element types
  Field(Input& input, std::int64_t most_cells, std::int64_t types = 4);
  /// Draws the elements.
  void fill(Input& input);

  [[nodiscard]] const dif_field& c() const { return field_; }
  [[nodiscard]] std::int64_t cells() const;
  [[nodiscard]] std::int64_t element_bytes() const;
  /// The bytes of a cell's element.
  [[nodiscard]] const std::uint8_t* element(const Index3& cell) const;
  /// The grid that it covers.
  [[nodiscard]] dif_grid grid() const;

 private:
  void lay_out(Input& input);
  void stretch(Input& input);

  dif_field field_;
  std::array<std::vector<double>, 3> faces_;  ///< by axis; empty: it is uniform
  std::vector<std::uint8_t> memory_;
};

/// A progress callback that holds the calls against each other, and may cancel.
struct Watch {
  std::int64_t calls_left = -1;  ///< before it cancels; < 0: never
  double done = 0.0;
  bool cancelled = false;

  explicit Watch(Input& input);
  /// Puts itself into options. \pre outlives their use
  template <class Options>
  void attend(Options& options) {
    if (watches_) {
      options.progress = &called;
      options.progress_user = this;
    }
  }
  /// Demands that the call was cancelled if, and only if, it was asked to stop.
  void check(dif_status status) const;

 private:
  static std::int32_t called(void* user, double share_done);
  bool watches_ = false;
};

/// One thread; rarely a number of threads that does not exist.
std::int32_t draw_threads(Input& input);
void draw_sides(Input& input, std::int32_t (&sides)[6]);
dif_options draw_options(Input& input, const Field& field);

/// Points of a small lattice, now and then any numbers.
std::vector<double> draw_points(Input& input, std::int64_t count);

/// Triangles of any kind, closed bodies of four corners, or the surface of a field.
struct DrawnMesh {
  Mesh mesh;  ///< NULL where the library took no such mesh
  dif_grid grid;
  bool usual = true;  ///< no coordinate is extreme

  explicit DrawnMesh(Input& input);
};

}  // namespace difmesh::fuzz
