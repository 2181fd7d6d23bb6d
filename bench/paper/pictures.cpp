// Meshes to be drawn by pictures.mjs, and the sheets that they are drawn on.

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "difmesh/curvature.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "errors.hpp"
#include "run.hpp"
#include "surfaces.hpp"

namespace difmesh::paper {
namespace {

using Json = nlohmann::json;

/// Surfaces on a common scale of colours.
struct Sheet {
  std::string name;
  Body body;
  double cells = 0.0;
  std::vector<std::string> ways;
  std::string color;   ///< scalars to colour by; empty: none
  double range = 0.0;  ///< of the colours, on both sides of 0
  std::string range_text;
  double zoom = 1.0;
  bool raking = false;  ///< light from the side
};

/// Distance from the body and error of the mean curvature, in the body's size.
std::vector<VertexScalar> scalars_of(const Body& body, const Mesh& mesh) {
  const std::vector<double> distances = vertex_distances(body, mesh);
  const Curvature fitted = curvature(mesh);
  VertexScalar distance{"distance", {}};
  VertexScalar error{"curvature_error", {}};
  for (std::size_t v = 0; v < distances.size(); ++v) {
    distance.values.push_back(distances[v] / body.size);
    if (const auto exact = exact_curvatures(body, mesh.positions[v], distances[v])) {
      error.values.push_back((fitted.mean[v] - exact->mean) * body.size);
    }
  }
  std::vector<VertexScalar> all{std::move(distance)};
  if (error.values.size() == distances.size()) {
    all.push_back(std::move(error));
  }
  return all;
}

/// Writes the meshes of a sheet. \return what pictures.mjs has to know
Json draw(const Run& run, const std::filesystem::path& folder, const Sheet& sheet) {
  constexpr int kSize = 300;
  const Sample at = sample(sheet.body, sheet.cells, 0, run.threads);
  Json panels = Json::array();
  for (const std::string& name : sheet.ways) {
    const std::string file = sheet.name + "_" + std::to_string(panels.size()) + ".glb";
    Mesh mesh = way(name).surface(at);
    mesh.scalars = scalars_of(sheet.body, mesh);
    (void)write_mesh(folder / file, mesh);
    panels.push_back({{"file", file},
                      {"caption", name + (sheet.color.empty() ? "" : ", " + sheet.range_text)},
                      {"color", sheet.color},
                      {"range", sheet.range}});
  }
  return {{"name", sheet.name},
          {"panels", panels},
          {"columns", 3},
          {"view",
           {{"size", kSize},
            {"zoom", sheet.zoom},
            {"raking", sheet.raking},
            {"from", {0.5, 0.35, 0.8}}}}};
}

std::vector<Sheet> sheets(const Run& run) {
  const std::vector<std::string> three{"linear", "manson", "plic"};
  std::vector<Sheet> all{
      {"golf_ball", Body::golf_ball(), 150.0, golf_ball_ways(), "", 0.0, "", 2.2, true},
      {"sphere_distances", Body::sphere(), 64.0, three, "distance", 5e-5, "±5e-5 R", 1.6, false},
      {"genus_distances", Body::genus(), 75.0, three, "distance", 4.2e-4, "±4.2e-4 D", 1.25, false},
      {"sphere_curvatures", Body::sphere(), 50.0, three, "curvature_error", 0.1, "±0.1 / R", 1.6,
       false},
      {"genus_curvatures", Body::genus(), 75.0, three, "curvature_error", 2.0, "±2 / D", 1.25,
       false},
  };
  for (const Body& body : run.mesh_bodies) {
    all.push_back({body.name + "_distances", body, 100.0, three, "distance", 5.2e-4, "±5.2e-4 D",
                   1.4, false});
  }
  return all;
}

}  // namespace

void run_pictures(Run& run) {
  const std::filesystem::path folder = run.out / "pictures";
  std::filesystem::create_directories(folder);
  Json all = Json::array();
  for (Sheet sheet : sheets(run)) {
    std::fprintf(stderr, "paper: meshes for %s\n", sheet.name.c_str());
    sheet.cells = run.is_short ? 0.3 * sheet.cells : sheet.cells;
    all.push_back(draw(run, folder, sheet));
  }
  std::ofstream out(folder / "sheets.json");
  out << all.dump(1) << '\n';
  if (!out.flush()) {
    throw std::runtime_error("cannot write '" + (folder / "sheets.json").string() + "'");
  }
}

}  // namespace difmesh::paper
