#include "drawn.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace difmesh::fuzz {
namespace {

constexpr std::array<std::int32_t, 10> kTypes{DIF_FLOAT32, DIF_FLOAT64, DIF_UINT8, DIF_UINT16,
                                              DIF_INT8,    DIF_INT16,   DIF_INT32, DIF_UINT32,
                                              DIF_INT64,   DIF_UINT64};

std::int64_t size_of(std::int32_t type) {
  switch (type) {
    case DIF_UINT8:
    case DIF_INT8:
      return 1;
    case DIF_UINT16:
    case DIF_INT16:
      return 2;
    case DIF_FLOAT32:
    case DIF_INT32:
    case DIF_UINT32:
      return 4;
    default:
      return 8;
  }
}

template <class T>
void put(std::uint8_t* to, T element) {
  std::memcpy(to, &element, sizeof element);
}

/// One element that a solver would not hold, of the type's size.
void spoil(Input& input, std::int32_t type, std::uint8_t* to) {
  if (type == DIF_FLOAT32) {
    const double number = input.any();
    put(to, std::isinf(number) ? static_cast<float>(number)
                               : static_cast<float>(std::clamp(number, -3e38, 3e38)));
  } else if (type == DIF_FLOAT64) {
    put(to, input.any());
  }
}

Mesh from_arrays(const std::vector<double>& points, const std::vector<std::uint32_t>& indices) {
  dif_mesh* mesh = nullptr;
  const auto vertices = static_cast<std::int64_t>(points.size() / 3);
  const auto triangles = static_cast<std::int64_t>(indices.size() / 3);
  const dif_status status =
      dif_mesh_from_arrays(points.data(), vertices, indices.data(), triangles, &mesh);
  const bool in_range = std::ranges::all_of(
      indices, [&](std::uint32_t index) { return static_cast<std::int64_t>(index) < vertices; });
  demand((status == DIF_OK) == in_range);
  return taken(status, mesh);
}

std::vector<std::uint32_t> any_triangles(Input& input, std::int64_t vertices) {
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(3 * input.number(16)));
  for (std::uint32_t& index : indices) {
    const std::uint8_t value = input.byte();
    index = value == 255 || vertices == 0 ? static_cast<std::uint32_t>(input.word())
                                          : value % static_cast<std::uint32_t>(vertices);
  }
  return indices;
}

/// Closed, the one way round or the other.
std::vector<std::uint32_t> tetrahedra(Input& input, std::int64_t count) {
  constexpr std::uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::vector<std::uint32_t> indices;
  for (std::uint32_t body = 0; body < count; ++body) {
    const bool turned = input.number(2) == 1;
    for (const auto& face : faces) {
      indices.push_back(4 * body + face[0]);
      indices.push_back(4 * body + face[turned ? 2 : 1]);
      indices.push_back(4 * body + face[turned ? 1 : 2]);
    }
  }
  return indices;
}

}  // namespace

dif_grid unit_cells(const Index3& dims) {
  dif_grid grid;
  demand(dif_grid_init(&grid, sizeof grid, dims.data()) == DIF_OK);
  return grid;
}

void demand_honest(dif_status status) {
  switch (status) {
    case DIF_OK:
    case DIF_ERROR_INVALID_ARGUMENT:
    case DIF_ERROR_INVALID_GRID:
    case DIF_ERROR_INVALID_VALUE:
    case DIF_ERROR_TOO_LARGE:
    case DIF_ERROR_CANCELLED:
      break;
    default:
      demand(false);
  }
  demand(status == DIF_OK || dif_last_message()[0] != '\0');
}

Mesh taken(dif_status status, dif_mesh* mesh) {
  demand_honest(status);
  demand((status == DIF_OK) == (mesh != nullptr));
  return Mesh(mesh);
}

Index3 draw_dims(Input& input, std::int64_t most_cells) {
  Index3 dims;
  for (std::int64_t& dim : dims) {
    dim = 1 + input.number(9);
  }
  // Columns of nine cells fit, but not nine ways: small fields show the same, sooner.
  while (dims[0] * dims[1] * dims[2] > most_cells) {
    --*std::max_element(dims.begin(), dims.end());
  }
  return dims;
}

Field::Field(Input& input, std::int64_t most_cells, std::int64_t types) {
  const std::int32_t type = kTypes[static_cast<std::size_t>(input.number(types))];
  const Index3 dims = draw_dims(input, most_cells);
  const double somewhere = 0.0;
  demand(dif_field_init(&field_, sizeof field_, &somewhere, type, dims.data()) == DIF_OK);
  lay_out(input);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    field_.origin[axis] = input.number_or_any(0.25);
    field_.spacing[axis] = input.number_or_any(1.0 + static_cast<double>(axis));
  }
  stretch(input);
}

// One field in eight has tables of faces, for axes that it draws.
void Field::stretch(Input& input) {
  const std::uint8_t kind = input.byte();
  if (kind < 224) {
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((kind >> axis & 1) != 0) {
      double face = input.number_or_any(0.0);
      for (std::int64_t n = 0; n <= field_.dims[axis]; ++n) {
        faces_[axis].push_back(face);
        face += input.number_or_any((1.0 + input.byte()) / 64.0);
      }
    }
  }
  const auto table = [&](std::size_t axis) {
    return faces_[axis].empty() ? nullptr : faces_[axis].data();
  };
  field_.faces_x = table(0);
  field_.faces_y = table(1);
  field_.faces_z = table(2);
}

void Field::lay_out(Input& input) {
  std::array<std::size_t, 3> order{0, 1, 2};
  const std::int64_t turns = input.number(6);
  for (std::int64_t n = 0; n < turns; ++n) {
    std::next_permutation(order.begin(), order.end());
  }
  std::int64_t extent = 1;
  for (const std::size_t axis : order) {
    field_.strides[axis] = extent;
    extent *= field_.dims[axis] + input.number(3);
  }
  std::int64_t first = 0;  // element of cell (0, 0, 0)
  std::int64_t last = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (input.number(3) == 0) {
      field_.strides[axis] = -field_.strides[axis];
      first -= (field_.dims[axis] - 1) * field_.strides[axis];
    } else {
      last += (field_.dims[axis] - 1) * field_.strides[axis];
    }
  }
  memory_.resize(static_cast<std::size_t>((first + last + 1) * element_bytes()));
  field_.data = memory_.data() + first * element_bytes();
}

void Field::fill(Input& input) {
  const bool spoils = input.rarely();
  const auto width = static_cast<std::size_t>(element_bytes());
  const std::size_t at = spoils ? input.byte() % (memory_.size() / width) * width : 0;
  std::array<std::uint8_t, 8> bad{};
  if (spoils) {
    spoil(input, field_.type, bad.data());
  }
  for (std::size_t n = 0; n < memory_.size(); n += width) {
    switch (field_.type) {
      case DIF_FLOAT32:
        put(&memory_[n], static_cast<float>(input.fraction()));
        break;
      case DIF_FLOAT64:
        put(&memory_[n], input.fraction());
        break;
      case DIF_UINT16: {
        const int high = input.byte();
        put(&memory_[n], static_cast<std::uint16_t>(high << 8 | input.byte()));
        break;
      }
      default:  // integers of the other types: small ones of both signs, with any low byte
        put(&memory_[n], input.byte());
        if (width > 1) {
          std::memset(&memory_[n + 1], input.byte(), width - 1);
        }
    }
  }
  if (spoils) {
    std::memcpy(&memory_[at], bad.data(), width);
  }
}

std::int64_t Field::cells() const {
  return field_.dims[0] * field_.dims[1] * field_.dims[2];
}

std::int64_t Field::element_bytes() const {
  return size_of(field_.type);
}

const std::uint8_t* Field::element(const Index3& cell) const {
  const std::int64_t at =
      cell[0] * field_.strides[0] + cell[1] * field_.strides[1] + cell[2] * field_.strides[2];
  return static_cast<const std::uint8_t*>(field_.data) + at * element_bytes();
}

dif_grid Field::grid() const {
  dif_grid grid = unit_cells({field_.dims[0], field_.dims[1], field_.dims[2]});
  std::copy_n(field_.origin, 3, grid.origin);
  std::copy_n(field_.spacing, 3, grid.spacing);
  grid.faces_x = field_.faces_x;
  grid.faces_y = field_.faces_y;
  grid.faces_z = field_.faces_z;
  return grid;
}

Watch::Watch(Input& input) {
  const std::uint8_t kind = input.byte();
  watches_ = kind > 223;
  calls_left = kind > 239 ? kind - 240 : -1;
}

std::int32_t Watch::called(void* user, double share_done) {
  auto& watch = *static_cast<Watch*>(user);
  demand(!watch.cancelled && share_done >= watch.done && share_done <= 1.0);
  watch.done = share_done;
  watch.cancelled = watch.calls_left == 0;
  --watch.calls_left;
  return watch.cancelled ? 1 : 0;
}

void Watch::check(dif_status status) const {
  demand((status == DIF_ERROR_CANCELLED) == cancelled);
}

std::int32_t draw_threads(Input& input) {
  return input.rarely() ? -1 : 1;
}

void draw_sides(Input& input, std::int32_t (&sides)[6]) {
  // Open ones seldom: along these planes are fitted, which takes as long as all else.
  constexpr std::array usual{DIF_SIDE_EMPTY,    DIF_SIDE_MIRROR, DIF_SIDE_PERIODIC,
                             DIF_SIDE_FULL,     DIF_SIDE_EMPTY,  DIF_SIDE_MIRROR,
                             DIF_SIDE_PERIODIC, DIF_SIDE_FULL,   DIF_SIDE_PERIODIC,
                             DIF_SIDE_EMPTY,    DIF_SIDE_OPEN,   DIF_SIDE_DEFAULT};
  for (std::int32_t& side : sides) {
    const std::int32_t drawn = input.choice(usual.size() - 1);
    side = drawn >= 0 && drawn < std::ssize(usual) ? usual[static_cast<std::size_t>(drawn)] : drawn;
  }
  for (std::size_t axis = 0; axis < 3 && input.number(4) != 0; ++axis) {
    sides[2 * axis + 1] = sides[2 * axis];
  }
}

dif_options draw_options(Input& input, const Field& field) {
  dif_options options = prepared(dif_options_init);
  options.placement = input.choice(DIF_PLACEMENT_CURVED);
  options.normals = input.choice(DIF_NORMALS_LVIRA);
  // These search for each plane: what they do with large fields, they do with small ones.
  if (field.cells() > 27 &&
      (options.normals == DIF_NORMALS_ELVIRA || options.normals == DIF_NORMALS_LVIRA)) {
    options.normals = DIF_NORMALS_DEFAULT;
  }
  draw_sides(input, options.boundary);
  options.vertex_normals = input.choice(1);
  options.edge_ids = input.choice(1);
  options.purity_tolerance = input.number_or_any(1e-6);
  options.overshoot_bound = input.number_or_any(0.1);
  options.clearance = input.number_or_any(1e-12);
  options.threads = draw_threads(input);
  return options;
}

std::vector<double> draw_points(Input& input, std::int64_t count) {
  std::vector<double> points(static_cast<std::size_t>(3 * count));
  for (double& number : points) {
    const std::uint8_t value = input.byte();
    number = value == 255 ? input.any() : value / 64.0;
  }
  return points;
}

DrawnMesh::DrawnMesh(Input& input) : grid(unit_cells({3, 3, 3})) {
  const std::int64_t kind = input.number(4);
  if (kind < 2) {
    Field field(input, 27);
    dif_options options = draw_options(input, field);
    options.edge_ids = 1;
    field.fill(input);
    grid = field.grid();
    dif_mesh* made = nullptr;
    const dif_status status = dif_reconstruct(&field.c(), &options, &made);
    mesh = taken(status, made);
    // Extreme grids make extreme coordinates.
    usual =
        std::all_of(grid.spacing, grid.spacing + 3,
                    [](double edge) { return edge > 1e-3 && edge < 1e3; }) &&
        std::all_of(grid.origin, grid.origin + 3, [](double low) { return std::abs(low) < 1e3; });
    return;
  }
  const std::int64_t vertices = kind == 2 ? input.number(12) : 4 * (1 + input.number(3));
  const auto indices = kind == 2 ? any_triangles(input, vertices) : tetrahedra(input, vertices / 4);
  const std::vector<double> points = draw_points(input, vertices);
  usual = std::ranges::all_of(points, [](double number) { return std::abs(number) < 1e3; });
  mesh = from_arrays(points, indices);
}

}  // namespace difmesh::fuzz
