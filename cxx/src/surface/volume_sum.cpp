#include "surface/volume_sum.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "surface/phase.hpp"

namespace difmesh::detail {

double VolumeSum::sum(const Mesh& mesh, std::int64_t begin, std::int64_t end, double start) const {
  double sum = start;
  for (std::int64_t n = begin; n < end; ++n) {
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(n)];
    const Vec3& a = mesh.positions[triangle[0]];
    const Vec3& b = mesh.positions[triangle[1]];
    const Vec3& c = mesh.positions[triangle[2]];
    // What lies below the triangle: its height times twice the area of its shadow.
    const double shadow = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    sum += ((a[2] - level_) + (b[2] - level_) + (c[2] - level_)) * shadow;
  }
  return sum;
}

void VolumeSum::add(const Mesh& mesh, Phases& phases) {
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  const std::int64_t first = in_open_ == 0 ? 0 : std::min(count, kPortion - in_open_);
  open_ = sum(mesh, 0, first, open_);
  in_open_ += first;
  if (in_open_ == kPortion) {
    closed_ += open_;
    open_ = 0.0;
    in_open_ = 0;
  }
  std::vector<double> portions(static_cast<std::size_t>((count - first) / kPortion));
  const auto complete = static_cast<std::int64_t>(portions.size()) * kPortion;
  phases.run(kVolume.weight, complete, kPortion, [&](std::int64_t begin, std::int64_t end) {
    portions[static_cast<std::size_t>(begin / kPortion)] =
        sum(mesh, first + begin, first + end, 0.0);
  });
  for (const double portion : portions) {
    closed_ += portion;
  }
  if (first + complete < count) {
    open_ = sum(mesh, first + complete, count, 0.0);
    in_open_ = count - first - complete;
  }
}

}  // namespace difmesh::detail
