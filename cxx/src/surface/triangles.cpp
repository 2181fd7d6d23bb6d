#include "surface/triangles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "surface/case_table.hpp"
#include "surface/phase.hpp"

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

// The four rows of nodes around a row of cells, numbered by (j, k) bits. Rows in the order of
// memory share two of them with the row before.
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
      const EdgeWord& word = rows[n].edges[w];
      const EdgeWord& next = rows[n].edges[w + 1];
      x_[n] = word.x;
      y_[n] = word.y;
      z_[n] = word.z;
      next_x_[n] = next.x;
      next_y_[n] = next.y;
      start_[n] = rows[n].start[w];
      any_ |= word.any();
    }
  }

  /// Place in numbers() of the vertex on an edge of the cell; see case_table.hpp. Bit 0 of a row is
  /// its place in y, bit 1 in z; the cell has an edge in y only from its lower rows in y, in z from
  /// its lower ones in z.
  [[nodiscard]] static constexpr unsigned place_of(unsigned edge) {
    const unsigned along = edge_axis(edge);
    const unsigned upper_x = along == 0 ? 0 : edge & 1U;
    const unsigned row = along == 0 ? edge & 3U : (along == 1 ? edge & 2U : edge >> 1U & 1U);
    return 4U * (along + 2U * upper_x) + row;
  }

  /// Of the cell last visited; meaningless for edges that are not crossed.
  [[nodiscard]] const std::uint64_t (&numbers() const)[20] { return number_; }

  /// Visits the cell at a bit. Bits must rise.
  void visit(int bit) {
    // Nodes between this cell and the last: rarely do edges start there.
    if (bit != next_bit_ && (any_ & below(bit) & ~below(next_bit_)) != 0) {
      pass(below(bit) & ~below(next_bit_));
    }
    const bool is_last = bit == 63;
    const std::uint64_t* const upper_x = is_last ? next_x_ : x_;
    const std::uint64_t* const upper_y = is_last ? next_y_ : y_;
    const int upper = is_last ? 0 : bit + 1;
    for (unsigned n = 0; n < 4; ++n) {
      const std::uint64_t x = start_[n];
      const std::uint64_t y = x + (x_[n] >> bit & 1);
      const std::uint64_t z = y + (y_[n] >> bit & 1);
      const std::uint64_t next = z + (z_[n] >> bit & 1);
      const std::uint64_t next_y = next + (upper_x[n] >> upper & 1);
      number_[n] = x;
      number_[4 + n] = y;
      number_[8 + n] = z;
      number_[12 + n] = next_y;
      number_[16 + n] = next_y + (upper_y[n] >> upper & 1);
      start_[n] = next;
    }
    next_bit_ = upper;
  }

 private:
  void pass(std::uint64_t nodes) {
    for (unsigned n = 0; n < 4; ++n) {
      start_[n] += static_cast<std::uint64_t>(
          count_bits(x_[n] & nodes) + count_bits(y_[n] & nodes) + count_bits(z_[n] & nodes));
    }
  }

  std::uint64_t x_[4];  // crossed edges by row
  std::uint64_t y_[4];
  std::uint64_t z_[4];
  std::uint64_t next_x_[4];
  std::uint64_t next_y_[4];
  std::uint64_t start_[4];    // vertices before the node at next_bit_
  std::uint64_t any_ = 0;     // of all rows
  std::uint64_t number_[20];  // by node and edge: lower x, y, z, upper y, z; and by row
  int next_bit_ = 0;
};

// The triangles of a cell without ambiguous faces, at most four. One with such faces: see
// CellRow::triangles().
struct PlainCell {
  std::uint8_t place[12];  // in VertexNumbers::numbers()
  std::uint8_t count;
  bool is_ambiguous;
};
constexpr std::size_t kMostPlain = 4;

using PlainCells = std::array<PlainCell, 256>;

PlainCells make_plain_cells() {
  PlainCells cells{};
  for (unsigned corners = 0; corners < cells.size(); ++corners) {
    PlainCell& cell = cells[corners];
    cell.is_ambiguous = ambiguous_faces(static_cast<std::uint8_t>(corners)) != 0;
    if (cell.is_ambiguous) {
      continue;
    }
    for (const CubeTriangle& triangle : cube_triangles(static_cast<std::uint8_t>(corners), 0)) {
      for (std::size_t n = 0; n < 3; ++n) {
        cell.place[3 * cell.count + n] =
            static_cast<std::uint8_t>(VertexNumbers::place_of(triangle[n]));
      }
      ++cell.count;
    }
  }
  return cells;
}

const PlainCells& plain_cells() {
  static const PlainCells cells = make_plain_cells();
  return cells;
}

// Writes triangles in the order in which they come. Those of plain cells are written four at a
// time, whatever their number, so they wait in a buffer.
class TriangleWriter {
 public:
  explicit TriangleWriter(Triangle* to) : to_(to), cells_(plain_cells()) {}

  /// \pre the cell is not ambiguous
  void add(const PlainCell& cell, const std::uint64_t (&number)[20]) {
    Triangle* const triangles = buffer_.data() + count_;
    for (std::size_t n = 0; n < kMostPlain; ++n) {
      triangles[n] = {static_cast<std::uint32_t>(number[cell.place[3 * n]]),
                      static_cast<std::uint32_t>(number[cell.place[3 * n + 1]]),
                      static_cast<std::uint32_t>(number[cell.place[3 * n + 2]])};
    }
    count_ += cell.count;
    if (count_ > kFull) {
      flush();
    }
  }
  void add(const CubeTriangles& triangles, const std::uint64_t (&number)[20]) {
    const auto vertex = [&](std::uint8_t edge) {
      return static_cast<std::uint32_t>(number[VertexNumbers::place_of(edge)]);
    };
    for (const CubeTriangle& t : triangles) {
      buffer_[count_++] = {vertex(t[0]), vertex(t[1]), vertex(t[2])};
    }
    if (count_ > kFull) {
      flush();
    }
  }
  [[nodiscard]] const PlainCell& cell(std::uint8_t corners) const { return cells_[corners]; }

  void flush() {
    to_ = std::copy_n(buffer_.data(), count_, to_);
    count_ = 0;
  }

 private:
  static constexpr std::size_t kFull = 256;
  static constexpr std::size_t kMost = 10;  // of one cell

  Triangle* to_;
  const PlainCells& cells_;
  std::size_t count_ = 0;
  std::array<Triangle, kFull + kMost> buffer_;
};

bool exists(const NodeBits& nodes, std::int64_t j, std::int64_t k) {
  return j >= nodes.first()[1] && k >= nodes.first()[2] && j < nodes.last()[1] &&
         k < nodes.last()[2];
}

// True if no cell of a row has a triangle, as far as that is known without a look at its bits.
bool is_bare_cell_row(const NodeBits& nodes, std::int64_t j, std::int64_t k) {
  const std::int64_t row = nodes.row_index(j, k);
  const std::int64_t above = nodes.row_index(j, k + 1);
  return nodes.are_alike(row, row + 1) && nodes.are_alike(row, above) &&
         nodes.are_alike(above, above + 1);
}

}  // namespace

MeshCounts count_mesh(const DualGrid& grid, Phases& phases) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  const std::int64_t grain = rows_per_portion(nodes);
  MeshCounts counts;
  counts.vertex_start.resize(static_cast<std::size_t>(nodes.rows()) + 1);
  counts.triangle_start.resize(static_cast<std::size_t>((nodes.rows() + grain - 1) / grain) + 1);
  phases.run(kCounts.weight, nodes.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
    std::size_t triangles = 0;
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      std::int64_t vertices = 0;
      if (j >= nodes.first()[1] && k >= nodes.first()[2] && !is_bare(nodes, j, k)) {
        const EdgeRow edges(nodes, j, k);
        for (std::int64_t w = 0; w < nodes.words(); ++w) {
          const EdgeWord word = edges.word(w);
          vertices += word.any() != 0 ? word.count() : 0;
        }
      }
      counts.vertex_start[static_cast<std::size_t>(row) + 1] = vertices;
      if (!exists(nodes, j, k) || is_bare_cell_row(nodes, j, k)) {
        continue;
      }
      const CellRow cells(grid, j, k);
      const PlainCells& plain = plain_cells();
      cells.for_each_active_word([&](std::int64_t w, std::uint64_t active) {
        for (std::uint64_t left = active; left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          const std::uint8_t corners = cells.corners(w, bit);
          triangles += plain[corners].is_ambiguous ? cells.triangles(64 * w + bit, corners).size()
                                                   : plain[corners].count;
        }
      });
    }
    counts.triangle_start[static_cast<std::size_t>(begin / grain) + 1] =
        static_cast<std::int64_t>(triangles);
  });
  counts.vertex_start[0] = 0;
  std::partial_sum(counts.vertex_start.begin(), counts.vertex_start.end(),
                   counts.vertex_start.begin());
  std::partial_sum(counts.triangle_start.begin(), counts.triangle_start.end(),
                   counts.triangle_start.begin());
  return counts;
}

void connect(const DualGrid& grid, const MeshCounts& counts, Phases& phases, Mesh& mesh) {
  const NodeBits& nodes = grid.nodes();
  const std::int64_t row_length = nodes.last()[1] + 1;
  const std::int64_t grain = rows_per_portion(nodes);
  mesh.triangles.resize(static_cast<std::size_t>(counts.triangle_start.back()));
  hint_large_pages(mesh.triangles);
  phases.run(kTriangles.weight, nodes.rows(), grain, [&](std::int64_t begin, std::int64_t end) {
    const auto portion = static_cast<std::size_t>(begin / grain);
    if (counts.triangle_start[portion] == counts.triangle_start[portion + 1]) {
      return;
    }
    RowsAround rows(nodes, counts.vertex_start);
    TriangleWriter writer(mesh.triangles.data() + counts.triangle_start[portion]);
    for (std::int64_t row = begin; row < end; ++row) {
      const std::int64_t j = row % row_length;
      const std::int64_t k = row / row_length;
      if (!exists(nodes, j, k) || is_bare_cell_row(nodes, j, k)) {
        continue;
      }
      const CellRow cells(grid, j, k);
      rows.move_to(j, k);
      cells.for_each_active_word([&](std::int64_t w, std::uint64_t active) {
        VertexNumbers around(rows, static_cast<std::size_t>(w));
        for (std::uint64_t left = active; left != 0; left &= left - 1) {
          const int bit = std::countr_zero(left);
          around.visit(bit);
          const std::uint8_t corners = cells.corners(w, bit);
          const PlainCell& cell = writer.cell(corners);
          if (cell.is_ambiguous) {
            writer.add(cells.triangles(64 * w + bit, corners), around.numbers());
          } else {
            writer.add(cell, around.numbers());
          }
        }
      });
    }
    writer.flush();
  });
}

}  // namespace difmesh::detail
