#pragma once
/// \file fields.hpp
/// Fields in memory for tests, and comparisons of meshes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "difmesh/field_view.hpp"
#include "difmesh/mesh.hpp"

namespace difmesh::test {

/// A field that owns its values, x fastest.
struct OwnedField {
  Index3 dims{0, 0, 0};
  std::vector<double> values;

  explicit OwnedField(const Index3& size, double value = 0.0)
      : dims(size), values(static_cast<std::size_t>(size[0] * size[1] * size[2]), value) {}

  [[nodiscard]] double& at(std::int64_t i, std::int64_t j, std::int64_t k) {
    return values[static_cast<std::size_t>((k * dims[1] + j) * dims[0] + i)];
  }
  [[nodiscard]] double at_cell(const Index3& cell) const {
    return values[static_cast<std::size_t>((cell[2] * dims[1] + cell[1]) * dims[0] + cell[0])];
  }
  [[nodiscard]] FieldView view() const { return FieldView::x_fastest(values.data(), dims); }
};

/// The cells of a view of float64.
inline OwnedField copy_of(const FieldView& view) {
  OwnedField field(view.dims);
  const auto* const cells = static_cast<const double*>(view.data);
  for (std::int64_t k = 0; k < view.dims[2]; ++k) {
    for (std::int64_t j = 0; j < view.dims[1]; ++j) {
      for (std::int64_t i = 0; i < view.dims[0]; ++i) {
        field.at(i, j, k) = cells[i * view.strides[0] + j * view.strides[1] + k * view.strides[2]];
      }
    }
  }
  return field;
}

/// Independent values, even over [0,1].
inline OwnedField white_noise(const Index3& dims, std::uint64_t seed) {
  OwnedField field(dims);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  for (double& value : field.values) {
    value = even(random);
  }
  return field;
}

/// Independent values out of {0, 1/2, 1}.
inline OwnedField half_noise(const Index3& dims, std::uint64_t seed) {
  OwnedField field(dims);
  std::mt19937_64 random(seed);
  for (double& value : field.values) {
    value = 0.5 * static_cast<double>(random() % 3);
  }
  return field;
}

/// A smooth closed blob without symmetries, diffuse over one or two cells as solvers leave it.
inline OwnedField blob(const Index3& dims) {
  OwnedField field(dims);
  for (std::int64_t k = 0; k < dims[2]; ++k) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t i = 0; i < dims[0]; ++i) {
        const auto place = [](std::int64_t index, std::int64_t dim, double centre) {
          return (static_cast<double>(index) + 0.5) / static_cast<double>(dim) - centre;
        };
        const double x = place(i, dims[0], 0.47);
        const double y = place(j, dims[1], 0.52);
        const double z = place(k, dims[2], 0.49);
        const double r = std::sqrt(x * x + 1.3 * y * y + 1.7 * z * z + 0.6 * x * y - 0.3 * y * z);
        const double steepness = 0.9 * static_cast<double>(dims[0]);
        field.at(i, j, k) = std::clamp(0.5 + steepness * (0.33 + 0.05 * x - r), 0.0, 1.0);
      }
    }
  }
  return field;
}

template <class T>
[[nodiscard]] bool same_bytes(const Array<T>& a, const Array<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Equal to the last bit, in all arrays.
[[nodiscard]] inline bool same_bits(const Mesh& a, const Mesh& b) {
  return same_bytes(a.positions, b.positions) && same_bytes(a.triangles, b.triangles) &&
         same_bytes(a.normals, b.normals) && same_bytes(a.edge_ids, b.edge_ids);
}

}  // namespace difmesh::test
