// Making fields: from values and labels, by mollification, from functions and from shapes.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calls.hpp"
#include "drawn.hpp"

namespace difmesh::fuzz {
namespace {

bool is_fraction(double value) {
  return value >= 0.0 && value <= 1.0;
}

/// A body bounded by a sphere and a plane, which may fail or stop after some calls.
class Body {
 public:
  explicit Body(Input& input) : calls_left_(input.rarely() ? input.byte() : -1) {
    stops_ = input.number(2) == 1;
    kinked_ = input.number(2) == 1;
    for (double& number : plane_) {
      number = input.number_or_any((input.byte() - 128) / 64.0);
    }
    for (double& number : centre_) {
      number = input.byte() / 64.0;
    }
    radius_ = input.byte() / 128.0;
  }

  static std::int32_t values(void* user, std::int64_t count, const double* points, double* values) {
    auto& body = *static_cast<Body*>(user);
    for (std::int64_t n = 0; n < count; ++n) {
      values[n] = body.value(points + 3 * n);
    }
    return body.stopped_ ? 1 : 0;
  }
  static std::int32_t gradients(void* user, std::int64_t count, const double* points,
                                double* gradients) {
    const auto& body = *static_cast<const Body*>(user);
    for (std::int64_t n = 0; n < 3 * count; ++n) {
      gradients[n] = 2.0 * (points[n] - body.centre_[static_cast<std::size_t>(n % 3)]);
    }
    return 0;
  }
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  double value(const double* point) {
    if (calls_left_ >= 0 && --calls_left_ < 0) {
      stopped_ = stopped_ || stops_;
      return std::numeric_limits<double>::quiet_NaN();
    }
    double square = -radius_ * radius_;
    double side = plane_[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from_centre = point[axis] - centre_[axis];
      square += from_centre * from_centre;
      side += plane_[axis] * point[axis];
    }
    return kinked_ ? std::max(square, side) : square;
  }

  std::int64_t calls_left_;
  bool stops_ = false;
  bool kinked_ = false;
  bool stopped_ = false;
  std::array<double, 4> plane_{};
  std::array<double, 3> centre_{};
  double radius_ = 0.0;
};

dif_function_options draw_function_options(Input& input) {
  dif_function_options options = prepared(dif_function_options_init);
  options.tolerance = input.number_or_any(1e-3);
  options.kink_tolerance = input.number_or_any(1e-2);
  options.max_calls_per_cell = input.rarely() ? static_cast<std::int64_t>(input.word()) : 1000;
  // Good ones that would take minutes where a function has a kink in every cell.
  options.max_calls_per_cell = std::min<std::int64_t>(options.max_calls_per_cell, 2000);
  options.tolerance = options.tolerance > 0.0 ? std::max(options.tolerance, 1e-6) : -1.0;
  options.kink_tolerance =
      options.kink_tolerance > 0.0 ? std::max(options.kink_tolerance, 1e-4) : -1.0;
  options.threads = draw_threads(input);
  return options;
}

dif_grid draw_grid(Input& input) {
  dif_grid grid = unit_cells(draw_dims(input, 8));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = input.number_or_any(0.0);
    grid.spacing[axis] = input.number_or_any(0.75);
  }
  return grid;
}

std::vector<double> room_for(const dif_grid& grid) {
  return std::vector<double>(static_cast<std::size_t>(grid.dims[0] * grid.dims[1] * grid.dims[2]),
                             -9.0);
}

dif_shape_options draw_shape(Input& input) {
  dif_shape_options options = prepared(dif_shape_options_init);
  options.kind = input.choice(DIF_SHAPE_GOLF_BALL);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    options.centre[axis] = input.number_or_any(0.75);
    options.rotation_degrees[axis] = input.number_or_any(30.0);
    options.semi_axes[axis] = input.number_or_any(0.25 + static_cast<double>(axis) / 4);
  }
  options.radius = input.number_or_any(0.75);
  options.tube_radius = input.number_or_any(0.25);
  options.exponent = input.number_or_any(4.0);
  options.scale = input.number_or_any(0.5);
  options.dimples = input.rarely() ? static_cast<std::int64_t>(input.word()) : input.number(12);
  options.dimple_radius = input.number_or_any(0.08);
  options.dimple_depth = input.number_or_any(0.012);
  return options;
}

struct ShapeDeleter {
  void operator()(dif_shape* shape) const { dif_shape_free(shape); }
};

void check_distances(Input& input, const dif_shape* shape) {
  const std::int64_t count = input.number(4);
  const std::vector<double> points = draw_points(input, count);
  std::vector<double> distances(static_cast<std::size_t>(count), -9.0);
  demand_honest(dif_shape_distances(shape, count, points.data(), distances.data()));
}

void check_labels(const Field& field, const std::vector<std::int64_t>& labels) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(field.cells()), 9);
  const dif_status status = dif_fractions_from_labels(
      &field.c(), static_cast<std::int64_t>(labels.size()), labels.data(), mask.data());
  demand_honest(status);
  demand(status != DIF_OK ||
         std::ranges::all_of(mask, [](std::uint8_t value) { return value == 0 || value == 255; }));
}

}  // namespace

void call_values(Input& input) {
  Field field(input, 64, 10);
  const double empty = input.number_or_any(0.0);
  const double full = input.number_or_any(input.byte());
  std::vector<std::int64_t> labels(static_cast<std::size_t>(input.number(4)));
  for (std::int64_t& label : labels) {
    label = input.rarely() ? static_cast<std::int64_t>(input.word()) : input.byte() - 128;
  }
  field.fill(input);
  double lowest = 0.0;
  double highest = 0.0;
  const dif_status found = dif_value_extremes(&field.c(), &lowest, &highest);
  demand_honest(found);
  demand(found != DIF_OK || !(lowest > highest));

  std::vector<double> fractions(static_cast<std::size_t>(field.cells()), -9.0);
  const dif_status status = dif_fractions_from_values(&field.c(), empty, full, fractions.data());
  demand_honest(status);
  const bool may_be_nan = field.c().type == DIF_FLOAT32 || field.c().type == DIF_FLOAT64;
  demand(status != DIF_OK || std::ranges::all_of(fractions, [&](double value) {
           return is_fraction(value) || (may_be_nan && std::isnan(value));
         }));
  check_labels(field, labels);
}

void call_mollify(Input& input) {
  Field field(input, 36);
  dif_mollify_options options = prepared(dif_mollify_options_init);
  options.radius = input.number_or_any(1.0 + 0.5 * static_cast<double>(input.number(4)));
  draw_sides(input, options.boundary);
  options.threads = draw_threads(input);
  Watch watch(input);
  watch.attend(options);
  field.fill(input);
  std::vector<double> values(static_cast<std::size_t>(field.cells()), -9.0);
  const dif_status status = dif_mollify(&field.c(), &options, values.data());
  demand_honest(status);
  watch.check(status);
  double low = 0.0;
  double high = 0.0;
  if (status != DIF_OK || dif_value_extremes(&field.c(), &low, &high) != DIF_OK) {
    return;
  }
  // What lies beyond the sides has a part in the means.
  const bool integer = field.c().type == DIF_UINT8 || field.c().type == DIF_UINT16;
  const double most = integer ? 1.0 : std::max({1.0, std::abs(low), std::abs(high)});
  demand(most > 1e300 || std::ranges::all_of(values, [most](double value) {
           return std::abs(value) <= most * (1.0 + 1e-12);
         }));
}

void call_function(Input& input) {
  const dif_grid grid = draw_grid(input);
  dif_function_options options = draw_function_options(input);
  Watch watch(input);
  watch.attend(options);
  if (input.number(4) == 1) {
    options.gradient = &Body::gradients;
  }
  Body body(input);
  options.gradient_user = &body;
  std::vector<double> fractions = room_for(grid);
  dif_function_report report = prepared(dif_function_report_init);
  const dif_status status =
      dif_fractions_from_function(&grid, &Body::values, &body, &options, &report, fractions.data());
  demand_honest(status);
  // Where the function is not finite at other points too, these may be told of instead.
  demand(status == DIF_ERROR_CANCELLED ? watch.cancelled || body.stopped() : !watch.cancelled);
  demand(status != DIF_OK || !body.stopped());
  demand(status != DIF_OK || std::ranges::all_of(fractions, is_fraction));
  demand(status != DIF_OK || report.function_calls >= report.lattice_calls);
}

void call_shape(Input& input) {
  const dif_shape_options chosen = draw_shape(input);
  dif_shape* made = nullptr;
  const dif_status status = dif_shape_create(&chosen, &made);
  demand_honest(status);
  demand((status == DIF_OK) == (made != nullptr));
  if (made == nullptr) {
    return;
  }
  const std::unique_ptr<dif_shape, ShapeDeleter> shape(made);
  double low[3];
  double high[3];
  double volume = -9.0;
  demand(dif_shape_bounds(made, low, high) == DIF_OK);
  demand(dif_shape_volume(made, &volume) == DIF_OK);
  demand(!(volume < 0.0));
  // The first distance to a genus takes as long as a hundred other calls.
  if (chosen.kind != DIF_SHAPE_GENUS || input.number(32) == 1) {
    check_distances(input, made);
  }
  if (input.number(4) != 1) {
    return;
  }
  const dif_grid grid = draw_grid(input);
  const dif_function_options options = draw_function_options(input);
  std::vector<double> fractions = room_for(grid);
  const dif_status sampled =
      dif_fractions_from_shape(&grid, made, &options, nullptr, fractions.data());
  demand_honest(sampled);
  demand(sampled != DIF_OK || std::ranges::all_of(fractions, is_fraction));
}

}  // namespace difmesh::fuzz
