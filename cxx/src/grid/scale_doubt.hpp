#pragma once
// Whether integers are hardly shares of the largest one: a mask, a segmentation, or another scale.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "difmesh/values.hpp"

namespace difmesh::detail {

/// Looks at values of an integer type T, a field or slabs of one in their order, until they cannot
/// be what doubt_of_scale() warns of.
template <class T>
class ScaleDoubt {
 public:
  void add(const ValueView& values) {
    const T* const cells = static_cast<const T*>(values.data);
    for (std::int64_t k = 0; k < values.dims[2] && !refuted_; ++k) {
      for (std::int64_t j = 0; j < values.dims[1] && !refuted_; ++j) {
        refuted_ = is_refuted_by_row(cells + j * values.strides[1] + k * values.strides[2],
                                     values.dims[0], values.strides[0]);
      }
    }
  }

  /// Empty where there is no doubt.
  [[nodiscard]] std::string sentence(ValueType type, std::string_view remedy) const {
    if (refuted_ || !(highest_ > T{0})) {
      return {};
    }
    return "the highest value is " + std::to_string(highest_) + ", and " + std::to_string(kFull) +
           " of " + name_of(type) + " counts as full unless " + std::string(remedy) + " are given";
  }

 private:
  static constexpr T kFull = std::numeric_limits<T>::max();
  static constexpr std::size_t kFew = 16;
  static constexpr std::int64_t kRun = 64;

  [[nodiscard]] bool is_refuted_by_row(const T* row, std::int64_t count, std::int64_t stride) {
    std::int64_t i = 0;
    while (i < count) {
      if (stride == 1 && i + kRun <= count && is_known_run(row + i)) {
        i += kRun;
        continue;
      }
      for (const std::int64_t end = std::min(i + kRun, count); i < end; ++i) {
        if (is_refuted_by(row[i * stride])) {
          return true;
        }
      }
    }
    return false;
  }
  // Whether all are what the last one was: most of a mask. The compiler compares in vectors.
  [[nodiscard]] bool is_known_run(const T* run) const {
    bool same = found_ > 0;
    for (std::int64_t i = 0; i < kRun; ++i) {
      same &= run[i] == last_;
    }
    return same;
  }
  [[nodiscard]] bool is_refuted_by(T value) {
    last_ = value;
    highest_ = found_ == 0 ? value : std::max(highest_, value);
    const auto end = few_.begin() + static_cast<std::ptrdiff_t>(std::min(found_, kFew));
    if (found_ <= kFew && std::find(few_.begin(), end, value) == end) {
      if (found_ < kFew) {
        few_[found_] = value;
      }
      ++found_;
    }
    return highest_ == kFull || (found_ > kFew && highest_ > kFull / 2);
  }

  std::array<T, kFew> few_{};  // the first different ones
  std::size_t found_ = 0;      // how many there are, up to kFew + 1
  T last_{};
  T highest_{};
  bool refuted_ = false;
};

}  // namespace difmesh::detail
