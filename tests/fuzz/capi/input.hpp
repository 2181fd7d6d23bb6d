#pragma once
// Draws numbers, choices and fractions from the bytes of an input.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace difmesh::fuzz {

/// Ends the program where a promise of the library is broken.
inline void demand(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// Hands out bytes from first to last, and zeros after them.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  std::int64_t number(std::int64_t below) { return byte() % below; }
  /// Whether something rare happens; never in the zeros.
  bool rarely() { return byte() > 250; }
  /// An enumerator of 0 to `last`, and rarely one that does not exist.
  std::int32_t choice(std::int32_t last) {
    const std::uint8_t value = byte();
    if (value > 250) {
      return value == 255 ? -1 : last + value - 250;
    }
    return value % (last + 1);
  }
  std::uint64_t word() {
    std::uint64_t bits = 0;
    for (int n = 0; n < 8; ++n) {
      bits = bits << 8 | byte();
    }
    return bits;
  }
  double any() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array edges{std::numeric_limits<double>::quiet_NaN(), infinity, -infinity,
                               std::numeric_limits<double>::max(),
                               std::numeric_limits<double>::denorm_min()};
    const std::uint8_t kind = byte();
    if (kind < 10 * edges.size()) {
      return edges[kind % edges.size()];
    }
    const std::uint64_t bits = word();
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof number);
    return number;
  }
  /// Mostly what is expected, now and then any number.
  double number_or_any(double usual) { return byte() < 200 ? usual : any(); }
  /// Values that solvers hold, and some that they should not.
  double fraction() {
    constexpr std::array special{0.0,    1.0,  0.5,        0.5 + 1e-16, 1e-30, -1e-9,
                                 1e-6,   1e-7, 1 - 1e-7,   1 + 1e-8,    0.25,  0.75,
                                 -0.099, 1.09, 0.49999999, 1e-300};
    const std::uint8_t value = byte();
    return value < special.size() ? special[value] : (value - 16) / 239.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace difmesh::fuzz
