#include "sampling/corner_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/first_error.hpp"
#include "sampling/sampled_box.hpp"
#include "sampling/sampled_function.hpp"

namespace difmesh::detail {
namespace {

// Nodes held at a time, in slabs of whole layers.
constexpr std::int64_t kNodesPerSlab = std::int64_t{1} << 21;
constexpr std::int64_t kFewestSlabs = 24;
constexpr std::int64_t kPointsPerBatch = 1024;
constexpr std::int64_t kRowsPerPortion = 8;

// Walks over the grid in slabs of cell layers. Layer k of the nodes is kept in place k mod (layers
// held), so that the layers which two slabs share stay where they are.
class LatticeWalk {
 public:
  LatticeWalk(const Grid& grid, const FunctionBatch& f, Workers& workers,
              std::span<double> fractions);

  [[nodiscard]] std::int64_t slabs() const { return (nz_ + slab_ - 1) / slab_; }
  void take_slab(std::int64_t index, Screening& result);

 private:
  struct RowScratch {
    std::vector<double> low, high, bend;
  };
  struct RowResult {
    std::vector<CellCandidate> candidates;
    std::int64_t full_cells = 0;
  };

  void evaluate_layers(std::int64_t first, std::int64_t last);
  void evaluate_row(SampledFunction& f, std::int64_t j, std::int64_t k, std::vector<Vec3>& points);
  void bend_layers(std::int64_t first, std::int64_t last);
  void bend_row(std::int64_t j, std::int64_t k);
  void screen_row(std::int64_t j, std::int64_t k, RowScratch& scratch, RowResult& result);
  void summarise(std::int64_t j, std::int64_t k, RowScratch& scratch) const;
  [[nodiscard]] const double* values(std::int64_t j, std::int64_t k) const {
    return values_.data() + (k % (slab_ + 3) * (ny_ + 1) + j) * (nx_ + 1);
  }
  [[nodiscard]] const double* bends(std::int64_t j, std::int64_t k) const {
    return bends_.data() + (k % (slab_ + 1) * (ny_ + 1) + j) * (nx_ + 1);
  }

  const Grid& grid_;
  const FunctionBatch& f_;
  const GradientBatch no_gradient_;
  Workers& workers_;
  std::span<double> fractions_;
  std::int64_t nx_, ny_, nz_;
  std::int64_t slab_;           // cell layers per slab
  std::int64_t evaluated_ = 0;  // node layers so far
  std::int64_t bent_ = 0;
  Array<double> values_;
  Array<double> bends_;
};

LatticeWalk::LatticeWalk(const Grid& grid, const FunctionBatch& f, Workers& workers,
                         std::span<double> fractions)
    : grid_(grid),
      f_(f),
      workers_(workers),
      fractions_(fractions),
      nx_(grid.dims[0]),
      ny_(grid.dims[1]),
      nz_(grid.dims[2]) {
  const std::int64_t layer = (nx_ + 1) * (ny_ + 1);
  slab_ = std::clamp<std::int64_t>(kNodesPerSlab / layer, 1,
                                   std::max<std::int64_t>(1, nz_ / kFewestSlabs));
  values_.resize(static_cast<std::size_t>((slab_ + 3) * layer));
  bends_.resize(static_cast<std::size_t>((slab_ + 1) * layer));
}

void LatticeWalk::take_slab(std::int64_t index, Screening& result) {
  const std::int64_t first = index * slab_;
  const std::int64_t last = std::min(nz_, first + slab_);
  // Second differences on the slab's last layer of nodes need one layer more, where there is one,
  // and at the low end of the grid the first layer borrows those of the second.
  const std::int64_t layers = std::min(nz_, std::max<std::int64_t>(last + 1, 2)) + 1;
  evaluate_layers(evaluated_, layers);
  result.calls += (layers - evaluated_) * (nx_ + 1) * (ny_ + 1);
  evaluated_ = layers;
  bend_layers(bent_, last + 1);
  bent_ = last + 1;

  const std::int64_t rows = (last - first) * ny_;
  std::vector<RowResult> parts(
      static_cast<std::size_t>((rows + kRowsPerPortion - 1) / kRowsPerPortion));
  workers_.for_portions(rows, kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    RowScratch scratch;
    for (std::int64_t row = begin; row < end; ++row) {
      screen_row(row % ny_, first + row / ny_, scratch,
                 parts[static_cast<std::size_t>(begin / kRowsPerPortion)]);
    }
  });
  for (const RowResult& part : parts) {
    result.full_cells += part.full_cells;
    result.candidates.insert(result.candidates.end(), part.candidates.begin(),
                             part.candidates.end());
  }
}

void LatticeWalk::evaluate_layers(std::int64_t first, std::int64_t last) {
  FirstError error;
  const std::int64_t rows = (last - first) * (ny_ + 1);
  workers_.for_portions(rows, kRowsPerPortion, [&](std::int64_t begin, std::int64_t end) {
    error.guard(begin, [&] {
      SampledFunction f(f_, no_gradient_, grid_);
      std::vector<Vec3> points;
      for (std::int64_t row = begin; row < end; ++row) {
        evaluate_row(f, row % (ny_ + 1), first + row / (ny_ + 1), points);
      }
    });
  });
  error.rethrow();
}

void LatticeWalk::evaluate_row(SampledFunction& f, std::int64_t j, std::int64_t k,
                               std::vector<Vec3>& points) {
  double* out = values_.data() + (values(j, k) - values_.data());
  const double y = grid_.face(1, j);
  const double z = grid_.face(2, k);
  for (std::int64_t i = 0; i <= nx_; i += kPointsPerBatch) {
    const std::int64_t count = std::min(kPointsPerBatch, nx_ + 1 - i);
    points.resize(static_cast<std::size_t>(count));
    for (std::int64_t p = 0; p < count; ++p) {
      points[static_cast<std::size_t>(p)] = {grid_.face(0, i + p), y, z};
    }
    f.values(points, {out + i, static_cast<std::size_t>(count)});
  }
}

void LatticeWalk::bend_layers(std::int64_t first, std::int64_t last) {
  workers_.for_portions((last - first) * (ny_ + 1), kRowsPerPortion,
                        [&](std::int64_t begin, std::int64_t end) {
                          for (std::int64_t row = begin; row < end; ++row) {
                            bend_row(row % (ny_ + 1), first + row / (ny_ + 1));
                          }
                        });
}

// Second differences summed over the axes; at the sides of the grid those one node further in. A
// grid of one cell along some axis has none: every cell then needs a closer look.
void LatticeWalk::bend_row(std::int64_t j, std::int64_t k) {
  double* out = bends_.data() + (bends(j, k) - bends_.data());
  if (nx_ < 2 || ny_ < 2 || nz_ < 2) {
    std::fill_n(out, nx_ + 1, std::numeric_limits<double>::infinity());
    return;
  }
  const std::int64_t jc = std::clamp<std::int64_t>(j, 1, ny_ - 1);
  const std::int64_t kc = std::clamp<std::int64_t>(k, 1, nz_ - 1);
  const double* row = values(j, k);
  const double *y0 = values(jc - 1, k), *y1 = values(jc, k), *y2 = values(jc + 1, k);
  const double *z0 = values(j, kc - 1), *z1 = values(j, kc), *z2 = values(j, kc + 1);
  for (std::int64_t i = 1; i < nx_; ++i) {
    out[i] = std::abs(row[i - 1] - 2.0 * row[i] + row[i + 1]);
  }
  out[0] = out[1];
  out[nx_] = out[nx_ - 1];
  for (std::int64_t i = 0; i <= nx_; ++i) {
    out[i] += std::abs(y0[i] - 2.0 * y1[i] + y2[i]) + std::abs(z0[i] - 2.0 * z1[i] + z2[i]);
  }
}

// Least, greatest and bend over the four nodes with the same i.
void LatticeWalk::summarise(std::int64_t j, std::int64_t k, RowScratch& scratch) const {
  const auto nodes = static_cast<std::size_t>(nx_ + 1);
  scratch.low.resize(nodes);
  scratch.high.resize(nodes);
  scratch.bend.resize(nodes);
  const double *a = values(j, k), *b = values(j + 1, k);
  const double *c = values(j, k + 1), *d = values(j + 1, k + 1);
  const double *p = bends(j, k), *q = bends(j + 1, k);
  const double *r = bends(j, k + 1), *s = bends(j + 1, k + 1);
  for (std::size_t i = 0; i < nodes; ++i) {
    scratch.low[i] = std::min(std::min(a[i], b[i]), std::min(c[i], d[i]));
    scratch.high[i] = std::max(std::max(a[i], b[i]), std::max(c[i], d[i]));
    scratch.bend[i] = std::max(std::max(p[i], q[i]), std::max(r[i], s[i]));
  }
}

void LatticeWalk::screen_row(std::int64_t j, std::int64_t k, RowScratch& scratch,
                             RowResult& result) {
  summarise(j, k, scratch);
  const std::int64_t first = (k * ny_ + j) * nx_;
  for (std::int64_t i = 0; i < nx_; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const double low = std::min(scratch.low[n], scratch.low[n + 1]);
    const double high = std::max(scratch.high[n], scratch.high[n + 1]);
    const double bend = std::max(scratch.bend[n], scratch.bend[n + 1]);
    if (one_signed(low, high, bend)) {
      fractions_[static_cast<std::size_t>(first + i)] = low < 0.0 ? 1.0 : 0.0;
      result.full_cells += low < 0.0 ? 1 : 0;
      continue;
    }
    CellCandidate& cell = result.candidates.emplace_back();
    cell.cell = first + i;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const auto [dx, dy, dz] =
          Index3{static_cast<std::int64_t>(corner % 2), static_cast<std::int64_t>(corner / 2 % 2),
                 static_cast<std::int64_t>(corner / 4)};
      cell.corners[corner] = values(j + dy, k + dz)[i + dx];
    }
  }
}

}  // namespace

Screening screen_cells(const Grid& grid, const FunctionBatch& f, Workers& workers, Phases& phases,
                       double weight, std::span<double> fractions) {
  Screening result;
  LatticeWalk walk(grid, f, workers, fractions);
  const double share = weight / static_cast<double>(walk.slabs());
  for (std::int64_t slab = 0; slab < walk.slabs(); ++slab) {
    phases.run(share, 1, 1, [&](std::int64_t, std::int64_t) { walk.take_slab(slab, result); });
  }
  return result;
}

}  // namespace difmesh::detail
