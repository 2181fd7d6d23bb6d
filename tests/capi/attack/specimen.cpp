#include "specimen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>

#include "random.hpp"
#include "ugly_values.hpp"

namespace difmesh::attack {
namespace {

Index3 some_dims(Random& random) {
  Index3 dims{};
  if (random.one_in(24)) {
    constexpr std::int64_t kLong[] = {62, 63, 64, 65, 70, 126, 127, 128, 130, 200};
    for (std::int64_t& dim : dims) {
      dim = 1 + random.below(3);
    }
    dims[static_cast<std::size_t>(random.one_in(2) ? 0 : random.below(3))] = random.of(kLong);
    return dims;
  }
  constexpr std::int64_t kLargest[] = {2, 2, 4, 4, 6, 9};
  for (std::int64_t& dim : dims) {
    dim = 1 + random.below(random.of(kLargest));
  }
  return dims;
}

void choose_sides(Random& random, dif_options& options) {
  constexpr std::int32_t kAlone[] = {DIF_SIDE_OPEN, DIF_SIDE_OPEN, DIF_SIDE_MIRROR, DIF_SIDE_EMPTY,
                                     DIF_SIDE_FULL};
  constexpr std::int32_t kAll[] = {DIF_SIDE_DEFAULT,  DIF_SIDE_OPEN,  DIF_SIDE_MIRROR,
                                   DIF_SIDE_PERIODIC, DIF_SIDE_EMPTY, DIF_SIDE_FULL};
  if (random.one_in(4)) {
    std::fill_n(options.boundary, 6, random.of(kAll));
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = random.one_in(5);
    options.boundary[2 * axis] = periodic ? DIF_SIDE_PERIODIC : random.of(kAlone);
    options.boundary[2 * axis + 1] = periodic ? DIF_SIDE_PERIODIC : random.of(kAlone);
  }
}

void choose_options(Random& random, dif_options& options) {
  (void)dif_options_init(&options, sizeof options);
  constexpr std::int32_t kPlacements[] = {
      DIF_PLACEMENT_DEFAULT, DIF_PLACEMENT_PLIC,   DIF_PLACEMENT_PLIC,     DIF_PLACEMENT_PLIC,
      DIF_PLACEMENT_CURVED,  DIF_PLACEMENT_MANSON, DIF_PLACEMENT_MIDPOINT, DIF_PLACEMENT_LINEAR};
  constexpr std::int32_t kNormals[] = {DIF_NORMALS_DEFAULT,
                                       DIF_NORMALS_YOUNGS,
                                       DIF_NORMALS_MYC,
                                       DIF_NORMALS_HEIGHT_FUNCTION,
                                       DIF_NORMALS_HEIGHT_FUNCTION,
                                       DIF_NORMALS_ELVIRA,
                                       DIF_NORMALS_LVIRA};
  options.placement = random.of(kPlacements);
  options.normals = random.of(kNormals);
  choose_sides(random, options);
  options.vertex_normals = 1;
  options.edge_ids = 1;
  options.threads = 1;
  if (random.one_in(2)) {
    const double tolerances[] = {0.0, 1e-12, 1e-7, 1e-3, 0.01, 0.05, 0.1, random.even(0.0, 0.1)};
    options.purity_tolerance = random.of(tolerances);
  }
  if (random.one_in(4)) {
    const double bounds[] = {0.0, 0.05, 0.2, 1.0};
    options.overshoot_bound = random.of(bounds);
  }
  if (random.one_in(4)) {
    const double clearances[] = {1e-13, 1e-6, 1e-3, 0.1, 0.25, 0.25};
    options.clearance = random.of(clearances);
  }
}

void choose_place(Random& random, Specimen& specimen) {
  const std::int64_t kind = random.below(10);
  const double scale = kind == 9 ? std::pow(10.0, random.even(-80.0, 80.0)) : 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (kind >= 4) {
      specimen.spacing[a] =
          scale * (kind < 7 ? random.even(0.3, 3.0) : std::pow(10.0, random.even(0.0, 6.0)));
    }
  }
  if (random.one_in(2)) {
    return;
  }
  const double power = random.one_in(3) ? 12.0 : random.even(0.0, 12.0);
  for (std::size_t a = 0; a < 3; ++a) {
    // As far away as the library allows: cells can be told apart.
    const double farthest =
        specimen.spacing[a] * (0x1p39 - static_cast<double>(specimen.dims[a] + 1));
    const double origin = random.even(-1.0, 1.0) * std::pow(10.0, power);
    specimen.origin[a] = std::clamp(origin, -farthest, farthest);
  }
}

void choose_memory(Random& random, Specimen& specimen) {
  constexpr std::int32_t kTypes[] = {DIF_FLOAT64, DIF_FLOAT64, DIF_FLOAT64,
                                     DIF_FLOAT32, DIF_UINT8,   DIF_UINT16};
  specimen.type = random.of(kTypes);
  if (random.one_in(2)) {
    return;
  }
  std::swap(specimen.memory_order[0], specimen.memory_order[random.next() % 3]);
  std::swap(specimen.memory_order[1], specimen.memory_order[1 + random.next() % 2]);
  for (int& gap : specimen.gaps) {
    gap = static_cast<int>(1 + random.below(3)) * (random.one_in(3) ? -1 : 1);
  }
}

void choose_blocks(Random& random, Specimen& specimen) {
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<std::int64_t>& cuts = specimen.cuts[a];
    if (specimen.dims[a] < 2 || random.one_in(2)) {
      continue;
    }
    for (std::int64_t left = 1 + random.below(2); left > 0; --left) {
      cuts.push_back(1 + random.below(specimen.dims[a] - 1));
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  }
  specimen.more_ghosts = random.one_in(4) ? random.below(4) : 0;
}

template <class T>
constexpr T no_number() {
  if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(0x5a);
  } else {
    return std::numeric_limits<T>::quiet_NaN();
  }
}

}  // namespace

double Specimen::fraction(const Index3& cell) const {
  const double value = values[element(cell)];
  if (type == DIF_UINT8 || type == DIF_UINT16) {
    return value / (type == DIF_UINT8 ? 255.0 : 65535.0);
  }
  return std::clamp(value, 0.0, 1.0);
}

Specimen make_specimen(std::uint64_t seed) {
  Random random(seed);
  Specimen specimen;
  specimen.seed = seed;
  specimen.dims = some_dims(random);
  choose_options(random, specimen.options);
  choose_place(random, specimen);
  choose_memory(random, specimen);
  make_values(random, specimen);
  choose_blocks(random, specimen);
  constexpr std::int32_t kThreads[] = {1, 1, 1, 1, 1, 2, 7, 0};
  specimen.other_threads = random.of(kThreads);
  specimen.variants = static_cast<unsigned>(random.next() >> 32);
  return specimen;
}

template <class T>
void* Elements::fill(const Specimen& specimen, const Index3& from, const dif_field& field) {
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t reach = (field.dims[a] - 1) * field.strides[a];
    low += std::min<std::int64_t>(reach, 0);
    high += std::max<std::int64_t>(reach, 0);
  }
  const auto count = static_cast<std::size_t>(high - low + 1);
  memory_.resize(count * sizeof(T));
  T* const all = reinterpret_cast<T*>(memory_.data());
  std::fill_n(all, count, no_number<T>());
  T* const first = all - low;
  Index3 n{};
  for (n[2] = 0; n[2] < field.dims[2]; ++n[2]) {
    for (n[1] = 0; n[1] < field.dims[1]; ++n[1]) {
      for (n[0] = 0; n[0] < field.dims[0]; ++n[0]) {
        Index3 cell;
        std::int64_t place = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          const std::int64_t dim = specimen.dims[a];
          cell[a] = ((from[a] + n[a]) % dim + dim) % dim;
          place += n[a] * field.strides[a];
        }
        first[place] = static_cast<T>(specimen.values[specimen.element(cell)]);
      }
    }
  }
  return first;
}

dif_field Elements::lay_out(const Specimen& specimen, const Index3& from, const Index3& size) {
  dif_field field{};
  field.struct_size = sizeof field;
  field.type = specimen.type;
  std::int64_t stride = 1;
  for (const std::size_t a : specimen.memory_order) {
    stride *= std::abs(specimen.gaps[a]);
    field.strides[a] = specimen.gaps[a] < 0 ? -stride : stride;
    stride *= size[a];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    field.dims[a] = size[a];
    field.origin[a] = specimen.origin[a];
    field.spacing[a] = specimen.spacing[a];
  }
  switch (specimen.type) {
    case DIF_FLOAT32:
      field.data = fill<float>(specimen, from, field);
      break;
    case DIF_UINT8:
      field.data = fill<std::uint8_t>(specimen, from, field);
      break;
    case DIF_UINT16:
      field.data = fill<std::uint16_t>(specimen, from, field);
      break;
    default:
      field.data = fill<double>(specimen, from, field);
  }
  return field;
}

dif_field Elements::lay_out_plainly(const Specimen& specimen) {
  Specimen plain = specimen;
  plain.memory_order = {0, 1, 2};
  plain.gaps = {1, 1, 1};
  return lay_out(plain, {0, 0, 0}, specimen.dims);
}

}  // namespace difmesh::attack
