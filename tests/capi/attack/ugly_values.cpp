#include "ugly_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace difmesh::attack {
namespace {

using Vector = std::array<double, 3>;

double neighbour(double value, std::int64_t step) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return step == 0 ? value : std::nextafter(value, step > 0 ? kFar : -kFar);
}

// Values on which decisions turn, and their neighbours.
class Palette {
 public:
  explicit Palette(const Specimen& specimen) {
    const double tolerance = specimen.options.purity_tolerance;
    for (const double value :
         {0.0,    1e-7,       1e-6, 0.01, 0.3,       0.5,       0.7,
          0.99,   1.0 - 1e-6, 1.0,  1.05, -0.05,     tolerance, 1.0 - tolerance,
          5e-324, 1e-300,     0.25, 0.75, 1.0 / 3.0, -1e-17,    1.0 + 1e-15}) {
      values_.push_back(value);
    }
  }
  [[nodiscard]] double pick(Random& random) const {
    const double value =
        values_[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(values_.size())))];
    return neighbour(value, random.below(4) - 1);  // the value itself twice as often
  }

 private:
  std::vector<double> values_;
};

template <class Value>
void for_each_cell(Specimen& specimen, const Value& value) {
  Index3 cell{};
  for (cell[2] = 0; cell[2] < specimen.dims[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] < specimen.dims[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] < specimen.dims[0]; ++cell[0]) {
        specimen.values[specimen.element(cell)] = value(cell);
      }
    }
  }
}

void palette_noise(Random& random, const Palette& palette, Specimen& specimen) {
  for_each_cell(specimen, [&](const Index3&) { return palette.pick(random); });
}

void few_values(Random& random, const Palette& palette, Specimen& specimen) {
  double values[4];
  for (double& value : values) {
    value = palette.pick(random);
  }
  const std::int64_t count = 2 + random.below(3);
  for_each_cell(specimen, [&](const Index3&) { return values[random.below(count)]; });
}

void even_noise(Random& random, const Palette&, Specimen& specimen) {
  for_each_cell(specimen, [&](const Index3&) { return random.even(); });
}

void full_and_empty(Random& random, const Palette&, Specimen& specimen) {
  const std::int64_t levels = 2 + random.below(2);  // or halves too
  for_each_cell(specimen, [&](const Index3&) {
    return static_cast<double>(random.below(levels)) / static_cast<double>(levels - 1);
  });
}

void checkerboard(Random& random, const Palette& palette, Specimen& specimen) {
  const double values[] = {palette.pick(random), random.one_in(2) ? 0.5 : palette.pick(random)};
  const std::int64_t size = 1 + random.below(2);
  for_each_cell(specimen, [&](const Index3& cell) {
    return values[(cell[0] / size + cell[1] / size + cell[2] / size) % 2];
  });
}

// The same value in every cell of a layer.
void layers(Random& random, const Palette& palette, Specimen& specimen) {
  const auto axis = static_cast<std::size_t>(random.below(3));
  std::vector<double> values;
  for (std::int64_t n = 0; n < specimen.dims[axis]; ++n) {
    values.push_back(random.one_in(2) ? palette.pick(random)
                                      : static_cast<double>(random.below(2)));
  }
  for_each_cell(specimen,
                [&](const Index3& cell) { return values[static_cast<std::size_t>(cell[axis])]; });
}

Vector direction(Random& random) {
  Vector m{};
  const bool whole = random.one_in(2);
  while (m[0] == 0.0 && m[1] == 0.0 && m[2] == 0.0) {
    for (double& each : m) {
      each = whole ? static_cast<double>(random.below(5) - 2) : random.even(-1.0, 1.0);
    }
  }
  return m;
}

Index3 some_cell(Random& random, const Specimen& specimen) {
  return {random.below(specimen.dims[0]), random.below(specimen.dims[1]),
          random.below(specimen.dims[2])};
}

// The exact fraction of a cell below a plane, in units of cells.
double below_plane(const Vector& m, double offset) {
  constexpr double kUnit[3] = {1.0, 1.0, 1.0};
  double fraction = 0.0;
  (void)dif_plane_fraction(kUnit, 1, m.data(), &offset, &fraction);
  return fraction;
}

// Half spaces whose plane goes through the centre of a cell, or a bit beside it, and films.
void half_space(Random& random, const Palette&, Specimen& specimen) {
  const Vector m = direction(random);
  const Index3 centre = some_cell(random, specimen);
  const double beside[] = {0.0, 0.0, 1e-16, -1e-16, 1e-9, random.even(-0.5, 0.5)};
  const double shift = random.of(beside);
  const double film = random.one_in(3) ? random.even(0.0, 1.5) : 0.0;
  for_each_cell(specimen, [&](const Index3& cell) {
    double offset = shift;
    for (std::size_t a = 0; a < 3; ++a) {
      offset += m[a] * static_cast<double>(centre[a] - cell[a]);
    }
    const double below = below_plane(m, offset);
    return film > 0.0 ? below - below_plane(m, offset - film) : below;
  });
}

void ball(Random& random, const Palette&, Specimen& specimen) {
  const Index3 near = some_cell(random, specimen);
  const double radius = random.even(0.2, 4.0);
  Vector centre;
  for (std::size_t a = 0; a < 3; ++a) {
    centre[a] = static_cast<double>(near[a]) + (random.one_in(2) ? 0.0 : random.even(-0.5, 0.5));
  }
  const bool hole = random.one_in(3);
  for_each_cell(specimen, [&](const Index3& cell) {
    double square = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double along = static_cast<double>(cell[a]) - centre[a];
      square += along * along;
    }
    const double fraction = std::clamp(0.5 + radius - std::sqrt(square), 0.0, 1.0);
    return hole ? 1.0 - fraction : fraction;
  });
}

// Few cells in nothing, or holes in all.
void lone_cells(Random& random, const Palette& palette, Specimen& specimen) {
  const double around = random.one_in(2) ? 0.0 : 1.0;
  std::fill(specimen.values.begin(), specimen.values.end(), around);
  for (std::int64_t left = 1 + random.below(4); left > 0; --left) {
    specimen.values[specimen.element(some_cell(random, specimen))] =
        random.one_in(3) ? random.even() : palette.pick(random);
  }
}

// Replaces some cells.
void sprinkle(Random& random, const Palette& palette, Specimen& specimen) {
  const std::int64_t rarity = 2 + random.below(12);
  for (double& value : specimen.values) {
    if (random.one_in(rarity)) {
      value = palette.pick(random);
    }
  }
}

// Moves values to their neighbours.
void jitter(Random& random, Specimen& specimen) {
  for (double& value : specimen.values) {
    if (random.one_in(3)) {
      value = neighbour(value, random.below(2) * 2 - 1);
    }
  }
}

// Clears what is too far outside [0, 1], but now and then, for which the library must refuse the
// field.
void tame(Random& random, Specimen& specimen) {
  if (random.one_in(16)) {
    return;
  }
  const double bound = specimen.options.overshoot_bound;
  for (double& value : specimen.values) {
    if (std::max(-value, value - 1.0) > 0.99 * bound) {
      value = std::clamp(value, 0.0, 1.0);
    }
  }
}

// What the elements of the specimen's type hold.
void round_to_type(Random& random, Specimen& specimen) {
  const bool to_neighbour = random.one_in(8);
  for (double& value : specimen.values) {
    if (specimen.type == DIF_FLOAT32) {
      auto narrow = static_cast<float>(value);
      if (to_neighbour && random.one_in(3)) {
        narrow = std::nextafter(narrow, random.one_in(2) ? 2.0F : -2.0F);
      }
      value = static_cast<double>(narrow);
    } else if (specimen.type != DIF_FLOAT64) {
      const double largest = specimen.type == DIF_UINT8 ? 255.0 : 65535.0;
      value = std::round(std::clamp(value, 0.0, 1.0) * largest);
    }
  }
}

}  // namespace

void make_values(Random& random, Specimen& specimen) {
  using Fill = void (*)(Random&, const Palette&, Specimen&);
  constexpr Fill kFills[] = {palette_noise,  few_values,   few_values, even_noise,
                             full_and_empty, checkerboard, layers,     half_space,
                             half_space,     ball,         lone_cells};
  specimen.values.assign(
      static_cast<std::size_t>(specimen.dims[0] * specimen.dims[1] * specimen.dims[2]), 0.0);
  const Palette palette(specimen);
  random.of(kFills)(random, palette, specimen);
  if (random.one_in(3)) {
    sprinkle(random, palette, specimen);
  }
  if (random.one_in(5)) {
    jitter(random, specimen);
  }
  tame(random, specimen);
  round_to_type(random, specimen);
}

}  // namespace difmesh::attack
