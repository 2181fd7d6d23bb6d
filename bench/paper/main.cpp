// The paper, reproduced and measured: Evrard, Denner, van Wachem, IEEE TVCG 2019. Writes tables,
// and meshes for pictures; scripts/paper.sh runs it and draws. docs/paper.md says what each part
// measures.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "run.hpp"

namespace difmesh::paper {

void Run::write_csv(const std::string& name, const Table& table) const {
  table.write_csv(file(name + ".csv"));
}

void Run::write_page(const std::string& name, const Table& table) const {
  table.write_markdown(file(name + ".md"));
}

void Run::claim(const std::string& text, const std::string& wanted, const std::string& measured,
                bool holds) {
  claims.push_back({text, wanted, measured, holds});
  std::printf("%s  %s: %s (wanted: %s)\n", holds ? "holds" : "FAILS", text.c_str(),
              measured.c_str(), wanted.c_str());
  std::fflush(stdout);
}

namespace {

struct Part {
  const char* name;
  void (*run)(Run& run);
};

constexpr std::array<Part, 6> kParts{{{"sphere", run_sphere},
                                      {"bodies", run_bodies},
                                      {"phases", run_phases},
                                      {"steps", run_steps},
                                      {"rivals", run_rivals},
                                      {"pictures", run_pictures}}};

std::vector<std::string> part_names() {
  std::vector<std::string> names(kParts.size());
  std::ranges::transform(kParts, names.begin(), &Part::name);
  return names;
}

void add_mesh_body(Run& run, const std::string& path, const std::string& fallback) {
  if (!path.empty()) {
    run.mesh_bodies.push_back(Body::from_file(path, std::filesystem::path(path).stem().string()));
  } else if (std::filesystem::exists(fallback)) {
    run.mesh_bodies.push_back(Body::from_file(fallback, "bunny"));
  } else {
    std::printf("left out: the bunny, as there is no '%s' and no --mesh\n", fallback.c_str());
  }
}

/// \return whether all claims hold
bool run_parts(Run& run) {
  std::filesystem::create_directories(run.out);
  for (const Part& part : kParts) {
    if (run.only.empty() || std::ranges::find(run.only, part.name) != run.only.end()) {
      part.run(run);
    }
  }
  Table table({"claim", "wanted", "measured", "holds"});
  for (const Claim& claim : run.claims) {
    table.add({claim.text, claim.wanted, claim.measured, claim.holds ? "yes" : "no"});
  }
  run.write_csv("claims", table);
  run.write_page("claims", table);
  return std::ranges::all_of(run.claims, &Claim::holds);
}

int main(int argc, char** argv) {
  Run run;
  std::string mesh;
  std::string bunny = DIFMESH_SHARED_DATA "/bunny00_75k.off";
  run.out = "paper-out";
  run.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CLI::App program("Measures what the paper measures. Exit code 1: a claim does not hold.");
  program.add_flag("--short", run.is_short, "Fewer cells, places and ways, some seconds");
  program.add_option("--out", run.out, "Folder for tables and meshes")->option_text("DIR");
  program.add_option("--mesh", mesh, "A closed mesh instead of the bunny")->option_text("FILE");
  program.add_option("--bunny", bunny, "The Stanford bunny, left out where it is missing")
      ->option_text("FILE");
  program.add_option("--threads", run.threads, "Default: as the machine has")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
  program.add_option("--only", run.only, "Parts to run")
      ->check(CLI::IsMember(part_names()))
      ->option_text("PART...");
  CLI11_PARSE(program, argc, argv);
  try {
    add_mesh_body(run, mesh, bunny);
    return run_parts(run) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper: %s\n", error.what());
    return 2;
  }
}

}  // namespace
}  // namespace difmesh::paper

int main(int argc, char** argv) {
  return difmesh::paper::main(argc, argv);
}
