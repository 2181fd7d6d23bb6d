#pragma once
/// \file field_view.hpp
/// A non-owning view of a field of fractions in memory, in any layout.

#include <array>
#include <cstdint>

#include "difmesh/grid.hpp"

namespace difmesh {

/// Element types of a field. Integers stand for value / (largest value): 0..255 or 0..65535 become
/// 0..1.
enum class ScalarType : std::uint8_t { float32, float64, uint8, uint16 };

/// Bytes of one element.
[[nodiscard]] constexpr std::int64_t size_of(ScalarType type) noexcept {
  constexpr std::array<std::int64_t, 4> bytes{4, 8, 1, 2};
  return bytes[static_cast<std::size_t>(type)];
}

/// Maps a C++ element type to its ScalarType; defined for the four supported types only.
template <class T>
struct ScalarTypeOf;
template <>
struct ScalarTypeOf<float> {
  static constexpr ScalarType value = ScalarType::float32;
};
template <>
struct ScalarTypeOf<double> {
  static constexpr ScalarType value = ScalarType::float64;
};
template <>
struct ScalarTypeOf<std::uint8_t> {
  static constexpr ScalarType value = ScalarType::uint8;
};
template <>
struct ScalarTypeOf<std::uint16_t> {
  static constexpr ScalarType value = ScalarType::uint16;
};

/// A view of fractions: cell (i,j,k) is the element at data + i strides[0] + j strides[1] +
/// k strides[2], counted in elements; strides may be negative or zero. Does not own the memory,
/// which must stay valid and unchanged while the view is in use. Copying is cheap; concurrent reads
/// are safe.
struct FieldView {
  const void* data = nullptr;  ///< element of cell (0,0,0), aligned for its type
  ScalarType type = ScalarType::float64;
  Index3 dims{0, 0, 0};     ///< cells in x, y, z
  Index3 strides{0, 0, 0};  ///< elements from one cell to the next in x, y, z

  FieldView() = default;
  FieldView(const void* cells, ScalarType scalar_type, const Index3& size, const Index3& steps)
      : data(cells), type(scalar_type), dims(size), strides(steps) {}

  /// x fastest: the layout of a C array [nz][ny][nx], of VTK and of OpenFOAM.
  template <class T>
  [[nodiscard]] static FieldView x_fastest(const T* cells, const Index3& dims) {
    return {cells, ScalarTypeOf<T>::value, dims, {1, dims[0], dims[0] * dims[1]}};
  }
  /// z fastest: the layout of a C array [nx][ny][nz].
  template <class T>
  [[nodiscard]] static FieldView z_fastest(const T* cells, const Index3& dims) {
    return {cells, ScalarTypeOf<T>::value, dims, {dims[1] * dims[2], dims[2], 1}};
  }
  /// The cells [low, low + size) of this view.
  [[nodiscard]] FieldView sub(const Index3& low, const Index3& size) const;
};

}  // namespace difmesh
