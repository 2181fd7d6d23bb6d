// dif_reconstruct() and dif_field_planes() on fields of any layout, values and options. What is accepted must
// give a manifold mesh, closed where the sides close it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "difmesh/difmesh.h"

namespace {

void demand(bool holds) {
  if (!holds) {
    std::abort();
  }
}

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  std::int64_t number(std::int64_t below) { return byte() % below; }
  /// Mostly what is expected, now and then any bits.
  double number_or_any(double usual) {
    const std::uint8_t kind = byte();
    if (kind < 200) {
      return usual;
    }
    if (kind < 210) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    std::uint64_t bits = 0;
    for (int n = 0; n < 8; ++n) {
      bits = bits << 8 | byte();
    }
    double any = 0.0;
    std::memcpy(&any, &bits, sizeof any);
    return any;
  }
  /// Values that solvers hold, and some that they should not.
  double fraction() {
    constexpr std::array special{0.0,    1.0,  0.5,        0.5 + 1e-16, 1e-30, -1e-9,
                                 1e-6,   1e-7, 1 - 1e-7,   1 + 1e-8,    0.25,  0.75,
                                 -0.099, 1.09, 0.49999999, 1e-300};
    const std::uint8_t value = byte();
    return value < special.size() ? special[value] : (value - 16) / 239.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

// A block of memory that holds the field's elements and nothing more.
struct Memory {
  std::vector<std::uint8_t> bytes;
  std::int64_t first = 0;  // element of cell (0, 0, 0)
};

Memory lay_out(Input& input, dif_field& field, std::int64_t element_bytes) {
  std::array<int, 3> order{0, 1, 2};
  const std::int64_t turns = input.number(6);
  for (std::int64_t n = 0; n < turns; ++n) {
    std::next_permutation(order.begin(), order.end());
  }
  std::int64_t extent = 1;
  for (const int axis : order) {
    field.strides[axis] = extent;
    extent *= field.dims[axis] + input.number(3);
  }
  Memory memory;
  std::int64_t last = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (input.number(3) == 0) {
      field.strides[axis] = -field.strides[axis];
      memory.first -= (field.dims[axis] - 1) * field.strides[axis];
    } else {
      last += (field.dims[axis] - 1) * field.strides[axis];
    }
  }
  memory.bytes.resize(static_cast<std::size_t>((memory.first + last + 1) * element_bytes));
  return memory;
}

void fill(Input& input, std::int32_t type, Memory& memory) {
  const auto put = [&](auto element, std::size_t at) {
    std::memcpy(memory.bytes.data() + at * sizeof element, &element, sizeof element);
  };
  const std::array<std::size_t, 5> sizes{0, 4, 8, 1, 2};
  const std::size_t count = memory.bytes.size() / sizes[static_cast<std::size_t>(type)];
  for (std::size_t n = 0; n < count; ++n) {
    switch (type) {
      case DIF_FLOAT32:
        put(static_cast<float>(input.fraction()), n);
        break;
      case DIF_FLOAT64:
        put(input.fraction(), n);
        break;
      case DIF_UINT8:
        put(input.byte(), n);
        break;
      default:
        put(static_cast<std::uint16_t>(input.byte() << 8 | input.byte()), n);
    }
  }
}

dif_options make_options(Input& input) {
  dif_options options;
  demand(dif_options_init(&options, sizeof options) == DIF_OK);
  options.placement = static_cast<std::int32_t>(input.number(6)) - (input.byte() == 1 ? 3 : 0);
  options.normals = static_cast<std::int32_t>(input.number(4));
  for (std::int32_t& side : options.sides) {
    side = static_cast<std::int32_t>(input.number(6));
  }
  for (std::size_t axis = 0; axis < 3 && input.number(4) != 0; ++axis) {
    options.sides[2 * axis + 1] = options.sides[2 * axis];
  }
  options.vertex_normals = static_cast<std::int32_t>(input.number(2));
  options.edge_ids = static_cast<std::int32_t>(input.number(2));
  options.purity_tolerance = input.number_or_any(1e-6);
  options.overshoot_bound = input.number_or_any(0.1);
  options.clearance = input.number_or_any(1e-12);
  options.threads = 1;
  return options;
}

void check_mesh(const dif_mesh* mesh, const dif_options& options) {
  dif_measure facts;
  demand(dif_measure_init(&facts, sizeof facts) == DIF_OK);
  demand(dif_mesh_measure(mesh, &facts) == DIF_OK);
  demand(facts.manifold == 1);
  demand(facts.isolated_vertices == 0);
  // Where sides of both kinds meet, the outside itself changes and the surface ends.
  const std::int32_t first = options.sides[0];
  const bool closes = (first == DIF_SIDE_EMPTY || first == DIF_SIDE_FULL) &&
                      std::all_of(options.sides, options.sides + 6,
                                  [first](std::int32_t side) { return side == first; });
  demand(!closes || facts.closed == 1);
  dif_report report;
  demand(dif_report_init(&report, sizeof report) == DIF_OK);
  demand(dif_mesh_report(mesh, &report) == DIF_OK);
  demand((report.closed == 1) == (facts.boundary_edges == 0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const auto type = static_cast<std::int32_t>(1 + input.number(4));
  const std::array<std::int64_t, 5> sizes{0, 4, 8, 1, 2};
  std::int64_t dims[3];
  for (std::int64_t& dim : dims) {
    dim = 1 + input.number(9);
  }
  // Columns of nine cells fit, but not nine ways: small fields show the same, sooner.
  while (dims[0] * dims[1] * dims[2] > 125) {
    --*std::max_element(dims, dims + 3);
  }
  dif_field field;
  demand(dif_field_init(&field, sizeof field, dims, type, dims) == DIF_OK);
  Memory memory = lay_out(input, field, sizes[static_cast<std::size_t>(type)]);
  field.data = memory.bytes.data() + memory.first * sizes[static_cast<std::size_t>(type)];
  for (int axis = 0; axis < 3; ++axis) {
    field.origin[axis] = input.number_or_any(0.25);
    field.spacing[axis] = input.number_or_any(1.0 + axis);
  }
  const dif_options options = make_options(input);
  fill(input, type, memory);

  dif_mesh* mesh = nullptr;
  const dif_status status = dif_reconstruct(&field, &options, &mesh);
  demand((status == DIF_OK) == (mesh != nullptr));
  demand(status != DIF_ERROR_INTERNAL);
  if (mesh != nullptr) {
    check_mesh(mesh, options);
  }
  dif_mesh_free(mesh);
  if (input.number(4) != 0) {
    return 0;
  }
  std::vector<double> offsets(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]), -9.0);
  dif_plane_arrays arrays;
  demand(dif_plane_arrays_init(&arrays, sizeof arrays) == DIF_OK);
  arrays.offset = offsets.data();
  arrays.strides[0] = 1;
  arrays.strides[1] = dims[0];
  arrays.strides[2] = dims[0] * dims[1];
  const dif_status planes = dif_field_planes(&field, &options, &arrays);
  demand(planes == status);
  demand(planes != DIF_OK || std::all_of(offsets.begin(), offsets.end(),
                                         [](double offset) { return std::isfinite(offset); }));
  return 0;
}
