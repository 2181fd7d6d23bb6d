#pragma once
// One bit per node of the dual grid of a block, and the crossed dual edges that follow from them.
//
// Local node indices run from 0 to dims + 1 on each axis; local index = global cell index - offset
// + 1. Index 0 is the node before the block: it exists where the block begins at a side of the
// domain that is not periodic. Index dims + 1 always exists: the node beyond or on the domain face,
// or the first cell after the block, or the periodic image of cell 0.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/memory_hints.hpp"
#include "difmesh/array.hpp"
#include "difmesh/grid.hpp"

namespace difmesh::detail {

/// Number of set bits, without the call that std::popcount is on the baseline instruction set.
[[nodiscard]] inline int count_bits(std::uint64_t word) {
#ifdef __POPCNT__
  return std::popcount(word);
#else
  word -= (word >> 1) & 0x5555555555555555u;
  word = (word & 0x3333333333333333u) + ((word >> 2) & 0x3333333333333333u);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<int>((word * 0x0101010101010101u) >> 56);
#endif
}

/// Of so many words, most of which are zero.
[[nodiscard]] inline std::int64_t count_bits(const std::uint64_t* words, std::int64_t count) {
  std::int64_t bits = 0;
  for (std::int64_t w = 0; w < count; ++w) {
    bits += words[w] != 0 ? count_bits(words[w]) : 0;
  }
  return bits;
}

/// Bits [0, bit) of a word; bit in 0..63.
[[nodiscard]] constexpr std::uint64_t below(int bit) {
  return (std::uint64_t{1} << bit) - 1;
}

/// Rows of bits along x over a box of nodes. In a complete row the bits of nodes that do not exist
/// are zero.
class NodeBits {
 public:
  NodeBits() = default;
  /// The bits hold anything: each row is to be cleared or written.
  /// \param first lowest existing local index on each axis, 0 or 1; \param last the highest
  NodeBits(const Index3& first, const Index3& last)
      : first_(first), last_(last), words_((last[0] + 64) / 64) {
    bits_.resize(static_cast<std::size_t>(words_ * rows()));
    kinds_.assign(static_cast<std::size_t>(rows()), Kind::mixed);
    hint_large_pages(bits_);
  }

  [[nodiscard]] const Index3& first() const { return first_; }
  [[nodiscard]] const Index3& last() const { return last_; }
  [[nodiscard]] std::int64_t words() const { return words_; }
  [[nodiscard]] std::int64_t rows() const { return (last_[1] + 1) * (last_[2] + 1); }
  [[nodiscard]] std::int64_t row_index(std::int64_t j, std::int64_t k) const {
    return k * (last_[1] + 1) + j;
  }
  [[nodiscard]] std::uint64_t* row(std::int64_t j, std::int64_t k) {
    return bits_.data() + row_index(j, k) * words_;
  }
  [[nodiscard]] const std::uint64_t* row(std::int64_t j, std::int64_t k) const {
    return bits_.data() + row_index(j, k) * words_;
  }
  void clear_row(std::int64_t j, std::int64_t k) { std::fill_n(row(j, k), words_, 0); }
  [[nodiscard]] bool test(const Index3& node) const {
    return (row(node[1], node[2])[node[0] / 64] >> (node[0] % 64) & 1) != 0;
  }
  void set(const Index3& node, bool value) {
    const std::uint64_t bit = std::uint64_t{1} << (node[0] % 64);
    std::uint64_t& word = row(node[1], node[2])[node[0] / 64];
    word = value ? word | bit : word & ~bit;
    kinds_[static_cast<std::size_t>(row_index(node[1], node[2]))] = Kind::mixed;
  }

  /// Looks whether all nodes of a row are alike, which passes over the rows may ask from then on.
  /// Thread safety: for different rows.
  void summarise_row(std::int64_t j, std::int64_t k) {
    const std::uint64_t* const words = row(j, k);
    std::uint64_t none = 0;
    std::uint64_t all = 0;
    for (std::int64_t w = 1; w + 1 < words_; ++w) {
      none |= words[w];
      all |= ~words[w];
    }
    for (const std::int64_t w : {std::int64_t{0}, words_ - 1}) {
      none |= words[w];
      all |= words[w] ^ range(w, first_[0], last_[0]);
    }
    kinds_[static_cast<std::size_t>(row_index(j, k))] =
        none == 0 ? Kind::outside : (all == 0 ? Kind::inside : Kind::mixed);
  }
  /// True if two rows are known to hold the same nodes, all alike.
  [[nodiscard]] bool are_alike(std::int64_t row, std::int64_t other) const {
    const Kind kind = kinds_[static_cast<std::size_t>(row)];
    return kind != Kind::mixed && kind == kinds_[static_cast<std::size_t>(other)];
  }
  /// The same of a row and its four neighbours. \pre they exist
  [[nodiscard]] bool are_alike_around(std::int64_t row) const {
    const std::int64_t slab = last_[1] + 1;
    const Kind* const kind = kinds_.data() + row;
    return *kind != Kind::mixed && *kind == kind[-1] && *kind == kind[1] && *kind == kind[-slab] &&
           *kind == kind[slab];
  }
  /// Crossed dual edges along x that start at the nodes of word w of a row.
  [[nodiscard, gnu::always_inline]] std::uint64_t crossed_x(const std::uint64_t* row,
                                                            std::int64_t w) const {
    const bool is_last = w + 1 == words_;
    std::uint64_t crossed = row[w] ^ (row[w] >> 1 | (is_last ? 0 : row[w + 1] << 63));
    if (w == 0) {
      crossed &= ~std::uint64_t{0} << first_[0];
    }
    return is_last ? crossed & below(static_cast<int>(last_[0] % 64)) : crossed;
  }
  /// Bits of word w whose local index is in [from, to].
  [[nodiscard]] static std::uint64_t range(std::int64_t w, std::int64_t from, std::int64_t to) {
    const std::int64_t low = from - 64 * w;
    const std::int64_t high = to - 64 * w;
    if (low > 63 || high < 0) {
      return 0;
    }
    const std::uint64_t up = high >= 63 ? ~std::uint64_t{0} : below(static_cast<int>(high) + 1);
    return low <= 0 ? up : up & ~below(static_cast<int>(low));
  }

 private:
  enum class Kind : std::uint8_t { outside, inside, mixed };

  Index3 first_{0, 0, 0};
  Index3 last_{-1, -1, -1};
  std::int64_t words_ = 0;
  Array<std::uint64_t> bits_;
  std::vector<Kind> kinds_;  // by row
};

/// Rows that a thread takes at once: few enough for many threads, and enough to be worth it where
/// most rows are bare.
[[nodiscard]] inline std::int64_t rows_per_portion(const NodeBits& nodes) {
  return std::clamp<std::int64_t>(nodes.rows() / 512, 16, 4096);
}

/// True if no edge that starts in a row is crossed, as far as that is known without a look at its
/// bits.
[[nodiscard]] inline bool is_bare(const NodeBits& nodes, std::int64_t j, std::int64_t k) {
  const std::int64_t row = nodes.row_index(j, k);
  return nodes.are_alike(row, row) &&
         (j == nodes.last()[1] || nodes.are_alike(row, nodes.row_index(j + 1, k))) &&
         (k == nodes.last()[2] || nodes.are_alike(row, nodes.row_index(j, k + 1)));
}

/// Crossed dual edges that start at the nodes of one word, by axis.
struct EdgeWord {
  std::uint64_t x = 0;
  std::uint64_t y = 0;
  std::uint64_t z = 0;

  [[nodiscard]] std::uint64_t any() const { return x | y | z; }
  [[nodiscard]] int count() const { return count_bits(x) + count_bits(y) + count_bits(z); }
};

/// Calls visit(bit, axis) for the crossed edges of a word in the order of their ids.
template <class Visit>
void for_each_edge(const EdgeWord& word, const Visit& visit) {
  for (std::uint64_t left = word.any(); left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    if ((word.x >> bit & 1) != 0) {
      visit(bit, 0);
    }
    if ((word.y >> bit & 1) != 0) {
      visit(bit, 1);
    }
    if ((word.z >> bit & 1) != 0) {
      visit(bit, 2);
    }
  }
}

/// The crossed dual edges that start at the nodes of one row.
class EdgeRow {
 public:
  EdgeRow(const NodeBits& nodes, std::int64_t j, std::int64_t k)
      : nodes_(&nodes),
        here_(nodes.row(j, k)),
        next_j_(j < nodes.last()[1] ? nodes.row(j + 1, k) : here_),
        next_k_(k < nodes.last()[2] ? nodes.row(j, k + 1) : here_) {}

  [[nodiscard, gnu::always_inline]] EdgeWord word(std::int64_t w) const {
    return {nodes_->crossed_x(here_, w), here_[w] ^ next_j_[w], here_[w] ^ next_k_[w]};
  }

 private:
  const NodeBits* nodes_;
  const std::uint64_t* here_;
  const std::uint64_t* next_j_;
  const std::uint64_t* next_k_;
};

}  // namespace difmesh::detail
