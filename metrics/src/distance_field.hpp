#pragma once
// What a surface is measured against.

#include <memory>

#include "difmesh/metrics/distance.hpp"

namespace difmesh::detail {

/// Measures one point after the other; for one thread. Points that follow each other closely in
/// space may be faster; what is measured depends on the point alone.
class DistanceProbe {
 public:
  DistanceProbe() = default;
  DistanceProbe(const DistanceProbe&) = delete;
  DistanceProbe& operator=(const DistanceProbe&) = delete;
  virtual ~DistanceProbe() = default;
  [[nodiscard]] virtual double measure(const Vec3& point) = 0;
};

class DistanceField {
 public:
  DistanceField() = default;
  DistanceField(const DistanceField&) = delete;
  DistanceField& operator=(const DistanceField&) = delete;
  virtual ~DistanceField() = default;
  [[nodiscard]] virtual bool has_sign() const noexcept = 0;
  /// May be called concurrently.
  [[nodiscard]] virtual std::unique_ptr<DistanceProbe> probe() const = 0;
};

}  // namespace difmesh::detail
