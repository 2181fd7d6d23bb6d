#include "difmesh/fractions_from_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "base/stopwatch.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "mesh/grid_mesh.hpp"
#include "sampling/cell_clipper.hpp"
#include "sampling/cell_overlaps.hpp"
#include "sampling/column_sums.hpp"
#include "sampling/piece_lists.hpp"
#include "sampling/sheet_facts.hpp"
#include "sampling/triangle_bins.hpp"

namespace difmesh {
namespace {

using namespace detail;

constexpr double kLeastTolerance = 1e-12;
constexpr double kGreatestTolerance = 0.25;
// Coordinates in grid units are rounded by about this share of themselves, and a fraction is no
// better than the coordinates.
constexpr double kSnap = 0x1p-51;
// So much of a cell may seem covered twice where sheets touch.
constexpr double kOverlapRounding = 1e-12;
// Pockets inside out up to this share of the volume are what meshes that cut themselves have; more
// is a part that was turned.
constexpr double kPockets = 1e-3;

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
  rules.rounding = std::max(kOverlapRounding, 4.0 * rules.snap);
  if (!options.check_edges) {
    rules.rounding = std::max(rules.rounding, options.tolerance);
  }
  rules.overlaps = options.overlaps;
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

/// What a portion of the work needs to fill blocks, cleared before each.
struct Bench {
  ColumnSums sums;
  PieceLists lists;
  CellOverlaps overlaps;

  Bench(std::int64_t rows, std::int64_t cells, const NamedMesh& mesh, double sign)
      : sums(rows, cells), lists(rows, cells + 2), overlaps(mesh, sign) {}
};

/// Lends each portion of the work a bench; there are never more than threads.
class BenchPool {
 public:
  std::unique_ptr<Bench> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) {
      return nullptr;
    }
    auto bench = std::move(free_.back());
    free_.pop_back();
    return bench;
  }
  void give_back(std::unique_ptr<Bench> bench) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(bench));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bench>> free_;
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
  NamedMesh mesh;
  const RowBlocks& blocks;
  const TriangleBins& bins;
  RowRules rules;
};

/// Fills the rows of one block.
/// \param bench for as many rows as a block has, cleared; so is it left
/// \param fractions null: only the facts are wanted
BlockResult fill_block(const Work& work, std::int64_t block, Bench& bench, double* fractions) {
  BlockResult result;
  const RowBlocks::Rows rows = work.blocks.rows(block);
  const Index3& dims = work.grid.dims;
  CellClipper clipper(rows, dims[0], bench.sums, bench.lists);
  for (const std::uint32_t t : work.bins.triangles(block)) {
    const Triangle& triangle = work.mesh.triangles[t];
    clipper.add_triangle(t, work.mesh.corners[triangle[0]], work.mesh.corners[triangle[1]],
                         work.mesh.corners[triangle[2]]);
  }
  result.facts.pieces = clipper.pieces();
  bench.overlaps.begin_block(rows, bench.lists);
  std::vector<double> nowhere(fractions == nullptr ? static_cast<std::size_t>(dims[0]) : 0);
  std::int64_t row = 0;
  for (std::int64_t k = rows.first_k; k < rows.end_k; ++k) {
    for (std::int64_t j = rows.first_j; j < rows.end_j; ++j) {
      double* out = fractions == nullptr ? nowhere.data() : fractions + (k * dims[1] + j) * dims[0];
      const ColumnFault fault =
          bench.sums.drain(row++, work.rules, {{0, j, k}, out, bench.overlaps, result.facts});
      if (fault.kind != ColumnFault::Kind::none && result.fault.kind == ColumnFault::Kind::none) {
        result.fault = fault;
        result.cell = {fault.x, j, k};
      }
    }
  }
  bench.lists.clear();
  return result;
}

std::string describe_gap(const BlockResult& block, const Grid& grid) {
  const Vec3 centre = grid.cell_centre(block.cell);
  return "the column of cells along x at j = " + std::to_string(block.cell[1]) +
         ", k = " + std::to_string(block.cell[2]) + ", y = " + rounded_text(centre[1]) +
         ", z = " + rounded_text(centre[2]) + ", has a gap of " + rounded_text(block.fault.value) +
         " of its cross-section";
}

std::string describe_cell(const Index3& cell, const Grid& grid) {
  return "cell (" + std::to_string(cell[0]) + ", " + std::to_string(cell[1]) + ", " +
         std::to_string(cell[2]) + ") at " + rounded_text(grid.cell_centre(cell));
}

[[noreturn]] void throw_fault(const BlockResult& block, const Grid& grid, double tolerance) {
  if (block.fault.kind == ColumnFault::Kind::gap) {
    throw_invalid("the mesh is open: " + describe_gap(block, grid) + "; the tolerance is " +
                  rounded_text(tolerance));
  }
  const double share = block.fault.value;
  if (block.fault.kind == ColumnFault::Kind::undecided) {
    throw_invalid(
        "whether parts of the mesh overlap is undecided in " + rounded_text(share) +
        " of the volume of " + describe_cell(block.cell, grid) +
        ": too many triangles that are not one sheet meet there; smaller cells hold fewer");
  }
  throw_invalid(std::string("parts of the mesh ") +
                (share > 0.0 ? "overlap: " : "are inside out: ") + describe_cell(block.cell, grid) +
                " has " + rounded_text(std::abs(share)) + " of its volume " +
                (share > 0.0 ? "covered more than once" : "inside out, outside of all others"));
}

std::vector<BlockResult> fill_blocks(const Work& work, Phases& phases, double* fractions) {
  std::vector<BlockResult> results(static_cast<std::size_t>(work.blocks.count()));
  BenchPool pool;
  phases.run(1.0 - kCheckWeight, work.blocks.count(), 1, [&](std::int64_t begin, std::int64_t end) {
    auto bench = pool.take();
    if (!bench) {
      bench = std::make_unique<Bench>(work.blocks.rows_per_block(), work.grid.dims[0], work.mesh,
                                      work.rules.sign);
    }
    for (std::int64_t block = begin; block < end; ++block) {
      results[static_cast<std::size_t>(block)] = fill_block(work, block, *bench, fractions);
    }
    pool.give_back(std::move(bench));
  });
  return results;
}

[[nodiscard]] double fraction_sum(const RowFacts& facts) {
  return static_cast<double>(facts.full_fractions) + facts.touched_fractions;
}

void check_pockets(const RowFacts& facts, const Grid& grid) {
  const double share = facts.inverted.sum / fraction_sum(facts);
  // Without any volume, the share is infinite.
  if (facts.inverted.count > 0 && !(share <= kPockets)) {
    throw_invalid("parts of the mesh are inside out, " +
                  rounded_text(facts.inverted.sum * grid.cell_volume()) +
                  " of volume outside of all others, most in " +
                  describe_cell(facts.inverted.where, grid));
  }
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
  if (work.rules.overlaps == Overlaps::unite) {
    check_pockets(facts, work.grid);
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

CoverReport cover_report(const MarkedCells& cells, const Grid& grid) {
  CoverReport report;
  if (cells.count == 0) {
    return report;
  }
  report.volume = cells.sum * grid.cell_volume();
  report.cells = cells.count;
  report.largest = cells.largest;
  report.cell = cells.where;
  for (std::size_t a = 0; a < 3; ++a) {
    report.low[a] = grid.origin[a] + static_cast<double>(cells.low[a]) * grid.spacing[a];
    report.high[a] = grid.origin[a] + static_cast<double>(cells.high[a] + 1) * grid.spacing[a];
  }
  return report;
}

void fill_report(const RowFacts& facts, const Grid& grid, FractionsFromMeshReport& report) {
  report.pieces = facts.pieces;
  report.cells_touched = facts.cells_touched;
  report.lowest_raw = facts.lowest_raw;
  report.highest_raw = facts.highest_raw;
  report.largest_gap = facts.largest_gap;
  report.fraction_volume = fraction_sum(facts) * grid.cell_volume();
  report.overlap = cover_report(facts.overlaps, grid);
  report.inverted = cover_report(facts.inverted, grid);
  report.undecided = cover_report(facts.undecided, grid);
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
  require_uniform(grid, "fractions_from_mesh");
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
  const SheetFacts facts = sheet_facts(mesh.corners, triangles, workers);
  report.seconds.bin = phase.lap();

  const Work work{
      grid, {mesh.corners, mesh.names, triangles, facts}, blocks, bins, row_rules(grid, options)};
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
