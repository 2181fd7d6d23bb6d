// Table 1: time by phase for the sphere with R/dx = 50, on one thread.

#include <algorithm>
#include <array>

#include "difmesh/reconstruct.hpp"
#include "run.hpp"

namespace difmesh::paper {
namespace {

using Seconds = Report::Seconds;

struct Phase {
  const char* name;
  double (*of)(const Seconds& seconds);
  const char* printed;  ///< by the paper, seconds
};

constexpr std::array<Phase, 4> kPhases{{
    {"marching cubes", [](const Seconds& s) { return s.classify + s.count + s.triangles; },
     "0.326"},
    {"normals and planes", [](const Seconds& s) { return s.normals; }, "0.996"},
    {"vertices", [](const Seconds& s) { return s.vertices; }, "0.440"},
    {"all", [](const Seconds& s) { return s.total; }, "1.762"},
}};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

std::vector<Seconds> timed(const Sample& at, Placement placement, int rounds) {
  Options options;
  options.placement = placement;
  options.threads = 1;
  std::vector<Seconds> result;
  for (int round = 0; round < rounds; ++round) {
    result.push_back(reconstruct(at.field(), at.grid, options).report.seconds);
  }
  return result;
}

}  // namespace

void run_phases(Run& run) {
  const Sample at = sample(Body::sphere(), 50.0, 0, run.threads);
  Table table({"phase", "linear ms", "manson ms", "plic ms", "printed ms"});
  std::array<std::vector<Seconds>, 3> seconds;
  constexpr std::array<Placement, 3> kPlacements{Placement::linear, Placement::manson,
                                                 Placement::plic};
  for (std::size_t p = 0; p < kPlacements.size(); ++p) {
    seconds[p] = timed(at, kPlacements[p], run.is_short ? 3 : 51);
  }
  for (const Phase& phase : kPhases) {
    std::vector<std::string> row{phase.name};
    for (const std::vector<Seconds>& rounds : seconds) {
      std::vector<double> values(rounds.size());
      std::ranges::transform(rounds, values.begin(), phase.of);
      row.push_back(number(1e3 * median(values), 3));
    }
    row.push_back(number(1e3 * std::stod(phase.printed), 4));
    table.add(row);
  }
  run.write_csv("table1", table);
  run.write_page("table1", table);
}

}  // namespace difmesh::paper
