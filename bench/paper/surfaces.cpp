#include "surfaces.hpp"

#include <algorithm>

#include "difmesh/mollify.hpp"

namespace difmesh::paper {
namespace {

Options one_thread(Placement placement, Normals normals = Normals::height_function) {
  Options options;
  options.placement = placement;
  options.normals = normals;
  options.threads = 1;
  return options;
}

Way plain(const std::string& name, const Options& options) {
  return {name, [options](const Sample& sample) {
            return reconstruct(sample.field(), sample.grid, options).mesh;
          }};
}

/// E19, Fig. 2c.
Mesh mollified_linear(const Sample& sample) {
  MollifyOptions options;
  options.threads = 1;
  const Array<double> field = mollify(sample.field(), options);
  return reconstruct(FieldView::x_fastest(field.data(), sample.grid.dims), sample.grid,
                     one_thread(Placement::linear))
      .mesh;
}

}  // namespace

std::vector<Way> placements() {
  return {plain("linear", one_thread(Placement::linear)),
          plain("manson", one_thread(Placement::manson)),
          plain("plic", one_thread(Placement::plic))};
}

std::vector<Way> all_ways() {
  std::vector<Way> ways = placements();
  ways.push_back(plain("plic (youngs)", one_thread(Placement::plic, Normals::youngs)));
  ways.push_back(plain("plic (myc)", one_thread(Placement::plic, Normals::myc)));
  ways.push_back({"linear (mollified)", mollified_linear});
  return ways;
}

std::vector<std::string> golf_ball_ways() {
  return {"linear", "linear (mollified)", "manson", "plic"};
}

Way way(const std::string& name) {
  const std::vector<Way> ways = all_ways();
  return *std::ranges::find(ways, name, &Way::name);
}

}  // namespace difmesh::paper
