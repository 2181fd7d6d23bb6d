#pragma once
// Layers of a field that wait for those after them.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

#include "difmesh/array.hpp"
#include "difmesh/field_view.hpp"

namespace difmesh::detail {

/// Consecutive layers in memory of its own, x fastest. Layers are numbered by whoever fills it.
class LayerBuffer {
 public:
  /// Number of the first layer.
  [[nodiscard]] std::int64_t first() const { return first_; }
  [[nodiscard]] FieldView view() const {
    const std::int64_t row = size_[0];
    return {bytes_.data(), type_, {size_[0], size_[1], layers_}, {1, row, row * size_[1]}};
  }

  /// Copies layers [from, from + count) of a slab behind those that are there. \pre all slabs have
  /// the same size in x and y, and type \throw std::bad_alloc
  void append(const FieldView& slab, std::int64_t from, std::int64_t count) {
    size_ = slab.dims;
    type_ = slab.type;
    const double cells = static_cast<double>(layers_ + count) * static_cast<double>(size_[0]) *
                         static_cast<double>(size_[1]);
    if (cells > 0x1p56) {
      throw std::bad_alloc();
    }
    const std::size_t before = bytes_.size();
    bytes_.resize(before + static_cast<std::size_t>(count * layer_bytes()));
    std::byte* to = bytes_.data() + before;
    for (std::int64_t k = from; k < from + count; ++k) {
      for (std::int64_t j = 0; j < size_[1]; ++j) {
        to = copy_row(slab, j, k, to);
      }
    }
    layers_ += count;
  }
  /// Forgets the layers before a number.
  void drop_before(std::int64_t layer) {
    if (layer <= first_) {
      return;
    }
    const auto bytes = static_cast<std::ptrdiff_t>((layer - first_) * layer_bytes());
    bytes_.erase(bytes_.begin(), bytes_.begin() + bytes);
    layers_ -= layer - first_;
    first_ = layer;
  }
  /// Forgets all layers; the next one has this number.
  void restart(std::int64_t layer) {
    bytes_.clear();
    layers_ = 0;
    first_ = layer;
  }

 private:
  [[nodiscard]] std::int64_t layer_bytes() const { return size_[0] * size_[1] * size_of(type_); }

  // Returns where the next row goes.
  std::byte* copy_row(const FieldView& slab, std::int64_t j, std::int64_t k, std::byte* to) const {
    const auto bytes = static_cast<std::size_t>(size_of(type_));
    const auto* const row = static_cast<const std::byte*>(slab.data) +
                            (j * slab.strides[1] + k * slab.strides[2]) * size_of(type_);
    if (slab.strides[0] == 1) {
      std::memcpy(to, row, bytes * static_cast<std::size_t>(size_[0]));
      return to + size_[0] * size_of(type_);
    }
    for (std::int64_t i = 0; i < size_[0]; ++i, to += bytes) {
      std::memcpy(to, row + i * slab.strides[0] * size_of(type_), bytes);
    }
    return to;
  }

  Array<std::byte> bytes_;
  Index3 size_{};
  ScalarType type_ = ScalarType::float64;
  std::int64_t first_ = 0;
  std::int64_t layers_ = 0;
};

}  // namespace difmesh::detail
