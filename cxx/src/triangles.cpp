#include "triangles.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "case_table.hpp"

namespace difmesh::detail {
namespace {

constexpr std::int64_t kRowsPerPortion = 16;

// Four rows of nodes, numbered by (j, k) bits, between which one row of dual cells lies.
class CellRow {
 public:
  CellRow(const DualGrid& grid, std::int64_t j, std::int64_t k)
      : grid_(grid), nodes_(grid.nodes()), j_(j), k_(k) {
    for (std::size_t n = 0; n < 4; ++n) {
      rows_[n] =
          nodes_.row(j + static_cast<std::int64_t>(n & 1), k + static_cast<std::int64_t>(n >> 1));
    }
  }

  [[nodiscard]] std::int64_t words() const { return nodes_.words(); }

  /// Cells of a word that the surface passes.
  [[nodiscard]] std::uint64_t active(std::int64_t w) const {
    std::uint64_t all = ~std::uint64_t{0};
    std::uint64_t any = 0;
    for (const std::uint64_t* row : rows_) {
      const std::uint64_t upper = next(row, w);
      all &= row[w] & upper;
      any |= row[w] | upper;
    }
    const std::uint64_t mixed = any & ~all;
    return mixed == 0 ? 0 : mixed & NodeBits::range(w, nodes_.first()[0], nodes_.last()[0] - 1);
  }

  /// The case of the cell at a bit of a word.
  [[nodiscard]] std::uint8_t corners(std::int64_t w, int bit) const {
    unsigned corners = 0;
    for (unsigned n = 0; n < 4; ++n) {
      const auto low = static_cast<unsigned>(rows_[n][w] >> bit & 1);
      const auto high = static_cast<unsigned>(next(rows_[n], w) >> bit & 1);
      corners |= (low | high << 1) << (2 * n);
    }
    return static_cast<std::uint8_t>(corners);
  }

  /// Triangles of a cell, its ambiguous faces settled by the mean of their fractions.
  [[nodiscard]] CubeTriangles triangles(std::int64_t i, std::uint8_t corners) const {
    std::uint8_t joined = 0;
    const unsigned ambiguous = ambiguous_faces(corners);
    for (unsigned left = ambiguous; left != 0; left &= left - 1) {
      const auto face = static_cast<unsigned>(std::countr_zero(left));
      if (joins(i, face)) {
        joined = static_cast<std::uint8_t>(joined | 1U << face);
      }
    }
    return cube_triangles(corners, joined);
  }

 private:
  [[nodiscard]] std::uint64_t next(const std::uint64_t* row, std::int64_t w) const {
    return row[w] >> 1 | (w + 1 < nodes_.words() ? row[w + 1] << 63 : 0);
  }

  // Opposite corners are added first: the sum is the same from both sides, and for mirrored fields.
  [[nodiscard]] bool joins(std::int64_t i, unsigned face) const {
    std::array<double, 4> fraction;
    const std::array<unsigned, 4> corners = face_corners(face);
    for (std::size_t n = 0; n < 4; ++n) {
      const unsigned c = corners[n];
      fraction[n] = grid_.node_fraction({i + (c & 1U), j_ + (c >> 1U & 1U), k_ + (c >> 2U & 1U)});
    }
    return (fraction[0] + fraction[3]) + (fraction[1] + fraction[2]) >= 2.0;
  }

  const DualGrid& grid_;
  const NodeBits& nodes_;
  std::int64_t j_;
  std::int64_t k_;
  std::array<const std::uint64_t*, 4> rows_;
};

// Numbers of the vertices around the cells of one row, walking along it.
class VertexNumbers {
 public:
  VertexNumbers(const DualGrid& grid, std::int64_t j, std::int64_t k,
                const std::vector<std::int64_t>& vertex_start)
      : edges_{EdgeRow(grid.nodes(), j, k), EdgeRow(grid.nodes(), j + 1, k),
               EdgeRow(grid.nodes(), j, k + 1), EdgeRow(grid.nodes(), j + 1, k + 1)} {
    for (std::size_t n = 0; n < 4; ++n) {
      const std::int64_t row = grid.nodes().row_index(j + static_cast<std::int64_t>(n & 1),
                                                      k + static_cast<std::int64_t>(n >> 1));
      next_[n] = vertex_start[static_cast<std::size_t>(row)];
    }
  }

  /// Must be called for words 0, 1, 2 … in turn.
  void enter_word(std::int64_t w) {
    for (std::size_t n = 0; n < 4; ++n) {
      skip_to(n, 64);
      word_[n] = edges_[n].word(w);
    }
    counted_ = 0;
    entered_ = w;
  }

  /// For the cell at a bit: numbers by edge of the cell; meaningless for edges that are not crossed.
  /// Must be called for rising bits.
  void around(int bit, std::array<std::uint32_t, kCubeEdges>& number) {
    for (unsigned n = 0; n < 4; ++n) {
      skip_to(n, bit);
      visit_node(word_[n], bit, n, 0, next_[n], number);
      std::int64_t beyond = next_[n];
      if (bit < 63) {
        visit_node(word_[n], bit + 1, n, 1, beyond, number);
      } else {
        visit_node(edges_[n].word(entered_ + 1), 0, n, 1, beyond, number);
      }
    }
    counted_ = bit + 1;
  }

 private:
  // Counts the vertices of the nodes from the last cell on. Cells come in runs, mostly without a gap.
  void skip_to(std::size_t n, int bit) {
    if (bit == counted_ || word_[n].any() == 0) {
      return;
    }
    const std::uint64_t before = bit == 64 ? ~std::uint64_t{0} : below(bit);
    const std::uint64_t gap = counted_ == 64 ? 0 : before & ~below(counted_);
    if ((word_[n].any() & gap) != 0) {
      next_[n] += count_bits(word_[n].x & gap) + count_bits(word_[n].y & gap) +
                  count_bits(word_[n].z & gap);
    }
  }

  // The edges that start at a node, x, y, z, as vertices are numbered. Bit 0 of the row n is its
  // place in y, bit 1 in z; the cell has an edge in y only from its lower rows in y, in z from its
  // lower ones in z.
  static void visit_node(const EdgeWord& word, int bit, unsigned n, unsigned upper,
                         std::int64_t& vertex, std::array<std::uint32_t, kCubeEdges>& number) {
    if (upper == 0) {
      number[n] = static_cast<std::uint32_t>(vertex);
    }
    vertex += static_cast<std::int64_t>(word.x >> bit & 1);
    if ((n & 1U) == 0) {
      number[4U + upper + (n & 2U)] = static_cast<std::uint32_t>(vertex);
    }
    vertex += static_cast<std::int64_t>(word.y >> bit & 1);
    if ((n & 2U) == 0) {
      number[8U + upper + 2U * (n & 1U)] = static_cast<std::uint32_t>(vertex);
    }
    vertex += static_cast<std::int64_t>(word.z >> bit & 1);
  }

  std::array<EdgeRow, 4> edges_;
  std::array<EdgeWord, 4> word_{};
  std::array<std::int64_t, 4> next_{};  // vertices before the node at bit counted_
  int counted_ = 0;
  std::int64_t entered_ = 0;
};

bool exists(const NodeBits& nodes, std::int64_t j, std::int64_t k) {
  return j >= nodes.first()[1] && k >= nodes.first()[2] && j < nodes.last()[1] &&
         k < nodes.last()[2];
}

// No vertex on the four rows of nodes: no triangle either.
bool is_bare(const NodeBits& nodes, std::int64_t j, std::int64_t k,
             const std::vector<std::int64_t>& vertex_start) {
  for (const std::int64_t row : {nodes.row_index(j, k), nodes.row_index(j + 1, k),
                                 nodes.row_index(j, k + 1), nodes.row_index(j + 1, k + 1)}) {
    const auto n = static_cast<std::size_t>(row);
    if (vertex_start[n] != vertex_start[n + 1]) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::int64_t> count_triangles(const DualGrid& grid,
                                          const std::vector<std::int64_t>& vertex_start,
                                          Phases& phases) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  std::vector<std::int64_t> start(static_cast<std::size_t>(nodes.rows()) + 1, 0);
  phases.run(0.05, nodes.rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      if (!exists(nodes, j, k) || is_bare(nodes, j, k, vertex_start)) {
        continue;
      }
      const CellRow cells(grid, j, k);
      std::size_t count = 0;
      for (std::int64_t w = 0; w < nodes.words(); ++w) {
        for (std::uint64_t left = cells.active(w); left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          count += cells.triangles(64 * w + bit, cells.corners(w, bit)).size();
        }
      }
      start[static_cast<std::size_t>(row) + 1] = static_cast<std::int64_t>(count);
    }
  });
  for (std::size_t row = 1; row < start.size(); ++row) {
    start[row] += start[row - 1];
  }
  return start;
}

void connect(const DualGrid& grid, const std::vector<std::int64_t>& vertex_start,
             const std::vector<std::int64_t>& triangle_start, Phases& phases, Mesh& mesh) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  mesh.triangles.resize(static_cast<std::size_t>(triangle_start.back()));
  phases.run(0.1, nodes.rows(), kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      auto next = static_cast<std::size_t>(triangle_start[static_cast<std::size_t>(row)]);
      if (next == static_cast<std::size_t>(triangle_start[static_cast<std::size_t>(row) + 1])) {
        continue;
      }
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      const CellRow cells(grid, j, k);
      VertexNumbers numbers(grid, j, k, vertex_start);
      std::array<std::uint32_t, kCubeEdges> number{};
      for (std::int64_t w = 0; w < nodes.words(); ++w) {
        numbers.enter_word(w);
        for (std::uint64_t left = cells.active(w); left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          numbers.around(bit, number);
          for (const CubeTriangle& t : cells.triangles(64 * w + bit, cells.corners(w, bit))) {
            mesh.triangles[next++] = {number[t[0]], number[t[1]], number[t[2]]};
          }
        }
      }
    }
  });
}

double enclosed_volume(const Mesh& mesh, const Vec3& near, Phases& phases) {
  constexpr std::int64_t kPortion = 8192;
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  std::vector<double> portions(static_cast<std::size_t>((count + kPortion - 1) / kPortion));
  phases.run(0.03, count, kPortion, [&](std::int64_t begin, std::int64_t end) {
    double sum = 0.0;
    for (std::int64_t n = begin; n < end; ++n) {
      Vec3 p[3];
      for (std::size_t corner = 0; corner < 3; ++corner) {
        p[corner] = mesh.positions[mesh.triangles[static_cast<std::size_t>(n)][corner]];
        for (std::size_t t = 0; t < 3; ++t) {
          p[corner][t] -= near[t];
        }
      }
      sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
             p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
             p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    portions[static_cast<std::size_t>(begin / kPortion)] = sum;
  });
  double sum = 0.0;
  for (const double portion : portions) {
    sum += portion;
  }
  return sum / 6.0;
}

}  // namespace difmesh::detail
