#pragma once
// What a run is asked for, and the parts that it consists of.

#include <filesystem>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "table.hpp"

namespace difmesh::paper {

struct Run {
  bool is_short = false;
  int threads = 1;
  std::filesystem::path out;      ///< folder for results
  std::vector<Body> mesh_bodies;  ///< the bunny, or what was given instead
  std::vector<std::string> only;  ///< parts to run; empty: all
  std::vector<Claim> claims;      ///< what was found so far

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return out / name; }
  /// Writes NAME.csv, for plots and for who wants all digits.
  void write_csv(const std::string& name, const Table& table) const;
  /// Writes NAME.md, for the page.
  void write_page(const std::string& name, const Table& table) const;
  void claim(const std::string& text, const std::string& wanted, const std::string& measured,
             bool holds);
};

/// Figs. 5 and 8: sphere; all ways to a surface, many places.
void run_sphere(Run& run);
/// Figs. 6, 7, 9, 10: the other bodies.
void run_bodies(Run& run);
/// Table 1: time by phase.
void run_phases(Run& run);
/// Table 2: steps of Algorithm 1 from three initial guesses.
void run_steps(Run& run);
/// Fig. 2: meshes of the golf ball, for pictures.
void run_pictures(Run& run);
/// Smoothing and curvature by VTK, and ours beside them.
void run_rivals(Run& run);

}  // namespace difmesh::paper
