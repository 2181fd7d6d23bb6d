#pragma once
// The user's function, with its calls counted and its values checked.

#include <cstdint>
#include <span>

#include "difmesh/fractions_from_function.hpp"

namespace difmesh::detail {

/// One per task: not shared between threads.
class SampledFunction {
 public:
  SampledFunction(const FunctionBatch& value, const GradientBatch& gradient, const Grid& grid)
      : value_(value), gradient_(gradient), grid_(grid) {}

  /// \throw Error invalid_value where a value is NaN or infinite, with the point and its cell
  void values(std::span<const Vec3> points, std::span<double> out);
  void gradients(std::span<const Vec3> points, std::span<Vec3> out);

  [[nodiscard]] bool has_gradient() const { return static_cast<bool>(gradient_); }
  [[nodiscard]] std::int64_t calls() const { return calls_; }
  [[nodiscard]] std::int64_t gradient_calls() const { return gradient_calls_; }

 private:
  [[noreturn]] void fail(const char* what, const Vec3& point, double value) const;

  const FunctionBatch& value_;
  const GradientBatch& gradient_;
  const Grid& grid_;
  std::int64_t calls_ = 0;
  std::int64_t gradient_calls_ = 0;
};

}  // namespace difmesh::detail
