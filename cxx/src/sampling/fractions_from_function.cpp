#include "difmesh/fractions_from_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/first_error.hpp"
#include "base/parallel.hpp"
#include "base/position_text.hpp"
#include "base/stopwatch.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "sampling/cell_quadrature.hpp"
#include "sampling/corner_lattice.hpp"
#include "sampling/known_cells.hpp"

namespace difmesh {
namespace {

using detail::CellCandidate;
using detail::CellQuadrature;

// What the lattice takes of the time, roughly; for the progress only.
constexpr double kLatticeWeight = 0.2;
constexpr std::int64_t kCellsPerPortion = 32;

void check_tolerance(const char* name, double value) {
  if (!(value >= 1e-13 && value <= 1e-2)) {
    throw Error(
        ErrorCode::invalid_argument,
        std::string(name) + " is " + detail::rounded_text(value) + "; 1e-13 to 1e-2 are possible");
  }
}

void check(const Grid& grid, const FunctionBatch& f, const FractionsFromFunctionOptions& options) {
  validate(grid);
  if (grid.cell_count() > std::numeric_limits<std::int64_t>::max() / 16) {
    throw Error(ErrorCode::too_large, "dims: the field does not fit in memory");
  }
  if (!f) {
    throw Error(ErrorCode::invalid_argument, "f is empty: there is no function to evaluate");
  }
  check_tolerance("tolerance", options.tolerance);
  check_tolerance("kink_tolerance", options.kink_tolerance);
  if (options.max_calls_per_cell < 1000 || options.max_calls_per_cell > 1'000'000'000) {
    throw Error(ErrorCode::invalid_argument, "max_calls_per_cell is " +
                                                 std::to_string(options.max_calls_per_cell) +
                                                 "; 1000 to 1e9 are possible");
  }
}

// Fractions this near to 0 or 1 are that, but for the rounding of coordinates.
double rounding_of(const Grid& grid) {
  double largest = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double high = grid.face(a, grid.dims[a]);
    largest = std::max(largest,
                       std::max(std::abs(grid.face(a, 0)), std::abs(high)) / grid.least_width(a));
  }
  return 8.0 * std::numeric_limits<double>::epsilon() * largest;
}

// On stretched axes.
double volume_of(std::span<const double> fractions, const Grid& grid) {
  double volume = 0.0;
  std::size_t n = 0;
  for (std::int64_t k = 0; k < grid.dims[2]; ++k) {
    for (std::int64_t j = 0; j < grid.dims[1]; ++j) {
      double length = 0.0;
      for (std::int64_t i = 0; i < grid.dims[0]; ++i, ++n) {
        length += fractions[n] * grid.width(0, i);
      }
      volume += length * grid.width(1, j) * grid.width(2, k);
    }
  }
  return volume;
}

// What a portion of the candidates adds to the report.
struct Tally {
  double sum = 0.0;
  double largest_error = 0.0;
  std::int64_t interfacial = 0;
  std::int64_t subdivided = 0;
  std::int64_t unresolved = 0;
  std::int64_t calls = 0;
  std::int64_t gradient_calls = 0;
};

class CandidateIntegration {
 public:
  CandidateIntegration(const Grid& grid, const FunctionBatch& f,
                       const FractionsFromFunctionOptions& options,
                       const detail::KnownFraction& known, std::span<double> fractions)
      : grid_(grid),
        f_(f),
        options_(options),
        known_(known),
        fractions_(fractions),
        rounding_(rounding_of(grid)) {}

  Tally run(std::span<const CellCandidate> candidates) const {
    Tally tally;
    CellQuadrature quadrature({options_.tolerance,
                               std::max(options_.tolerance, options_.kink_tolerance),
                               options_.max_calls_per_cell});
    detail::SampledFunction f(f_, options_.gradient, grid_);
    for (const CellCandidate& candidate : candidates) {
      Vec3 low;
      Vec3 size;
      std::int64_t index = candidate.cell;
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = grid_.face(a, index % grid_.dims[a]);
        size[a] = grid_.width(a, index % grid_.dims[a]);
        index /= grid_.dims[a];
      }
      CellQuadrature::Result result;
      if (const auto known = known_ ? known_(low, size) : std::nullopt) {
        result.fraction = *known;
      } else {
        result = quadrature.integrate(f, low, size, candidate.corners);
      }
      const double fraction = snap(result.fraction);
      fractions_[static_cast<std::size_t>(candidate.cell)] = fraction;
      tally.sum += fraction;
      tally.largest_error = std::max(tally.largest_error, result.error_estimate);
      tally.interfacial += fraction > 0.0 && fraction < 1.0 ? 1 : 0;
      tally.subdivided += result.subdivided ? 1 : 0;
      tally.unresolved += result.exhausted ? 1 : 0;
    }
    tally.calls = f.calls();
    tally.gradient_calls = f.gradient_calls();
    return tally;
  }

 private:
  [[nodiscard]] double snap(double fraction) const {
    if (fraction <= rounding_) {
      return 0.0;
    }
    return fraction >= 1.0 - rounding_ ? 1.0 : fraction;
  }

  const Grid& grid_;
  const FunctionBatch& f_;
  const FractionsFromFunctionOptions& options_;
  const detail::KnownFraction& known_;
  std::span<double> fractions_;
  double rounding_;
};

void fill_report(FractionsFromFunctionReport& report, const detail::Screening& screening,
                 std::span<const Tally> tallies) {
  double sum = static_cast<double>(screening.full_cells);
  for (const Tally& tally : tallies) {
    sum += tally.sum;
    report.largest_error_estimate = std::max(report.largest_error_estimate, tally.largest_error);
    report.interfacial_cells += tally.interfacial;
    report.subdivided_cells += tally.subdivided;
    report.unresolved_cells += tally.unresolved;
    report.function_calls += tally.calls;
    report.gradient_calls += tally.gradient_calls;
  }
  report.fraction_volume = sum;
  report.sampled_cells = static_cast<std::int64_t>(screening.candidates.size());
  report.lattice_calls = screening.calls;
  report.calls_per_interfacial_cell =
      static_cast<double>(report.function_calls) /
      static_cast<double>(std::max<std::int64_t>(1, report.interfacial_cells));
  report.function_calls += screening.calls;
}

}  // namespace

FractionsFromFunction fractions_from_function(const Grid& grid, const FunctionBatch& f,
                                              const FractionsFromFunctionOptions& options) {
  const DefaultFloatEnvironment environment;
  return detail::fractions_with_known_cells(grid, f, options, {});
}

FractionsFromFunction detail::fractions_with_known_cells(
    const Grid& grid, const FunctionBatch& f, const FractionsFromFunctionOptions& options,
    const KnownFraction& known) {
  detail::Stopwatch whole;
  detail::Stopwatch phase;
  check(grid, f, options);
  detail::Workers workers(options.threads);
  detail::Phases phases(workers, options.progress);
  FractionsFromFunction result;
  result.fractions.resize(static_cast<std::size_t>(grid.cell_count()));

  const detail::Screening screening =
      detail::screen_cells(grid, f, workers, phases, kLatticeWeight, result.fractions);
  result.report.seconds.lattice = phase.lap();

  const std::span<const CellCandidate> candidates = screening.candidates;
  const auto count = static_cast<std::int64_t>(candidates.size());
  const CandidateIntegration integration(grid, f, options, known, result.fractions);
  std::vector<Tally> tallies(
      static_cast<std::size_t>((count + kCellsPerPortion - 1) / kCellsPerPortion));
  detail::FirstError error;
  phases.run(1.0 - kLatticeWeight, count, kCellsPerPortion,
             [&](std::int64_t begin, std::int64_t end) {
               error.guard(begin, [&] {
                 tallies[static_cast<std::size_t>(begin / kCellsPerPortion)] =
                     integration.run(candidates.subspan(static_cast<std::size_t>(begin),
                                                        static_cast<std::size_t>(end - begin)));
               });
             });
  error.rethrow();
  phases.finish();

  fill_report(result.report, screening, tallies);
  result.report.fraction_volume = grid.is_uniform()
                                      ? result.report.fraction_volume * grid.cell_volume()
                                      : volume_of(result.fractions, grid);
  result.report.seconds.quadrature = phase.lap();
  result.report.seconds.total = whole.lap();
  return result;
}

}  // namespace difmesh
