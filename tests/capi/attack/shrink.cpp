#include "shrink.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dual_nodes.hpp"
namespace difmesh::attack {
namespace {

// Without the layers [from, to) across an axis.
Specimen without_layers(const Specimen& specimen, std::size_t axis, std::int64_t from,
                        std::int64_t to) {
  Specimen less = specimen;
  less.dims[axis] -= to - from;
  less.values.clear();
  for_each_node({0, 0, 0}, {less.dims[0] - 1, less.dims[1] - 1, less.dims[2] - 1},
                [&](const Index3& node) {
                  Index3 cell = node;
                  cell[axis] += node[axis] >= from ? to - from : 0;
                  less.values.push_back(specimen.values[specimen.element(cell)]);
                });
  std::vector<std::int64_t>& cuts = less.cuts[axis];
  for (std::int64_t& cut : cuts) {
    cut -= std::clamp<std::int64_t>(cut - from, 0, to - from);
  }
  std::erase_if(cuts, [&](std::int64_t cut) { return cut <= 0 || cut >= less.dims[axis]; });
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return less;
}

class Shrinker {
 public:
  Shrinker(const std::function<Finding(const Specimen&)>& attack, const Specimen& specimen,
           const char* kind)
      : attack_(attack), best_(specimen), kind_(kind) {}

  Specimen run() {
    bool better = true;
    for (int round = 0; better && round < 20; ++round) {
      better = drop_layers();
      better = simplify_options() || better;
      better = simplify_values() || better;
    }
    return best_;
  }

 private:
  bool takes(const Specimen& specimen) {
    const Finding finding = attack_(specimen);
    if (finding && std::strcmp(finding.kind, kind_) == 0) {
      best_ = specimen;
      return true;
    }
    return false;
  }
  bool try_change(const std::function<void(Specimen&)>& change) {
    Specimen changed = best_;
    change(changed);
    return dump(changed) != dump(best_) && takes(changed);
  }

  bool drop_layers() {
    bool better = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::int64_t count = best_.dims[axis] / 2; count >= 1; count /= 2) {
        for (std::int64_t from = 0; from + count <= best_.dims[axis] && best_.dims[axis] > count;) {
          if (takes(without_layers(best_, axis, from, from + count))) {
            better = true;
          } else {
            from += count;
          }
        }
      }
    }
    return better;
  }

  bool simplify_options() {
    dif_options defaults;
    (void)dif_options_init(&defaults, sizeof defaults);
    bool better = false;
    const auto simplify = [&](const std::function<void(Specimen&)>& change) {
      better = try_change(change) || better;
    };
    for (std::size_t a = 0; a < 3; ++a) {
      simplify([&](Specimen& s) { s.cuts[a].clear(); });
      simplify([&](Specimen& s) { s.origin[a] = 0.0; });
      simplify([&](Specimen& s) { s.spacing[a] = 1.0; });
      simplify([&](Specimen& s) { s.gaps[a] = 1; });
      simplify([&](Specimen& s) {
        s.options.boundary[2 * a] = DIF_SIDE_OPEN;
        s.options.boundary[2 * a + 1] = DIF_SIDE_OPEN;
      });
    }
    simplify([&](Specimen& s) { s.memory_order = {0, 1, 2}; });
    simplify([&](Specimen& s) { s.options.purity_tolerance = defaults.purity_tolerance; });
    simplify([&](Specimen& s) { s.options.overshoot_bound = defaults.overshoot_bound; });
    simplify([&](Specimen& s) { s.options.clearance = defaults.clearance; });
    simplify([&](Specimen& s) { s.options.placement = DIF_PLACEMENT_PLIC; });
    simplify([&](Specimen& s) { s.options.normals = DIF_NORMALS_HEIGHT_FUNCTION; });
    simplify([&](Specimen& s) { s.options.normals = DIF_NORMALS_YOUNGS; });
    simplify([&](Specimen& s) { s.more_ghosts = 0; });
    simplify([&](Specimen& s) { s.other_threads = 1; });
    simplify([&](Specimen& s) { s.variants = 0; });
    if (best_.type == DIF_FLOAT32) {
      simplify([&](Specimen& s) { s.type = DIF_FLOAT64; });
    }
    return better;
  }

  bool simplify_values() {
    const double largest =
        best_.type == DIF_UINT8 ? 255.0 : (best_.type == DIF_UINT16 ? 65535.0 : 1.0);
    bool better = false;
    for (std::size_t n = 0; n < best_.values.size(); ++n) {
      const double now = best_.values[n];
      for (const double value : {0.0, largest, std::round(0.25 * largest * 100.0) / 100.0,
                                 std::round(0.75 * largest * 100.0) / 100.0}) {
        if (now == value) {
          break;
        }
        if (try_change([&](Specimen& s) { s.values[n] = value; })) {
          better = true;
          break;
        }
      }
    }
    return better;
  }

  const std::function<Finding(const Specimen&)>& attack_;
  Specimen best_;
  const char* kind_;
};

}  // namespace

Specimen shrunk(const std::function<Finding(const Specimen&)>& attack, const Specimen& specimen,
                const char* kind) {
  return Shrinker(attack, specimen, kind).run();
}

}  // namespace difmesh::attack
