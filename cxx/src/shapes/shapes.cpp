#include "difmesh/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/position_text.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "sampling/known_cells.hpp"
#include "shapes/genus_shape.hpp"
#include "shapes/golf_ball.hpp"
#include "shapes/round_shapes.hpp"
#include "shapes/shape_body.hpp"
#include "shapes/smooth_box.hpp"

namespace difmesh {

namespace detail {
namespace {

// Exact at multiples of 90 degrees.
std::pair<double, double> sine_and_cosine(double degrees) {
  const double quarters = std::round(degrees / 90.0);
  const double rest = (degrees - 90.0 * quarters) * (std::numbers::pi / 180.0);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch ((static_cast<int>(std::fmod(quarters, 4.0)) + 4) % 4) {
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    case 3:
      return {-c, s};
    default:
      return {s, c};
  }
}

}  // namespace

Frame::Frame(const Vec3& centre, const Vec3& rotation_degrees) : centre_(centre) {
  for (std::size_t own = 0; own < 3; ++own) {
    Vec3 axis{};
    axis[own] = 1.0;
    for (std::size_t about = 0; about < 3; ++about) {
      const auto [s, c] = sine_and_cosine(rotation_degrees[about]);
      const std::size_t j = (about + 1) % 3;
      const std::size_t k = (about + 2) % 3;
      const double from_j = axis[j];
      const double from_k = axis[k];
      axis[j] = c * from_j - s * from_k;
      axis[k] = s * from_j + c * from_k;
      turned_ = turned_ || c != 1.0;
    }
    axes_[own] = axis;
  }
}

}  // namespace detail

namespace {

constexpr std::array<std::string_view, 6> kNames{"sphere", "ellipsoid",  "torus",
                                                 "genus",  "smooth_box", "golf_ball"};

void check_finite(const char* name, const Vec3& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) {
      throw Error(ErrorCode::invalid_argument, std::string("shape: ") + name + " is not finite");
    }
  }
}

// A length of the shape: neither so small nor so large that squares of it could not be told from 0
// or infinity.
void check_length(const char* name, double value) {
  constexpr double kLeast = 1e-100;
  constexpr double kMost = 1e100;
  if (!(value >= kLeast && value <= kMost)) {
    throw Error(ErrorCode::invalid_argument, std::string("shape: ") + name + " is " +
                                                 detail::rounded_text(value) +
                                                 "; it must be finite and greater than 0");
  }
}

void check_semi_axes(const Vec3& semi_axes) {
  for (const double axis : semi_axes) {
    check_length("each of semi_axes", axis);
  }
}

std::shared_ptr<const detail::ShapeBody> make_body(const ShapeOptions& options) {
  const detail::Frame frame(options.centre, options.rotation_degrees);
  switch (options.kind) {
    case ShapeKind::sphere:
      check_length("radius", options.radius);
      return std::make_shared<detail::ModelBody<detail::SphereModel>>(frame, options.radius);
    case ShapeKind::ellipsoid:
      check_semi_axes(options.semi_axes);
      return std::make_shared<detail::ModelBody<detail::EllipsoidModel>>(frame, options.semi_axes);
    case ShapeKind::torus:
      check_length("radius", options.radius);
      check_length("tube_radius", options.tube_radius);
      if (options.tube_radius >= options.radius) {
        throw Error(ErrorCode::invalid_argument,
                    "shape: tube_radius is " + detail::rounded_text(options.tube_radius) +
                        "; it must be less than the radius of the ring, " +
                        detail::rounded_text(options.radius));
      }
      return std::make_shared<detail::ModelBody<detail::TorusModel>>(frame, options.radius,
                                                                     options.tube_radius);
    case ShapeKind::genus:
      check_length("scale", options.scale);
      return std::make_shared<detail::ModelBody<detail::GenusModel>>(frame, options.scale);
    case ShapeKind::smooth_box:
      check_semi_axes(options.semi_axes);
      if (!(options.exponent >= 2.0 && options.exponent <= 64.0)) {
        throw Error(ErrorCode::invalid_argument, "shape: exponent is " +
                                                     detail::rounded_text(options.exponent) +
                                                     "; 2 to 64 are possible");
      }
      return std::make_shared<detail::ModelBody<detail::SmoothBoxModel>>(frame, options.semi_axes,
                                                                         options.exponent);
    case ShapeKind::golf_ball:
      check_length("radius", options.radius);
      return std::make_shared<detail::ModelBody<detail::GolfBallModel>>(frame, options);
  }
  throw Error(ErrorCode::invalid_argument, "shape: kind is none of the enumeration's values");
}

template <class T>
void check_sizes(std::span<const Vec3> points, std::span<T> out) {
  if (points.size() != out.size()) {
    throw Error(ErrorCode::invalid_argument, "shape: " + std::to_string(points.size()) +
                                                 " points, but room for " +
                                                 std::to_string(out.size()) + " results");
  }
}

}  // namespace

Shape::Shape(const ShapeOptions& options, std::shared_ptr<const detail::ShapeBody> body)
    : options_(options), body_(std::move(body)) {}

void Shape::values(std::span<const Vec3> points, std::span<double> values) const {
  const DefaultFloatEnvironment environment;
  check_sizes(points, values);
  body_->values(points, values);
}

void Shape::gradients(std::span<const Vec3> points, std::span<Vec3> gradients) const {
  const DefaultFloatEnvironment environment;
  check_sizes(points, gradients);
  body_->gradients(points, gradients);
}

void Shape::distances(std::span<const Vec3> points, std::span<double> distances) const {
  const DefaultFloatEnvironment environment;
  check_sizes(points, distances);
  body_->distances(points, distances);
}

double Shape::value(const Vec3& point) const {
  double result = 0.0;
  body_->values({&point, 1}, {&result, 1});
  return result;
}

Vec3 Shape::gradient(const Vec3& point) const {
  Vec3 result{};
  body_->gradients({&point, 1}, {&result, 1});
  return result;
}

double Shape::distance(const Vec3& point) const {
  double result = 0.0;
  body_->distances({&point, 1}, {&result, 1});
  return result;
}

Bounds Shape::bounds() const {
  const DefaultFloatEnvironment environment;
  return body_->bounds();
}

std::optional<double> Shape::volume() const {
  const DefaultFloatEnvironment environment;
  return body_->volume();
}

FunctionBatch Shape::function() const {
  return [body = body_](std::span<const Vec3> points, std::span<double> values) {
    body->values(points, values);
  };
}

GradientBatch Shape::gradient_function() const {
  return [body = body_](std::span<const Vec3> points, std::span<Vec3> gradients) {
    body->gradients(points, gradients);
  };
}

Shape make_shape(const ShapeOptions& options) {
  const DefaultFloatEnvironment environment;
  check_finite("centre", options.centre);
  check_finite("rotation_degrees", options.rotation_degrees);
  return {options, make_body(options)};
}

FractionsFromFunction fractions_from_shape(const Grid& grid, const Shape& shape,
                                           const FractionsFromFunctionOptions& options) {
  const DefaultFloatEnvironment environment;
  detail::KnownFraction known;
  if (shape.body_->knows_fractions()) {
    known = [&body = *shape.body_](const Vec3& low, const Vec3& size) {
      return body.known_fraction(low, size);
    };
  }
  return detail::fractions_with_known_cells(grid, shape.function(), options, known);
}

std::span<const std::string_view> shape_names() noexcept {
  return kNames;
}

std::string_view shape_name(ShapeKind kind) noexcept {
  return kNames[std::min(static_cast<std::size_t>(kind), kNames.size() - 1)];
}

ShapeKind shape_kind(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '-', '_');
  std::string list;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (wanted == kNames[i]) {
      return static_cast<ShapeKind>(i);
    }
    list += (i == 0 ? "" : ", ") + std::string(kNames[i]);
  }
  throw Error(ErrorCode::invalid_argument,
              "there is no shape '" + std::string(name) + "'; there are " + list);
}

}  // namespace difmesh
