// Calls dif_reconstruct() and dif_field_planes() with fields of any layout, values and options, and
// dif_reconstruct_block() with dif_mesh_weld(), which must give the same mesh. Meshes must be
// manifold, and closed where the sides close them.

#include <algorithm>
#include <cmath>

#include "calls.hpp"
#include "drawn.hpp"

namespace difmesh::fuzz {
namespace {

/// Borrowed arrays of a mesh.
struct Arrays {
  const double* positions = nullptr;
  const double* normals = nullptr;
  const std::uint64_t* ids = nullptr;
  const std::uint32_t* triangles = nullptr;
  std::int64_t vertices = 0;
  std::int64_t normal_count = 0;
  std::int64_t id_count = 0;
  std::int64_t triangle_count = 0;

  explicit Arrays(const dif_mesh* mesh) {
    demand(dif_mesh_positions(mesh, &positions, &vertices) == DIF_OK);
    demand(dif_mesh_normals(mesh, &normals, &normal_count) == DIF_OK);
    demand(dif_mesh_edge_ids(mesh, &ids, &id_count) == DIF_OK);
    demand(dif_mesh_triangles(mesh, &triangles, &triangle_count) == DIF_OK);
  }
};

template <class T>
bool same_bits(const T* a, const T* b, std::int64_t count) {
  return count == 0 || std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof *a) == 0;
}

void check_arrays(const dif_mesh* mesh, const dif_options& options) {
  const Arrays arrays(mesh);
  demand(arrays.normal_count == (options.vertex_normals == 1 ? arrays.vertices : 0));
  demand(arrays.id_count == (options.edge_ids == 1 ? arrays.vertices : 0));
  demand(std::is_sorted(arrays.ids, arrays.ids + arrays.id_count, std::less_equal<>()));
  for (std::int64_t n = 0; n < arrays.normal_count; ++n) {
    const double* normal = arrays.normals + 3 * n;
    demand(std::abs(std::hypot(normal[0], normal[1], normal[2]) - 1.0) < 1e-9);
  }
}

void check_mesh(const dif_mesh* mesh, const Field& field, const dif_options& options) {
  dif_measure facts = prepared(dif_measure_init);
  demand(dif_mesh_measure(mesh, &facts) == DIF_OK);
  demand(facts.manifold == 1);
  demand(facts.isolated_vertices == 0);
  // Where sides of both kinds meet, the outside itself changes and the surface ends.
  const std::int32_t first = options.boundary[0];
  const bool closes = (first == DIF_SIDE_EMPTY || first == DIF_SIDE_FULL) &&
                      std::all_of(options.boundary, options.boundary + 6,
                                  [first](std::int32_t side) { return side == first; });
  demand(!closes || facts.closed == 1);
  dif_report report = prepared(dif_report_init);
  demand(dif_mesh_report(mesh, &report) == DIF_OK);
  demand((report.closed == 1) == (facts.boundary_edges == 0));
  demand(report.cells == field.cells());
  check_arrays(mesh, options);
}

void check_planes(const Field& field, const dif_options& options, dif_status expected) {
  const dif_field& c = field.c();
  std::vector<double> offsets(static_cast<std::size_t>(field.cells()), -9.0);
  dif_plane_arrays arrays = prepared(dif_plane_arrays_init);
  arrays.offset = offsets.data();
  arrays.strides[0] = 1;
  arrays.strides[1] = c.dims[0];
  arrays.strides[2] = c.dims[0] * c.dims[1];
  demand(dif_field_planes(&c, &options, &arrays) == expected);
  demand(expected != DIF_OK ||
         std::ranges::all_of(offsets, [](double offset) { return std::isfinite(offset); }));
}

/// Where the cells are cut along one axis, both ends included.
struct Cuts {
  std::size_t axis;
  std::vector<std::int64_t> at;

  Cuts(Input& input, const dif_field& field) : axis(static_cast<std::size_t>(input.number(3))) {
    const std::int64_t count = field.dims[axis];
    at = {0, count};
    for (std::int64_t n = 1 + input.number(2); n > 0; --n) {
      at.push_back(input.number(count));
    }
    std::ranges::sort(at);
    at.erase(std::unique(at.begin(), at.end()), at.end());
  }
};

/// A block's cells and ghosts in memory of their own, x fastest.
struct BlockMemory {
  dif_block block = prepared(dif_block_init);
  dif_field field;
  std::vector<std::uint8_t> bytes;

  BlockMemory(const Field& whole, std::size_t axis, std::int64_t begin, std::int64_t end,
              bool periodic)
      : field(whole.c()) {
    const std::int64_t count = whole.c().dims[axis];
    std::copy_n(whole.c().dims, 3, block.dims);
    block.offset[axis] = begin;
    block.dims[axis] = end - begin;
    if (!periodic || end - begin < count) {
      const std::int64_t most = DIF_GHOST_LAYERS;
      block.ghost_low[axis] = periodic ? most : std::min(most, begin);
      block.ghost_high[axis] = periodic ? most : std::min(most, count - end);
    }
    field.dims[axis] = block.ghost_low[axis] + end - begin + block.ghost_high[axis];
    copy(whole, axis, begin - block.ghost_low[axis]);
  }

  void copy(const Field& whole, std::size_t axis, std::int64_t first) {
    const std::int64_t* dims = field.dims;
    const auto width = static_cast<std::size_t>(whole.element_bytes());
    bytes.resize(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]) * width);
    std::uint8_t* to = bytes.data();
    const std::int64_t count = whole.c().dims[axis];
    Index3 cell{};
    for (std::int64_t k = 0; k < dims[2]; ++k) {
      for (std::int64_t j = 0; j < dims[1]; ++j) {
        for (std::int64_t i = 0; i < dims[0]; ++i, to += width) {
          cell = {i, j, k};
          cell[axis] = ((cell[axis] + first) % count + count) % count;
          std::memcpy(to, whole.element(cell), width);
        }
      }
    }
    field.data = bytes.data();
    field.strides[0] = 1;
    field.strides[1] = dims[0];
    field.strides[2] = dims[0] * dims[1];
  }
};

/// Rarely: one number of one block that is not what it should be, or a block given twice.
struct Mishap {
  std::size_t block;  ///< from 1; 0: none
  std::size_t what;
  std::size_t axis;
  std::int64_t number;
  bool twice;

  explicit Mishap(Input& input)
      : block(input.rarely() ? 1 + input.byte() % 2U : 0),
        what(input.byte() % 4U),
        axis(input.byte() % 3U),
        number(block > 0 ? static_cast<std::int64_t>(input.word()) : 0),
        twice(input.rarely()) {}

  void befall(std::size_t index, dif_block& of) const {
    if (index == block) {
      std::int64_t* const numbers[] = {of.offset, of.dims, of.ghost_low, of.ghost_high};
      numbers[what][axis] = number;
    }
  }
};

void check_same(const dif_mesh* whole, const dif_mesh* welded) {
  const Arrays a(whole);
  const Arrays b(welded);
  demand(a.vertices == b.vertices && a.triangle_count == b.triangle_count);
  demand(a.normal_count == b.normal_count && a.id_count == b.id_count);
  demand(same_bits(a.positions, b.positions, 3 * a.vertices));
  demand(same_bits(a.normals, b.normals, 3 * a.normal_count));
  demand(same_bits(a.ids, b.ids, a.id_count));
  demand(same_bits(a.triangles, b.triangles, 3 * a.triangle_count));
}

}  // namespace

void call_reconstruct(Input& input) {
  Field field(input, 125);
  dif_options options = draw_options(input, field);
  Watch watch(input);
  const bool wants_planes = input.number(4) == 1;
  field.fill(input);
  dif_options watched = options;
  watch.attend(watched);
  dif_mesh* made = nullptr;
  const dif_status status = dif_reconstruct(&field.c(), &watched, &made);
  const Mesh mesh = taken(status, made);
  watch.check(status);
  if (mesh) {
    check_mesh(mesh.get(), field, options);
  }
  if (wants_planes && !watch.cancelled) {
    check_planes(field, options, status);
  }
}

void call_blocks(Input& input) {
  Field field(input, 64);
  dif_options options = draw_options(input, field);
  options.edge_ids = 1;
  const Cuts cuts(input, field.c());
  const Mishap mishap(input);
  field.fill(input);
  dif_mesh* made = nullptr;
  const dif_status status = dif_reconstruct(&field.c(), &options, &made);
  const Mesh whole = taken(status, made);

  const dif_grid grid = field.grid();
  const bool periodic = options.boundary[2 * cuts.axis] == DIF_SIDE_PERIODIC;
  std::vector<Mesh> meshes;
  std::vector<const dif_mesh*> borrowed;
  for (std::size_t n = 1; n < cuts.at.size(); ++n) {
    BlockMemory part(field, cuts.axis, cuts.at[n - 1], cuts.at[n], periodic);
    mishap.befall(n, part.block);
    const dif_status of_part =
        dif_reconstruct_block(&part.field, &part.block, &grid, &options, &made);
    meshes.push_back(taken(of_part, made));
    demand(mishap.block > 0 || !whole || of_part == DIF_OK);
    borrowed.push_back(meshes.back().get());
  }
  if (mishap.twice) {
    borrowed.push_back(borrowed.front());
  }
  const dif_status joined =
      dif_mesh_weld(borrowed.data(), static_cast<std::int64_t>(borrowed.size()), &grid, &made);
  const Mesh welded = taken(joined, made);
  if (whole && mishap.block == 0 && !mishap.twice) {
    demand(joined == DIF_OK);
    check_same(whole.get(), welded.get());
  }
}

}  // namespace difmesh::fuzz
