#include "difmesh/fractions_from_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "cell_clipper.hpp"
#include "column_sums.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "grid_mesh.hpp"
#include "parallel.hpp"
#include "position_text.hpp"
#include "stopwatch.hpp"
#include "triangle_bins.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr double kLeastTolerance = 1e-12;
constexpr double kGreatestTolerance = 0.25;
// Coordinates in grid units are rounded by about this share of themselves, and a fraction is no
// better than the coordinates.
constexpr double kSnap = 0x1p-51;

[[noreturn]] void throw_invalid(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

void check_options(const FractionsFromMeshOptions& options) {
  if (!(options.tolerance >= kLeastTolerance && options.tolerance <= kGreatestTolerance)) {
    throw_invalid("tolerance must be within [1e-12, 0.25], got " + rounded_text(options.tolerance));
  }
}

RowRules row_rules(const Grid& grid, const FractionsFromMeshOptions& options) {
  RowRules rules;
  rules.sign = options.flip ? -1.0 : 1.0;
  rules.tolerance = options.tolerance;
  rules.snap = kSnap * static_cast<double>(*std::max_element(grid.dims.begin(), grid.dims.end()));
  return rules;
}

void check_sizes(const Grid& grid, std::span<const Vec3> positions,
                 std::span<const Triangle> triangles) {
  constexpr std::size_t kMax = std::numeric_limits<std::uint32_t>::max();
  if (triangles.empty()) {
    throw_invalid("the mesh is empty: it has no triangles");
  }
  if (positions.size() > kMax || triangles.size() > kMax) {
    throw Error(ErrorCode::too_large, "the mesh has " + std::to_string(positions.size()) +
                                          " vertices and " + std::to_string(triangles.size()) +
                                          " triangles; 2^32 - 1 of each are possible");
  }
  if (grid.cell_count() > std::numeric_limits<std::ptrdiff_t>::max() / 8) {
    throw Error(ErrorCode::too_large, "the grid has " + std::to_string(grid.cell_count()) +
                                          " cells; a field of them exceeds 2^63 bytes");
  }
}

/// Lends each portion of the work a ColumnSums, cleared; there are never more than threads.
class SumsPool {
 public:
  SumsPool(std::int64_t rows, std::int64_t cells) : rows_(rows), cells_(cells) {}

  std::unique_ptr<ColumnSums> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        auto sums = std::move(free_.back());
        free_.pop_back();
        return sums;
      }
    }
    return std::make_unique<ColumnSums>(rows_, cells_);
  }
  void give_back(std::unique_ptr<ColumnSums> sums) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(sums));
  }

 private:
  std::int64_t rows_;
  std::int64_t cells_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ColumnSums>> free_;
};

/// What became of one block of rows.
struct BlockResult {
  RowFacts facts;
  ColumnFault fault;     ///< of the first row that has one
  Index3 cell{0, 0, 0};  ///< where
};

/// Everything that the blocks of rows are made from.
struct Work {
  const Grid& grid;
  std::span<const Vec3> corners;
  std::span<const Triangle> triangles;
  const RowBlocks& blocks;
  const TriangleBins& bins;
  RowRules rules;
};

/// Fills the rows of one block. \param sums as many rows as a block has, cleared; so is it left
/// \param fractions null: only the facts are wanted
BlockResult fill_block(const Work& work, std::int64_t block, ColumnSums& sums, double* fractions) {
  BlockResult result;
  const RowBlocks::Rows rows = work.blocks.rows(block);
  const Index3& dims = work.grid.dims;
  CellClipper clipper(rows, dims[0], sums);
  for (const std::uint32_t t : work.bins.triangles(block)) {
    const Triangle& triangle = work.triangles[t];
    clipper.add_triangle(work.corners[triangle[0]], work.corners[triangle[1]],
                         work.corners[triangle[2]]);
  }
  result.facts.pieces = clipper.pieces();
  std::vector<double> nowhere(fractions == nullptr ? static_cast<std::size_t>(dims[0]) : 0);
  std::int64_t row = 0;
  for (std::int64_t k = rows.first_k; k < rows.end_k; ++k) {
    for (std::int64_t j = rows.first_j; j < rows.end_j; ++j) {
      double* out = fractions == nullptr ? nowhere.data() : fractions + (k * dims[1] + j) * dims[0];
      const ColumnFault fault = sums.drain(row++, work.rules, out, result.facts);
      if (fault.kind != ColumnFault::Kind::none && result.fault.kind == ColumnFault::Kind::none) {
        result.fault = fault;
        result.cell = {fault.x, j, k};
      }
    }
  }
  return result;
}

std::string describe_gap(const BlockResult& block, const Grid& grid) {
  const Vec3 centre = grid.cell_centre(block.cell);
  return "the column of cells along x at j = " + std::to_string(block.cell[1]) +
         ", k = " + std::to_string(block.cell[2]) + ", y = " + rounded_text(centre[1]) +
         ", z = " + rounded_text(centre[2]) + ", has a gap of " + rounded_text(block.fault.value) +
         " of its cross-section";
}

[[noreturn]] void throw_fault(const BlockResult& block, const Grid& grid, double tolerance) {
  if (block.fault.kind == ColumnFault::Kind::gap) {
    throw_invalid("the mesh is open: " + describe_gap(block, grid) + "; the tolerance is " +
                  rounded_text(tolerance));
  }
  const Index3& cell = block.cell;
  throw_invalid("parts of the mesh overlap or are inside out: cell (" + std::to_string(cell[0]) +
                ", " + std::to_string(cell[1]) + ", " + std::to_string(cell[2]) + ") at " +
                rounded_text(grid.cell_centre(cell)) + " would have the fraction " +
                rounded_text(block.fault.value));
}

std::vector<BlockResult> fill_blocks(const Work& work, Phases& phases, double* fractions) {
  std::vector<BlockResult> results(static_cast<std::size_t>(work.blocks.count()));
  SumsPool pool(work.blocks.rows_per_block(), work.grid.dims[0]);
  phases.run(1.0 - kCheckWeight, work.blocks.count(), 1, [&](std::int64_t begin, std::int64_t end) {
    auto sums = pool.take();
    for (std::int64_t block = begin; block < end; ++block) {
      results[static_cast<std::size_t>(block)] = fill_block(work, block, *sums, fractions);
    }
    pool.give_back(std::move(sums));
  });
  return results;
}

/// Fills the whole field. Faults are named in the order of memory, whoever found them first.
RowFacts fill_field(const Work& work, Phases& phases, double* fractions) {
  RowFacts facts;
  for (const BlockResult& result : fill_blocks(work, phases, fractions)) {
    if (result.fault.kind != ColumnFault::Kind::none) {
      throw_fault(result, work.grid, work.rules.tolerance);
    }
    facts.merge(result.facts);
  }
  return facts;
}

/// An edge says where a mesh is torn, a column how far the hole gapes, where the grid sees it.
[[noreturn]] void throw_defect(const EdgeDefect& defect, const Work& work, Phases& phases) {
  if (defect.open) {
    for (const BlockResult& result : fill_blocks(work, phases, nullptr)) {
      if (result.fault.kind == ColumnFault::Kind::gap) {
        throw_invalid(defect.message + "; " + describe_gap(result, work.grid));
      }
    }
  }
  throw_invalid(defect.message);
}

void fill_report(const RowFacts& facts, const Grid& grid, FractionsFromMeshReport& report) {
  report.pieces = facts.pieces;
  report.cells_touched = facts.cells_touched;
  report.lowest_raw = facts.lowest_raw;
  report.highest_raw = facts.highest_raw;
  report.largest_gap = facts.largest_gap;
  report.fraction_volume =
      (static_cast<double>(facts.full_cells) + facts.touched_fractions) * grid.cell_volume();
}

}  // namespace

FractionsFromMesh fractions_from_mesh(const Grid& grid, std::span<const Vec3> positions,
                                      std::span<const Triangle> triangles,
                                      const FractionsFromMeshOptions& options) {
  const DefaultFloatEnvironment environment;
  Stopwatch whole;
  Stopwatch phase;
  check_options(options);
  validate(grid);
  check_sizes(grid, positions, triangles);
  Workers workers(options.threads);
  Phases phases(workers, options.progress);

  FractionsFromMesh result;
  FractionsFromMeshReport& report = result.report;
  const GridMesh mesh =
      checked_mesh(grid, positions, triangles, {options.flip, options.check_edges}, phases);
  report.mesh_volume = mesh.volume * grid.cell_volume();
  report.seconds.check = phase.lap();

  // First of what grows with the grid: where memory is short, this is what fails, before it is
  // touched.
  if (!mesh.defect) {
    result.fractions.resize(static_cast<std::size_t>(grid.cell_count()));
  }
  const RowBlocks blocks(grid.dims);
  const TriangleBins bins(blocks, mesh.corners, triangles, workers);
  report.seconds.bin = phase.lap();

  const Work work{grid, mesh.corners, triangles, blocks, bins, row_rules(grid, options)};
  if (mesh.defect) {
    throw_defect(*mesh.defect, work, phases);
  }
  fill_report(fill_field(work, phases, result.fractions.data()), grid, report);
  report.seconds.clip = phase.lap();
  phases.finish();
  report.seconds.total = whole.lap();
  return result;
}

}  // namespace difmesh
