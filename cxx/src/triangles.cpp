#include "triangles.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "case_table.hpp"

namespace difmesh::detail {
namespace {

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

  /// Calls visit(w, mask) for the words with cells that the surface passes: bits of the mask.
  template <class Visit>
  void for_each_active_word(const Visit& visit) const {
    const std::int64_t words = nodes_.words();
    std::uint64_t any = rows_[0][0] | rows_[1][0] | rows_[2][0] | rows_[3][0];
    std::uint64_t all = rows_[0][0] & rows_[1][0] & rows_[2][0] & rows_[3][0];
    for (std::int64_t w = 0; w < words; ++w) {
      std::uint64_t next_any = 0;
      std::uint64_t next_all = 0;
      if (w + 1 < words) {
        next_any = rows_[0][w + 1] | rows_[1][w + 1] | rows_[2][w + 1] | rows_[3][w + 1];
        next_all = rows_[0][w + 1] & rows_[1][w + 1] & rows_[2][w + 1] & rows_[3][w + 1];
      }
      const std::uint64_t mixed =
          (any | any >> 1 | next_any << 63) & ~(all & (all >> 1 | next_all << 63));
      any = next_any;
      all = next_all;
      if (mixed != 0) {
        const std::uint64_t cells =
            mixed & NodeBits::range(w, nodes_.first()[0], nodes_.last()[0] - 1);
        if (cells != 0) {
          visit(w, cells);
        }
      }
    }
  }

  /// The case of the cell at a bit of a word.
  [[nodiscard]] std::uint8_t corners(std::int64_t w, int bit) const {
    unsigned corners = 0;
    for (unsigned n = 0; n < 4; ++n) {
      const std::uint64_t pair =
          bit < 63 ? rows_[n][w] >> bit : rows_[n][w] >> 63 | (next(rows_[n], w) >> 63) << 1;
      corners |= static_cast<unsigned>(pair & 3) << (2 * n);
    }
    return static_cast<std::uint8_t>(corners);
  }

  /// Triangles of a cell, its ambiguous faces settled by the mean of their fractions.
  [[nodiscard]] CubeTriangles triangles(std::int64_t i, std::uint8_t corners) const {
    const unsigned ambiguous = ambiguous_faces(corners);
    if (ambiguous == 0) {
      return cube_triangles(corners, 0);
    }
    std::uint8_t joined = 0;
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

// The crossed edges that start in one row of nodes, and the numbers of their vertices.
struct NumberedRow {
  std::vector<EdgeWord> edges;       // by word; one more, without edges
  std::vector<std::uint32_t> start;  // vertices before each word
  std::int64_t row = -1;

  explicit NumberedRow(const NodeBits& nodes)
      : edges(static_cast<std::size_t>(nodes.words()) + 1), start(edges.size()) {}

  void fill(const NodeBits& nodes, std::int64_t j, std::int64_t k,
            const std::vector<std::int64_t>& vertex_start) {
    row = nodes.row_index(j, k);
    const EdgeRow words(nodes, j, k);
    auto number = static_cast<std::uint32_t>(vertex_start[static_cast<std::size_t>(row)]);
    for (std::size_t w = 0; w + 1 < edges.size(); ++w) {
      edges[w] = words.word(static_cast<std::int64_t>(w));
      start[w] = number;
      number += edges[w].any() != 0 ? static_cast<std::uint32_t>(edges[w].count()) : 0;
    }
  }
};

// The four rows of nodes around a row of cells, numbered by (j, k) bits. Rows in the order of memory share two of
// them with the row before.
class RowsAround {
 public:
  RowsAround(const NodeBits& nodes, const std::vector<std::int64_t>& vertex_start)
      : nodes_(nodes),
        vertex_start_(vertex_start),
        rows_{new_row(), new_row(), new_row(), new_row()} {}

  void move_to(std::int64_t j, std::int64_t k) {
    for (std::size_t n = 0; n < 4; n += 2) {
      if (rows_[n + 1].row == nodes_.row_index(j, k + static_cast<std::int64_t>(n / 2))) {
        std::swap(rows_[n], rows_[n + 1]);
      }
    }
    for (std::size_t n = 0; n < 4; ++n) {
      const std::int64_t to_j = j + static_cast<std::int64_t>(n & 1);
      const std::int64_t to_k = k + static_cast<std::int64_t>(n >> 1);
      if (rows_[n].row != nodes_.row_index(to_j, to_k)) {
        rows_[n].fill(nodes_, to_j, to_k, vertex_start_);
      }
    }
  }
  [[nodiscard]] const NumberedRow& operator[](std::size_t n) const { return rows_[n]; }

 private:
  [[nodiscard]] NumberedRow new_row() const { return NumberedRow(nodes_); }

  const NodeBits& nodes_;
  const std::vector<std::int64_t>& vertex_start_;
  std::array<NumberedRow, 4> rows_;
};

// Numbers of the vertices around the cells of one word, walking along it.
class VertexNumbers {
 public:
  VertexNumbers(const RowsAround& rows, std::size_t w) {
    for (std::size_t n = 0; n < 4; ++n) {
      word_[n] = rows[n].edges[w];
      next_word_[n] = rows[n].edges[w + 1];
      word_start_[n] = rows[n].start[w];
    }
  }

  /// By edge of the cell last visited; meaningless for edges that are not crossed.
  [[nodiscard]] const std::array<std::uint32_t, kCubeEdges>& numbers() const { return number_; }

  /// Visits the cell at a bit. Bits must rise.
  void visit(int bit) {
    if (bit != next_bit_) {
      for (unsigned n = 0; n < 4; ++n) {
        start_[n] =
            word_start_[n] +
            (word_[n].any() != 0 ? static_cast<std::uint32_t>(word_[n].count_below(bit)) : 0);
        enter_node(n, 0, word_[n], bit);
      }
    } else {
      // Cells come in runs: what was on the upper side of the last is on the lower one.
      for (unsigned n = 4; n < kCubeEdges; n += 2) {
        number_[n] = number_[n + 1];
      }
    }
    for (unsigned n = 0; n < 4; ++n) {
      number_[n] = start_[n];
      start_[n] += edges_at(word_[n], bit);
      if (bit < 63) {
        enter_node(n, 1, word_[n], bit + 1);
      } else {
        enter_node(n, 1, next_word_[n], 0);
      }
    }
    next_bit_ = bit + 1;
  }

 private:
  static std::uint32_t bit_of(std::uint64_t word, int bit) {
    return static_cast<std::uint32_t>(word >> bit & 1);
  }
  static std::uint32_t edges_at(const EdgeWord& word, int bit) {
    return bit_of(word.x, bit) + bit_of(word.y, bit) + bit_of(word.z, bit);
  }

  // The edges across x that start at a node whose vertices begin at start_[n]; they are numbered x, y, z. Bit 0
  // of the row n is its place in y, bit 1 in z; the cell has an edge in y only from its lower rows in y, in z from
  // its lower ones in z.
  void enter_node(unsigned n, unsigned upper, const EdgeWord& word, int bit) {
    const std::uint32_t y = start_[n] + bit_of(word.x, bit);
    if ((n & 1U) == 0) {
      number_[4U + upper + (n & 2U)] = y;
    }
    if ((n & 2U) == 0) {
      number_[8U + upper + 2U * (n & 1U)] = y + bit_of(word.y, bit);
    }
  }

  std::array<EdgeWord, 4> word_;
  std::array<EdgeWord, 4> next_word_;
  std::array<std::uint32_t, 4> word_start_;  // vertices before the word
  std::array<std::uint32_t, 4> start_{};     // vertices before the node at next_bit_
  std::array<std::uint32_t, kCubeEdges> number_{};
  int next_bit_ = -1;
};

bool exists(const NodeBits& nodes, std::int64_t j, std::int64_t k) {
  return j >= nodes.first()[1] && k >= nodes.first()[2] && j < nodes.last()[1] &&
         k < nodes.last()[2];
}

// No vertex on the four rows of nodes: no triangle either.
bool is_bare(const NodeBits& nodes, std::int64_t j, std::int64_t k,
             const std::vector<std::int64_t>& vertex_start) {
  for (const std::int64_t row : {nodes.row_index(j, k), nodes.row_index(j, k + 1)}) {
    const auto n = static_cast<std::size_t>(row);
    if (vertex_start[n] != vertex_start[n + 2]) {
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
  phases.run(0.05, nodes.rows(), rows_per_portion(nodes),
             [&](std::int64_t begin, std::int64_t end) {
               for (std::int64_t row = begin; row < end; ++row) {
                 const std::int64_t j = row % row_length;
                 const std::int64_t k = row / row_length;
                 if (!exists(nodes, j, k) || is_bare(nodes, j, k, vertex_start)) {
                   continue;
                 }
                 const CellRow cells(grid, j, k);
                 std::size_t count = 0;
                 cells.for_each_active_word([&](std::int64_t w, std::uint64_t active) {
                   for (std::uint64_t left = active; left != 0; left &= left - 1) {
                     const int bit = std::countr_zero(left);
                     count += cells.triangles(64 * w + bit, cells.corners(w, bit)).size();
                   }
                 });
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
  hint_large_pages(mesh.triangles);
  phases.run(0.1, nodes.rows(), rows_per_portion(nodes), [&](std::int64_t begin, std::int64_t end) {
    RowsAround rows(nodes, vertex_start);
    for (std::int64_t row = begin; row < end; ++row) {
      auto next = static_cast<std::size_t>(triangle_start[static_cast<std::size_t>(row)]);
      if (next == static_cast<std::size_t>(triangle_start[static_cast<std::size_t>(row) + 1])) {
        continue;
      }
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      const CellRow cells(grid, j, k);
      rows.move_to(j, k);
      cells.for_each_active_word([&](std::int64_t w, std::uint64_t active) {
        VertexNumbers around(rows, static_cast<std::size_t>(w));
        const std::array<std::uint32_t, kCubeEdges>& number = around.numbers();
        for (std::uint64_t left = active; left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          around.visit(bit);
          for (const CubeTriangle& t : cells.triangles(64 * w + bit, cells.corners(w, bit))) {
            mesh.triangles[next++] = {number[t[0]], number[t[1]], number[t[2]]};
          }
        }
      });
    }
  });
}

double enclosed_volume(const Mesh& mesh, double level, Phases& phases) {
  constexpr std::int64_t kPortion = 8192;
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  std::vector<double> portions(static_cast<std::size_t>((count + kPortion - 1) / kPortion));
  phases.run(0.03, count, kPortion, [&](std::int64_t begin, std::int64_t end) {
    double sum = 0.0;
    for (std::int64_t n = begin; n < end; ++n) {
      const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(n)];
      const Vec3& a = mesh.positions[triangle[0]];
      const Vec3& b = mesh.positions[triangle[1]];
      const Vec3& c = mesh.positions[triangle[2]];
      // What lies below the triangle: its height times twice the area of its shadow.
      const double shadow = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      sum += ((a[2] - level) + (b[2] - level) + (c[2] - level)) * shadow;
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
