// Do the judges bite? Surfaces that are right are broken by hand, each in a way of its own.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "judge.hpp"
#include "specimen.hpp"
#include "trial.hpp"

using namespace difmesh::attack;

namespace {

// The arrays of a surface, to be changed.
struct Arrays {
  std::vector<double> positions;
  std::vector<double> normals;
  std::vector<std::uint64_t> ids;
  std::vector<std::uint32_t> triangles;
  dif_report report{};

  explicit Arrays(const Trial& trial) : report(trial.report()) {
    const Surface surface = surface_of(trial.mesh());
    positions.assign(surface.positions.begin(), surface.positions.end());
    normals.assign(surface.normals.begin(), surface.normals.end());
    ids.assign(surface.ids.begin(), surface.ids.end());
    triangles.assign(surface.triangles.begin(), surface.triangles.end());
  }
  [[nodiscard]] Surface view() const { return {positions, normals, ids, triangles}; }
  [[nodiscard]] double& along(std::size_t vertex) {
    return positions[3 * vertex + ids[vertex] % 3];
  }
};

// A specimen of plain options; values as in a C array [nz][ny][nx].
Specimen plain(const Index3& dims, std::vector<double> values) {
  Specimen specimen;
  specimen.dims = dims;
  specimen.values = std::move(values);
  REQUIRE(dif_options_init(&specimen.options, sizeof specimen.options) == DIF_OK);
  specimen.options.vertex_normals = 1;
  specimen.options.edge_ids = 1;
  specimen.variants = kWithoutGaps | kWithoutNormals | kMeasured | kWithProgress | kOpenFaces;
  return specimen;
}

// Half a ball on an empty ground: closed, with faces between cells that are ambiguous.
Specimen closed_specimen() {
  Specimen specimen = plain({3, 3, 2}, {0.0, 0.6, 0.0, 0.7, 1.0, 0.2, 0.0, 0.3, 0.9,  //
                                        0.8, 0.1, 0.0, 0.1, 0.4, 0.7, 0.0, 0.9, 0.0});
  std::fill_n(specimen.options.boundary, 6, DIF_SIDE_EMPTY);
  specimen.origin = {-3.0, 10.0, 0.5};
  specimen.spacing = {0.5, 2.0, 1.0};
  return specimen;
}

struct Broken {
  const char* kind;
  void (*change)(Arrays&);
};

constexpr Broken kBroken[] = {
    {"a position that is not finite",
     [](Arrays& a) { a.along(3) = std::numeric_limits<double>::quiet_NaN(); }},
    {"a position that is not finite",
     [](Arrays& a) { a.positions[0] = std::numeric_limits<double>::infinity(); }},
    {"a vertex beside its edge",
     [](Arrays& a) {
       double& across = a.positions[(a.ids[0] % 3 + 1) % 3];
       across = std::nextafter(across, 1e9);
     }},
    {"a vertex not strictly inside its edge", [](Arrays& a) { a.along(5) -= 2.0; }},
    {"a vertex not strictly inside its edge", [](Arrays& a) { a.along(5) += 2.0; }},
    {"a normal that is no unit vector", [](Arrays& a) { a.normals[4] += 0.01; }},
    {"arrays of different lengths", [](Arrays& a) { a.normals.pop_back(); }},
    {"edge ids do not ascend", [](Arrays& a) { std::swap(a.ids[1], a.ids[2]); }},
    {"an edge that does not exist", [](Arrays& a) { a.ids.back() = 3 * 5 * 5 * 4; }},
    {"an index out of range",
     [](Arrays& a) { a.triangles[7] = static_cast<std::uint32_t>(a.ids.size()); }},
    {"a crossed edge without vertex",
     [](Arrays& a) {
       a.ids.pop_back();
       a.positions.resize(3 * a.ids.size());
       a.normals.resize(3 * a.ids.size());
       std::erase(a.triangles, static_cast<std::uint32_t>(a.ids.size()));
       a.triangles.resize(a.triangles.size() / 3 * 3);
     }},
    {"triangles whose border does not part inside from outside",
     [](Arrays& a) {
       for (std::size_t t = 0; t < a.triangles.size(); t += 3) {  // inside out
         std::swap(a.triangles[t], a.triangles[t + 1]);
       }
     }},
    {"triangles whose border does not part inside from outside",
     [](Arrays& a) { a.triangles.resize(a.triangles.size() - 3); }},
    {"a directed edge twice in a dual cell",
     [](Arrays& a) { a.triangles.insert(a.triangles.end(), &a.triangles[0], &a.triangles[3]); }},
    {"a report that is not of this field", [](Arrays& a) { ++a.report.interfacial_cells; }},
    {"a report that is not of this field", [](Arrays& a) { a.report.fraction_volume *= 1.0001; }},
    {"closed or not", [](Arrays& a) { a.report.closed = 0; }},
    {"an enclosed volume that is not that of the triangles",
     [](Arrays& a) { a.report.enclosed_volume *= 1.0001; }},
};

}  // namespace

TEST_CASE("attack: the judge finds what is broken by hand") {
  const Specimen specimen = closed_specimen();
  Trial trial;
  const Finding none = trial.run(specimen);
  INFO(none.detail);
  REQUIRE(none.kind == nullptr);
  REQUIRE(trial.report().closed == 1);
  Judge judge;
  for (const Broken& broken : kBroken) {
    CAPTURE(broken.kind);
    Arrays arrays(trial);
    REQUIRE(judge.check(specimen, arrays.view(), arrays.report).kind == nullptr);
    broken.change(arrays);
    const Finding finding = judge.check(specimen, arrays.view(), arrays.report);
    REQUIRE(finding.kind != nullptr);
    CHECK(std::string(finding.kind) == broken.kind);
  }
}

TEST_CASE("attack: the judge knows whether a face is joined or separated") {
  // Two cells that touch along an edge: apart where their mean with the empty ones is below 1/2.
  for (const double value : {0.99, 0.9}) {
    for (const double other : {0.3, 0.05}) {
      Specimen specimen = plain({2, 2, 1}, {value, other, other, value});
      std::fill_n(specimen.options.boundary, 6, DIF_SIDE_EMPTY);
      Trial trial;
      REQUIRE(trial.run(specimen).kind == nullptr);
      dif_measure measure{};
      REQUIRE(dif_measure_init(&measure, sizeof measure) == DIF_OK);
      REQUIRE(dif_mesh_measure(trial.mesh(), &measure) == DIF_OK);
      CHECK(measure.components == (value + other >= 1.0 ? 1 : 2));
      // Held against the field with the other mean, the same surface is wrong.
      const Surface surface = surface_of(trial.mesh());
      const bool joined = measure.components == 1;
      for (double& each : specimen.values) {
        each = each > 0.5 ? (joined ? 0.6 : 0.99) : (joined ? 0.1 : 0.3);
      }
      Judge judge;
      const Finding finding = judge.check(specimen, surface, trial.report());
      REQUIRE(finding.kind != nullptr);
      CHECK(std::string(finding.kind) ==
            "an ambiguous face settled against the mean of its fractions");
    }
  }
}

TEST_CASE("attack: differences of single bits are found in every array") {
  Trial trial;
  REQUIRE(trial.run(closed_specimen()).kind == nullptr);
  const Arrays whole(trial);
  CHECK(difference(whole.view(), whole.view(), "other").kind == nullptr);
  Arrays other = whole;
  other.positions[7] = std::nextafter(other.positions[7], 1e9);
  CHECK(difference(whole.view(), other.view(), "other").kind != nullptr);
  other = whole;
  other.normals[7] = std::nextafter(other.normals[7], 2.0);
  CHECK(difference(whole.view(), other.view(), "other").kind != nullptr);
  other = whole;
  std::swap(other.triangles[0], other.triangles[1]);
  CHECK(difference(whole.view(), other.view(), "other").kind != nullptr);
  other = whole;
  ++other.ids.back();
  CHECK(difference(whole.view(), other.view(), "other").kind != nullptr);
  other = whole;
  other.normals.clear();
  CHECK(difference(whole.view(), other.view(), "other").kind != nullptr);
}

TEST_CASE("attack: the specimens are of all kinds") {
  std::set<std::int32_t> placements;
  std::set<std::int32_t> normals;
  std::set<std::int32_t> sides[6];
  std::set<std::int32_t> types;
  std::set<std::int64_t> dims;
  int near_half = 0;
  int cut = 0;
  int far = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const Specimen specimen = make_specimen(seed);
    placements.insert(specimen.options.placement);
    normals.insert(specimen.options.normals);
    types.insert(specimen.type);
    for (std::size_t side = 0; side < 6; ++side) {
      sides[side].insert(specimen.options.boundary[side]);
    }
    dims.insert(specimen.dims.begin(), specimen.dims.end());
    cut += specimen.cuts[0].size() + specimen.cuts[1].size() + specimen.cuts[2].size() > 0 ? 1 : 0;
    far += std::abs(specimen.origin[1]) > 1e10 ? 1 : 0;
    near_half += std::any_of(specimen.values.begin(), specimen.values.end(), [](double value) {
      return value == std::nextafter(0.5, 0.0) || value == std::nextafter(0.5, 1.0);
    });
    CHECK(dump(specimen) == dump(make_specimen(seed)));
  }
  CHECK(placements.size() == 6);
  CHECK(normals.size() == 6);
  CHECK(types.size() == 4);
  for (const std::set<std::int32_t>& side : sides) {
    CHECK(side.size() == 6);
  }
  CHECK(dims.size() >= 18);  // 1 to 9 and long ones
  CHECK(near_half > 50);
  CHECK(cut > 500);
  CHECK(far > 20);
}

// Fields on which the library once went wrong, made small.
TEST_CASE("attack: what once went wrong") {
  Trial trial;
  const auto check = [&](const Specimen& specimen) {
    INFO(dump(specimen));
    const Finding finding = trial.run(specimen);
    INFO(finding.detail);
    CHECK(std::string(finding ? finding.kind : "") == "");
  };
  const double below_half = std::nextafter(0.5, 0.0);
  SUBCASE("positions that were no numbers") {
    check(plain({2, 2, 1}, {0.0, 0.5, below_half, 0.5}));
    check(plain({1, 2, 2}, {0.0, 1.0 - 1e-6, 1.0, below_half}));
    check(plain({3, 2, 1}, {0.0, 0.0, 0.0, 0.0, below_half, 0.75}));
  }
  SUBCASE("blocks that were not the whole") {
    Specimen specimen =
        plain({1, 3, 2}, {1e-6, 0.5, 1e-6, 0.499999999999999, 1e-6, 0.499999999999999});
    specimen.cuts[2] = {1};
    for (const double tolerance : {1e-6, 0.1}) {
      specimen.options.purity_tolerance = tolerance;
      check(specimen);
    }
    specimen = plain({2, 2, 1}, {1.0, 0.75, 1.0, 0.95});
    specimen.options.boundary[2] = DIF_SIDE_FULL;
    specimen.options.boundary[3] = DIF_SIDE_EMPTY;
    specimen.options.purity_tolerance = 0.05;
    specimen.options.normals = DIF_NORMALS_YOUNGS;
    specimen.cuts[1] = {1};
    check(specimen);
    specimen = plain({1, 1, 2}, {0.25, 1e-300});
    specimen.options.boundary[2] = DIF_SIDE_EMPTY;
    specimen.options.boundary[5] = DIF_SIDE_FULL;
    specimen.options.normals = DIF_NORMALS_YOUNGS;
    specimen.cuts[2] = {1};
    check(specimen);
  }
}
