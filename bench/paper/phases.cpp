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
  const char* printed;  ///< by the paper, ms
};

constexpr std::array<Phase, 4> kPhases{{
    {"marching cubes", [](const Seconds& s) { return s.classify + s.count + s.triangles; }, "326"},
    {"normals and planes", [](const Seconds& s) { return s.normals; }, "996"},
    {"vertices", [](const Seconds& s) { return s.vertices; }, "440"},
    {"all", [](const Seconds& s) { return s.total; }, "1762"},
}};

/// The least of all rounds: what other programs on the machine disturb least.
std::string least_ms(const std::vector<Seconds>& rounds, double (*of)(const Seconds&)) {
  double least = of(rounds.front());
  for (const Seconds& round : rounds) {
    least = std::min(least, of(round));
  }
  return number(1e3 * least, 3);
}

std::vector<Seconds> timed(const Sample& at, Placement placement, Normals normals, int rounds) {
  Options options;
  options.placement = placement;
  options.normals = normals;
  options.threads = 1;
  std::vector<Seconds> result;
  for (int round = 0; round < rounds; ++round) {
    result.push_back(reconstruct(at.field(), at.grid, options).report.seconds);
  }
  return result;
}

void placements_by_phase(Run& run, const Sample& at, int rounds) {
  constexpr std::array<Placement, 3> kPlacements{Placement::linear, Placement::manson,
                                                 Placement::plic};
  std::array<std::vector<Seconds>, kPlacements.size()> seconds;
  for (std::size_t p = 0; p < kPlacements.size(); ++p) {
    seconds[p] = timed(at, kPlacements[p], Normals::height_function, rounds);
  }
  Table table({"phase", "linear ms", "manson ms", "plic ms", "printed ms"});
  for (const Phase& phase : kPhases) {
    std::vector<std::string> row{phase.name};
    for (const std::vector<Seconds>& of_placement : seconds) {
      row.push_back(least_ms(of_placement, phase.of));
    }
    row.push_back(phase.printed);
    table.add(row);
  }
  run.write_csv("table1", table);
  run.write_page("table1", table);
}

void normals_alone(Run& run, const Sample& at, int rounds) {
  struct Kind {
    const char* name;
    Normals normals;
  };
  constexpr std::array<Kind, 5> kKinds{{{"youngs", Normals::youngs},
                                        {"myc", Normals::myc},
                                        {"height_function", Normals::height_function},
                                        {"elvira", Normals::elvira},
                                        {"lvira", Normals::lvira}}};
  Table table({"normals", "normals and planes, ms"});
  for (const Kind& kind : kKinds) {
    table.add({kind.name, least_ms(timed(at, Placement::plic, kind.normals, rounds),
                                   [](const Seconds& s) { return s.normals; })});
  }
  run.write_csv("normals", table);
  run.write_page("normals", table);
}

}  // namespace

void run_phases(Run& run) {
  const Sample at = sample(Body::sphere(), 50.0, 0, run.threads);
  placements_by_phase(run, at, run.is_short ? 3 : 51);
  normals_alone(run, at, run.is_short ? 1 : 11);
}

}  // namespace difmesh::paper
