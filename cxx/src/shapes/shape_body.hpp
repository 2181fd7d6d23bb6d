#pragma once
// What a shape is behind its interface, and the coordinates in which it is written down.

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/vector3.hpp"
#include "difmesh/shapes.hpp"

namespace difmesh::detail {

[[nodiscard]] inline Vec3 plus(const Vec3& a, double s, const Vec3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

/// Position and attitude: x = centre + axes^T u, where the rows of `axes` are the shape's own axes
/// in space.
class Frame {
 public:
  Frame(const Vec3& centre, const Vec3& rotation_degrees);

  [[nodiscard]] Vec3 to_local(const Vec3& x) const {
    const Vec3 d{x[0] - centre_[0], x[1] - centre_[1], x[2] - centre_[2]};
    return turned_ ? Vec3{dot(axes_[0], d), dot(axes_[1], d), dot(axes_[2], d)} : d;
  }
  [[nodiscard]] Vec3 direction_to_space(const Vec3& u) const {
    return turned_ ? plus(plus(plus({}, u[0], axes_[0]), u[1], axes_[1]), u[2], axes_[2]) : u;
  }
  /// Component `axis` of space of the shape's own axes.
  [[nodiscard]] Vec3 space_axis(std::size_t axis) const {
    return {axes_[0][axis], axes_[1][axis], axes_[2][axis]};
  }
  [[nodiscard]] Vec3 to_space(const Vec3& u) const {
    return plus(centre_, 1.0, direction_to_space(u));
  }
  [[nodiscard]] const Vec3& centre() const { return centre_; }

 private:
  Vec3 centre_;
  bool turned_ = false;
  std::array<Vec3, 3> axes_;
};

class ShapeBody {
 public:
  ShapeBody() = default;
  ShapeBody(const ShapeBody&) = delete;
  ShapeBody& operator=(const ShapeBody&) = delete;
  virtual ~ShapeBody() = default;
  virtual void values(std::span<const Vec3> points, std::span<double> out) const = 0;
  virtual void gradients(std::span<const Vec3> points, std::span<Vec3> out) const = 0;
  virtual void distances(std::span<const Vec3> points, std::span<double> out) const = 0;
  [[nodiscard]] virtual Bounds bounds() const = 0;
  [[nodiscard]] virtual std::optional<double> volume() const = 0;
  /// Whether known_fraction() ever knows one.
  [[nodiscard]] virtual bool knows_fractions() const = 0;
  /// The fraction of a cell in which quadrature would be slow, where there is another way.
  [[nodiscard]] virtual std::optional<double> known_fraction(const Vec3& low,
                                                             const Vec3& size) const = 0;
};

/// A body from a model in its own coordinates, which offers value(u), gradient(u), distance(u),
/// volume() and extent(d): how far the shape reaches along the unit vectors d and -d, from its
/// centre; and perhaps known_fraction(frame, low, size), for cells in space.
template <class Model>
class ModelBody final : public ShapeBody {
 public:
  template <class... Args>
  explicit ModelBody(const Frame& frame, Args&&... args)
      : frame_(frame), model_(std::forward<Args>(args)...) {}

  void values(std::span<const Vec3> points, std::span<double> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = model_.value(frame_.to_local(points[i]));
    }
  }
  void gradients(std::span<const Vec3> points, std::span<Vec3> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = frame_.direction_to_space(model_.gradient(frame_.to_local(points[i])));
    }
  }
  void distances(std::span<const Vec3> points, std::span<double> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out[i] = model_.distance(frame_.to_local(points[i]));
    }
  }
  [[nodiscard]] Bounds bounds() const override {
    Bounds result;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [down, up] = model_.extent(frame_.space_axis(a));
      result.low[a] = frame_.centre()[a] - down;
      result.high[a] = frame_.centre()[a] + up;
    }
    return result;
  }
  [[nodiscard]] std::optional<double> volume() const override { return model_.volume(); }
  [[nodiscard]] bool knows_fractions() const override { return kKnowsFractions; }
  [[nodiscard]] std::optional<double> known_fraction(const Vec3& low,
                                                     const Vec3& size) const override {
    if constexpr (kKnowsFractions) {
      return model_.known_fraction(frame_, low, size);
    } else {
      return std::nullopt;
    }
  }

 private:
  static constexpr bool kKnowsFractions = requires(const Model& model, const Frame& frame) {
    model.known_fraction(frame, Vec3{}, Vec3{});
  };

  Frame frame_;
  Model model_;
};

/// How far a shape reaches from its centre: along -d and along d.
using Extent = std::pair<double, double>;

}  // namespace difmesh::detail
