#pragma once
/// \file shapes.hpp
/// Built-in test shapes: implicit functions with gradient, extent, volume and exact distance.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "difmesh/fractions_from_function.hpp"
#include "difmesh/grid.hpp"

namespace difmesh {

namespace detail {
class ShapeBody;
}

/// In a shape's own coordinates (u,v,w): its centre at 0, before it is turned.
enum class ShapeKind : std::uint8_t {
  sphere,     ///< radius
  ellipsoid,  ///< semi_axes
  torus,      ///< radius of the centre line, in the plane w = 0, and tube_radius
  /// 2v(v^2 - 3u^2)(1 - w^2) + (u^2 + v^2)^2 = (9w^2 - 1)(1 - w^2), of genus 2 (Evrard et al., IEEE
  /// TVCG 2019, eq. 15), times scale.
  genus,
  smooth_box,  ///< superellipsoid |u/a|^p + |v/b|^p + |w/c|^p = 1: semi_axes, exponent p
  golf_ball,   ///< ball of the radius less equal balls, whose rims are circles: dimple_*
};

struct ShapeOptions {
  ShapeKind kind = ShapeKind::sphere;
  Vec3 centre{0.0, 0.0, 0.0};
  /// Turned about the x axis, then the y axis, then the z axis, right-handed, all of them fixed
  /// axes through the centre.
  Vec3 rotation_degrees{0.0, 0.0, 0.0};
  double radius = 1.0;            ///< sphere, torus, golf ball; > 0
  double tube_radius = 0.4;       ///< torus; > 0 and < radius
  Vec3 semi_axes{1.0, 0.8, 0.6};  ///< ellipsoid, smooth box; each > 0
  double exponent = 8.0;          ///< smooth box; [2, 64]. Even integers make it analytic
  double scale = 1.0;             ///< genus; > 0
  /// Golf ball; [1, 5000]. Dimple i of n has its axis at w = 1 - (2i+1)/n, at the angle
  /// i pi (3 - sqrt 5) about the w axis (Fibonacci lattice).
  std::int64_t dimples = 333;
  double dimple_radius = 0.08;  ///< of the rims, over `radius`; (0, 0.5]; dimples must not meet
  /// Of a dimple's bottom below the sphere, over `radius`; more than 1 - sqrt(1 - dimple_radius^2),
  /// which is how deep the rim's plane lies, and at most that plus dimple_radius.
  double dimple_depth = 0.012;
};

/// A box with faces parallel to the axes.
struct Bounds {
  Vec3 low{0.0, 0.0, 0.0};
  Vec3 high{0.0, 0.0, 0.0};
};

/// A shape that cannot be changed. Copying is cheap. All functions may be called concurrently.
class Shape {
 public:
  [[nodiscard]] const ShapeOptions& options() const noexcept { return options_; }

  /// f(points[i]) to values[i], < 0 inside. f is smooth near the surface, but for the golf ball's
  /// rims, and finite everywhere. Its gradient is about 1 on the surface, but for the genus, where
  /// f is the polynomial of the paper, made positive beyond |w| = scale. It is no distance, except
  /// within the golf ball.
  /// \throw Error invalid_argument if the sizes differ; so for the other batches
  void values(std::span<const Vec3> points, std::span<double> values) const;
  /// Gradients of f; at its kinks (rims, centre of the smooth box) those of one side, or 0.
  void gradients(std::span<const Vec3> points, std::span<Vec3> gradients) const;
  /// Signed distances to the surface, < 0 inside, to about 1e-12 times the size of the shape. In
  /// closed form for sphere, torus and golf ball, by a safeguarded Newton solve for the ellipsoid,
  /// and by minimising from all parts of the surface that may be nearest for the others, which take
  /// some µs per point (and the genus some ms on first use).
  void distances(std::span<const Vec3> points, std::span<double> distances) const;
  [[nodiscard]] double value(const Vec3& point) const;
  [[nodiscard]] Vec3 gradient(const Vec3& point) const;
  [[nodiscard]] double distance(const Vec3& point) const;

  /// Encloses the shape; touches it on all sides but for a turned genus and the golf ball.
  [[nodiscard]] Bounds bounds() const;
  /// In closed form; the genus to 1e-14.
  [[nodiscard]] std::optional<double> volume() const;

  /// For fractions_from_function(); they share the shape and outlive it if need be.
  [[nodiscard]] FunctionBatch function() const;
  [[nodiscard]] GradientBatch gradient_function() const;

 private:
  friend Shape make_shape(const ShapeOptions& options);
  friend FractionsFromFunction fractions_from_shape(const Grid&, const Shape&,
                                                    const FractionsFromFunctionOptions&);
  Shape(const ShapeOptions& options, std::shared_ptr<const detail::ShapeBody> body);

  ShapeOptions options_;
  std::shared_ptr<const detail::ShapeBody> body_;
};

/// Makes a shape; only the options of its kind are looked at.
/// \throw Error invalid_argument naming the option that is out of its range
[[nodiscard]] Shape make_shape(const ShapeOptions& options);

/// Volume fractions of a shape: as fractions_from_function() of its function(), but cells that the
/// rims of a golf ball cross take 0.1 ms each, no evaluations, and are right to about 1e-11 instead
/// of kink_tolerance.
/// \throw Error as fractions_from_function()
[[nodiscard]] FractionsFromFunction fractions_from_shape(
    const Grid& grid, const Shape& shape, const FractionsFromFunctionOptions& options = {});

/// All names, in the order of ShapeKind: "sphere", "ellipsoid", "torus", "genus", "smooth_box",
/// "golf_ball".
[[nodiscard]] std::span<const std::string_view> shape_names() noexcept;
[[nodiscard]] std::string_view shape_name(ShapeKind kind) noexcept;
/// \throw Error invalid_argument listing the names if there is no such shape; '-' is read as '_'
[[nodiscard]] ShapeKind shape_kind(std::string_view name);

}  // namespace difmesh
