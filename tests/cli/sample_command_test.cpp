// difmesh sample: fractions of shapes and meshes on the grid that was asked for.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/mesh.hpp"
#include "io/files.hpp"
#include "program.hpp"
#include "support/sphere_overlap.hpp"
#include "support/triangle_meshes.hpp"

namespace {

using difmesh::FieldFile;
using difmesh::Grid;
using difmesh::Index3;
using difmesh::Mesh;
using difmesh::ScalarType;
using difmesh::Vec3;
using difmesh::test::box_field;
using difmesh::test::box_mesh;
using difmesh::test::check_fails;
using difmesh::test::check_succeeds;
using difmesh::test::fact;
using difmesh::test::Outcome;
using difmesh::test::run_program;
using difmesh::test::same_bits;
using difmesh::test::TriangleMesh;
using difmesh::test::write_triangles;
using std::numbers::pi;
using test::TempFolder;
using Words = std::vector<std::string>;

/// A field of float64, x fastest.
struct Sampled {
  Grid grid;
  std::vector<double> fractions;

  [[nodiscard]] double at(const Index3& cell) const {
    return fractions[static_cast<std::size_t>((cell[2] * grid.dims[1] + cell[1]) * grid.dims[0] +
                                              cell[0])];
  }
  [[nodiscard]] double volume() const {
    long double sum = 0.0L;
    for (const double fraction : fractions) {
      sum += fraction;
    }
    return static_cast<double>(sum) * grid.cell_volume();
  }
  /// First and last layer across an axis with more in a cell than rounding puts there.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> filled_layers(std::size_t axis) const {
    std::pair<std::int64_t, std::int64_t> layers{grid.dims[axis], -1};
    test::for_cells(grid.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
      const Index3 cell{i, j, k};
      if (at(cell) > 1e-9) {
        layers.first = std::min(layers.first, cell[axis]);
        layers.second = std::max(layers.second, cell[axis]);
      }
    });
    return layers;
  }
};

Sampled read_sampled(const std::filesystem::path& path) {
  const FieldFile file = difmesh::read_field(path);
  REQUIRE(file.type == ScalarType::float64);
  REQUIRE(file.strides == Index3{1, file.dims[0], file.dims[0] * file.dims[1]});
  const auto* const values = static_cast<const double*>(file.view().data);
  const auto cells = static_cast<std::size_t>(file.grid().cell_count());
  return {file.grid(), {values, values + cells}};
}

struct Place {
  TempFolder folder;
  std::string field = (folder / "field.nrrd").string();

  [[nodiscard]] Outcome run(const std::string& body, const Words& options) const {
    Words arguments{"sample", body, "-o", field};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  [[nodiscard]] Sampled sample(const std::string& body, Words options) const {
    options.emplace_back("--quiet");
    const Outcome outcome = run(body, options);
    check_succeeds(outcome);
    CHECK(outcome.out.empty());
    return read_sampled(field);
  }
  [[nodiscard]] std::string write(const std::string& name, const TriangleMesh& mesh) const {
    return write_triangles(folder / name, mesh).string();
  }
};

Words split_at_blanks(const std::string& text) {
  std::istringstream in(text);
  Words words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

}  // namespace

TEST_CASE("sample gives every cell of a sphere its share in closed form") {
  const Place place;
  const Sampled sphere =
      place.sample("sphere", {"--cells", "26,30,34", "--radius", "1.5", "--centre", "-1,0.5,2.25"});
  CHECK(sphere.grid.dims == Index3{26, 30, 34});
  double largest = 0.0;
  test::for_cells(sphere.grid.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const Vec3 centre = sphere.grid.cell_centre({i, j, k});
    Vec3 low{};
    Vec3 high{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = centre[a] - 0.5 * sphere.grid.spacing[a];
      high[a] = centre[a] + 0.5 * sphere.grid.spacing[a];
    }
    const double share = difmesh::test::sphere_overlap({{-1.0, 0.5, 2.25}, 1.5}, {low, high});
    largest = std::max(largest, std::abs(sphere.at({i, j, k}) - share));
  });
  CHECK(largest < 1e-10);
}

TEST_CASE("sample prints the volume of the fractions and the exact one") {
  const Place place;
  const Outcome outcome = place.run("sphere", {"--cells", "20", "--radius", "2"});
  check_succeeds(outcome);
  const double exact = 4.0 / 3.0 * pi * 8.0;
  CHECK(std::stod(fact(outcome.out, "exact volume")) == doctest::Approx(exact).epsilon(1e-15));
  const double printed = std::stod(fact(outcome.out, "fraction volume"));
  CHECK(printed == doctest::Approx(exact).epsilon(1e-10));
  CHECK(printed == doctest::Approx(read_sampled(place.field).volume()).epsilon(1e-14));
  CHECK(fact(outcome.out, "cells").starts_with("20 x 20 x 20, interfacial: "));
}

TEST_CASE("the box of a shape keeps three cells free on every side") {
  const Place place;
  const Words axes{"--semi-axes", "1.2,0.7,0.45", "--centre", "3,-2,1"};
  const auto sample = [&](Words options) {
    options.insert(options.end(), axes.begin(), axes.end());
    return place.sample("ellipsoid", options);
  };
  const Vec3 half{1.2, 0.7, 0.45};
  const Vec3 centre{3.0, -2.0, 1.0};
  const auto check = [&](const Sampled& field) {
    CHECK(field.volume() == doctest::Approx(4.0 / 3.0 * pi * 1.2 * 0.7 * 0.45).epsilon(1e-9));
    for (std::size_t a = 0; a < 3; ++a) {
      CAPTURE(a);
      const auto [first, last] = field.filled_layers(a);
      CHECK(first >= 3);
      CHECK(first == field.grid.dims[a] - 1 - last);
      const double length = static_cast<double>(field.grid.dims[a]) * field.grid.spacing[a];
      CHECK(field.grid.origin[a] + 0.5 * length == doctest::Approx(centre[a]).epsilon(1e-14));
      const double margin = 0.5 * length - half[a];
      CHECK(margin > 2.999 * field.grid.spacing[a]);
      CHECK(margin < 3.501 * field.grid.spacing[a]);
    }
  };

  const Sampled cubes = sample({"--cells", "30"});
  check(cubes);
  CHECK(cubes.grid.spacing[0] == doctest::Approx(0.1).epsilon(1e-14));
  CHECK(cubes.grid.spacing[1] == cubes.grid.spacing[0]);
  CHECK(cubes.grid.spacing[2] == cubes.grid.spacing[0]);
  CHECK(cubes.grid.dims == Index3{30, 20, 15});

  const Sampled by_axis = sample({"--cells", "30,13,16"});
  check(by_axis);
  CHECK(by_axis.grid.dims == Index3{30, 13, 16});
  CHECK(by_axis.grid.spacing[1] == doctest::Approx(0.2).epsilon(1e-14));
  CHECK(by_axis.grid.spacing[2] == doctest::Approx(0.09).epsilon(1e-14));

  const Sampled by_spacing = sample({"--spacing", "0.15,0.1,0.11"});
  check(by_spacing);
  CHECK(by_spacing.grid.dims == Index3{22, 20, 15});
  CHECK(by_spacing.grid.spacing == Vec3{0.15, 0.1, 0.11});
}

TEST_CASE("an origin cuts off what lies before it") {
  const Place place;
  for (const Words& size : {Words{"--cells", "13"}, Words{"--spacing", "0.1"}}) {
    Words options = size;
    options.insert(options.end(), {"--origin", "0,-0.25,0"});
    const Sampled part = place.sample("sphere", options);
    CHECK(part.grid.origin == Vec3{0.0, -0.25, 0.0});
    // A quarter of the ball without its part beyond y = -0.25, a cap of height 0.75.
    const double cap = pi * 0.75 * 0.75 * (3.0 - 0.75) / 3.0;
    CHECK(part.volume() == doctest::Approx((4.0 / 3.0 * pi - cap) / 4.0).epsilon(1e-9));
    const auto [first, last] = part.filled_layers(0);
    CHECK(first == 0);
    CHECK(last <= part.grid.dims[0] - 4);
  }
}

TEST_CASE("every shape has its volume however it is turned") {
  const Place place;
  const auto volume = [&](const std::string& shape, const Words& options, const char* cells) {
    Words all = options;
    all.insert(all.end(), {"--cells", cells, "--rotation", "20,-35,50"});
    return place.sample(shape, all).volume();
  };
  CHECK(volume("ellipsoid", {"--semi-axes", "1,0.5,0.25"}, "20") ==
        doctest::Approx(4.0 / 3.0 * pi * 0.125).epsilon(1e-9));
  CHECK(volume("torus", {"--radius", "2", "--tube-radius", "0.5"}, "24") ==
        doctest::Approx(2.0 * pi * pi * 2.0 * 0.25).epsilon(1e-9));
  const double box = 8.0 * 0.5 * 0.4 * 0.3 * std::pow(std::tgamma(1.25), 3) / std::tgamma(1.75);
  CHECK(volume("smooth_box", {"--semi-axes", "0.5,0.4,0.3", "--exponent", "4"}, "18") ==
        doctest::Approx(box).epsilon(1e-7));
  CHECK(volume("genus", {"--scale", "2"}, "20") ==
        doctest::Approx(8.0 * volume("genus", {}, "24")).epsilon(1e-6));
  // A dimple takes the cap of the ball over its rim, and as much below the rim as is left of the
  // depth.
  const auto cap = [](double height) { return pi * height * (3.0 * 0.04 + height * height) / 6.0; };
  const double above_rim = 1.0 - std::sqrt(1.0 - 0.04);
  CHECK(volume("golf-ball", {"--dimples", "12", "--dimple-radius", "0.2", "--dimple-depth", "0.05"},
               "16") ==
        doctest::Approx(4.0 / 3.0 * pi - 12.0 * (cap(above_rim) + cap(0.05 - above_rim)))
            .epsilon(1e-6));
}

TEST_CASE("what is printed beside .npy gives the grid back") {
  const Place place;
  const TempFolder& folder = place.folder;
  const std::string npy = (folder / "field.npy").string();
  const Words shape{"--cells", "20", "--centre", "0.3,-7,1e-3"};
  Words arguments{"sample", "ellipsoid", "-o", npy};
  arguments.insert(arguments.end(), shape.begin(), shape.end());
  const Outcome outcome = run_program(arguments);
  check_succeeds(outcome);
  const FieldFile plain = difmesh::read_field(npy);
  CHECK(!plain.origin.has_value());
  CHECK(!plain.spacing.has_value());

  const Grid grid = place.sample("ellipsoid", shape).grid;
  const auto reconstruct = [&](const std::string& field, const Words& options) {
    const std::string mesh = (folder / "mesh.ply").string();
    Words words{"reconstruct", field, "-o", mesh, "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    check_succeeds(run_program(words));
    return difmesh::read_mesh(mesh);
  };
  const Mesh expected = reconstruct(place.field, {});
  REQUIRE(expected.triangles.size() > 500);
  CHECK(same_bits(reconstruct(npy, split_at_blanks(fact(outcome.out, "read it with"))), expected));
  CHECK(split_at_blanks(fact(outcome.out, "spacing")).size() == 3);
  CHECK(std::stod(fact(outcome.out, "origin")) == grid.origin[0]);
}

TEST_CASE("the fractions of a cube from a file are products of lengths") {
  const Place place;
  const Vec3 low{0.1, -0.2, 3.0};
  const Vec3 high{1.15, 0.9, 3.77};
  const std::string cube = place.write("cube.ply", box_mesh(low, high));
  const Sampled sampled = place.sample(cube, {"--cells", "14,12,11", "--threads", "2"});
  const auto expected = box_field(sampled.grid, low, high);
  double largest = 0.0;
  for (std::size_t cell = 0; cell < expected.values.size(); ++cell) {
    largest = std::max(largest, std::abs(sampled.fractions[cell] - expected.values[cell]));
  }
  CHECK(largest < 1e-12);
  CHECK(sampled.filled_layers(1).second >= 7);

  const Outcome outcome = place.run(cube, {"--spacing", "0.25", "--origin", "0.5,-1,2"});
  check_succeeds(outcome);
  const double whole = 1.05 * 1.1 * 0.77;
  CHECK(std::stod(fact(outcome.out, "mesh volume")) == doctest::Approx(whole).epsilon(1e-13));
  CHECK(std::stod(fact(outcome.out, "fraction volume")) ==
        doctest::Approx(whole / 1.05 * 0.65).epsilon(1e-13));
}

TEST_CASE("a mesh that is inside out needs --flip") {
  const Place place;
  const TriangleMesh box = box_mesh({0.0, 0.0, 0.0}, {1.0, 2.0, 1.0});
  const std::string outward = place.write("outward.off", box);
  const std::string inward = place.write("inward.off", box.reversed());
  const Words cells{"--cells", "17"};
  const Words flipped{"--cells", "17", "--flip"};
  check_fails(place.run(inward, cells), 1, {"inward.off", "inside out", "--flip"});
  check_fails(place.run(outward, flipped), 1, {"outward.off", "inside out", "--flip"});
  const Sampled turned = place.sample(inward, flipped);
  const Sampled usual = place.sample(outward, cells);
  REQUIRE(turned.fractions.size() == usual.fractions.size());
  double largest = 0.0;
  for (std::size_t cell = 0; cell < usual.fractions.size(); ++cell) {
    largest = std::max(largest, std::abs(turned.fractions[cell] - usual.fractions[cell]));
  }
  CHECK(largest < 1e-13);
  CHECK(usual.volume() == doctest::Approx(2.0).epsilon(1e-13));
}

TEST_CASE("float32 holds the same fractions rounded") {
  const Place place;
  const Sampled exact = place.sample("torus", {"--cells", "16"});
  check_succeeds(place.run("torus", {"--cells", "16", "--type", "float32", "--quiet"}));
  const FieldFile rounded = difmesh::read_field(place.field);
  REQUIRE(rounded.type == ScalarType::float32);
  REQUIRE(rounded.dims == exact.grid.dims);
  const auto* const values = static_cast<const float*>(rounded.view().data);
  bool same = true;
  for (std::size_t cell = 0; cell < exact.fractions.size(); ++cell) {
    same = same && values[cell] == static_cast<float>(exact.fractions[cell]);
  }
  CHECK(same);
}

TEST_CASE("sample gives the same file for any number of threads") {
  const Place place;
  (void)place.sample("smooth_box", {"--cells", "16", "--threads", "1"});
  const std::string alone = test::read_bytes(place.field);
  (void)place.sample("smooth_box", {"--cells", "16", "--threads", "3"});
  CHECK(test::read_bytes(place.field) == alone);
}

TEST_CASE("sample warns where the grid holds no surface") {
  const Place place;
  const std::string cube = place.write("cube.ply", box_mesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const Outcome aligned = place.run(cube, {"--spacing", "0.25", "--origin", "0"});
  CHECK(aligned.exit_code == 0);
  CHECK(aligned.err == "difmesh: warning: '" + cube + "': no cell is partly filled\n");
  CHECK(read_sampled(place.field).volume() == 1.0);
  check_succeeds(place.run(cube, {"--spacing", "0.3"}));
}

TEST_CASE("sample says what is wrong with its arguments") {
  const Place place;
  struct Wrong {
    std::string body;
    Words options;
    Words words;
  };
  const std::vector<Wrong> cases{
      {"cube", {"--cells", "9"}, {"'cube'", "sphere, ellipsoid, torus", "golf_ball", ".stl"}},
      {"part.step", {"--cells", "9"}, {"'part.step'", ".ply, .obj, .off, .stl"}},
      {"sphere", {}, {"--cells", "--spacing"}},
      {"sphere", {"--cells", "9", "--spacing", "1"}, {"--cells", "--spacing", "together"}},
      {"sphere", {"--cells", "6"}, {"--cells", "'6'", "too few"}},
      {"sphere", {"--cells", "9,9,6"}, {"--cells", "'6'", "too few"}},
      {"sphere", {"--cells", "3", "--origin", "0"}, {"--cells", "'3'", "too few"}},
      {"sphere", {"--cells", "9,9"}, {"--cells", "2 values"}},
      {"sphere", {"--cells", "0"}, {"--cells", "'0'"}},
      {"sphere", {"--spacing", "0"}, {"--spacing", "'0'"}},
      {"sphere", {"--spacing", "1e-12"}, {"--spacing", "1e-12", "too small"}},
      {"sphere", {"--cells", "9", "--origin", "0,1,0"}, {"--origin", "1 along y"}},
      {"sphere", {"--cells", "9", "--flip"}, {"--flip", "meshes"}},
      {"sphere", {"--cells", "9", "--cracks", "0.1"}, {"--cracks", "meshes"}},
      {"part.stl", {"--cells", "9", "--cracks", "0.3"}, {"--cracks", "0.3", "0.25"}},
      {"sphere", {"--cells", "9", "--type", "uint8"}, {"--type", "'uint8'", "float32, float64"}},
      {"sphere", {"--cells", "9", "--exponent", "4"}, {"--exponent", "sphere", "--radius"}},
      {"sphere", {"--cells", "9", "--radius", "-1"}, {"radius", "-1"}},
      {"sphere", {"--cells", "9", "--radius", "big"}, {"--radius", "'big'"}},
      {"torus", {"--cells", "9", "--tube-radius", "2"}, {"tube_radius", "less than"}},
      {"golf_ball", {"--cells", "9", "--dimples", "2.5"}, {"--dimples", "'2.5'"}},
      {"part.stl", {"--cells", "9", "--radius", "2"}, {"--radius", "part.stl"}},
  };
  for (const Wrong& wrong : cases) {
    CAPTURE(wrong.body);
    const Outcome outcome = place.run(wrong.body, wrong.options);
    check_fails(outcome, 2, {});
    for (const std::string& word : wrong.words) {
      CAPTURE(word);
      CAPTURE(outcome.err);
      CHECK(outcome.err.find(word) != std::string::npos);
    }
  }
  check_fails(run_program({"sample", "sphere", "--cells", "9"}), 2, {"--output"});
  check_fails(run_program({"sample", "sphere", "--cells", "9", "-o", "field.vtk"}), 2,
              {"--output", "field.vtk", ".npy, .nrrd"});
  CHECK(place.folder.names().empty());
}

TEST_CASE("sample lets cracks pass that are small enough") {
  const Place place;
  // At a corner a sliver of height 1e-6 is missing between the triangles.
  TriangleMesh torn = box_mesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  torn.positions.push_back({0.0, 0.0, 1.0 - 1e-6});
  torn.triangles[0] = {0, 8, 6};
  const std::string path = place.write("torn.off", torn);
  check_fails(place.run(path, {"--cells", "17"}), 1,
              {"torn.off", "is open", "4 such edges", "j = 3, k = 13", "gap of -1.05e-05 of"});
  check_fails(place.run(path, {"--cells", "17", "--cracks", "1e-9"}), 1,
              {"torn.off", "is open", "column", "tolerance"});
  CHECK(place.sample(path, {"--cells", "17", "--cracks", "1e-3"}).volume() ==
        doctest::Approx(1.0).epsilon(1e-5));
  // Without a sliver, at a T-junction, nothing is missing.
  torn.positions.back()[2] = 0.4;
  torn.triangles.push_back({8, 4, 6});
  const std::string junction = place.write("junction.off", torn);
  check_fails(place.run(junction, {"--cells", "17"}), 1, {"junction.off", "is open"});
  CHECK(place.sample(junction, {"--cells", "17", "--cracks", "1e-9"}).volume() ==
        doctest::Approx(1.0).epsilon(1e-12));
}

TEST_CASE("sample counts parts that overlap once and says where they do") {
  const Place place;
  TriangleMesh plates = box_mesh({0, 0, 0}, {1, 1, 0.02});
  plates.append(box_mesh({0, 0, 0.015}, {1, 1, 0.035}));
  const std::string path = place.write("plates.off", plates);
  for (const char* const cells : {"24", "9", "50,51,60"}) {
    CHECK(place.sample(path, {"--cells", cells}).volume() == doctest::Approx(0.035).epsilon(1e-12));
    CHECK(place.sample(path, {"--cells", cells, "--overlaps", "union"}).volume() ==
          doctest::Approx(0.035).epsilon(1e-12));
    CHECK(place.sample(path, {"--cells", cells, "--overlaps", "count"}).volume() ==
          doctest::Approx(0.04).epsilon(1e-12));
  }
  const Outcome outcome = place.run(path, {"--cells", "24"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("warning: ") != std::string::npos);
  CHECK(outcome.err.find("parts overlap by 0.005 of volume in ") != std::string::npos);
  CHECK(outcome.err.find("it counts once") != std::string::npos);
  std::filesystem::remove(place.field);
  check_fails(place.run(path, {"--cells", "24", "--overlaps", "refuse"}), 1,
              {"plates.off", "parts of the mesh overlap", "cell (3, 3, "});
  CHECK(!std::filesystem::exists(place.field));
  check_fails(place.run(path, {"--cells", "24", "--overlaps", "both"}), 2,
              {"--overlaps", "both", "union, refuse, count"});
  check_fails(place.run("sphere", {"--cells", "24", "--overlaps", "union"}), 2, {"--overlaps"});
  const Outcome clean =
      place.run(place.write("box.off", box_mesh({0, 0, 0}, {1, 1, 0.02})), {"--cells", "24"});
  check_succeeds(clean);
}

TEST_CASE("sample names a mesh that it cannot use") {
  const Place place;
  const TriangleMesh box = box_mesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  TriangleMesh open = box;
  open.triangles.erase(open.triangles.begin() + 2);  // half of the face at x = 1
  const std::string path = place.write("open.off", open);
  check_fails(place.run(path, {"--cells", "12"}), 1,
              {"open.off", "the mesh is open", "edge from vertex 1 at (1, 0, 0)",
               "the column of cells along x at j = 3, k = 3", "gap of 0.5"});
  TriangleMesh mixed = box;
  std::swap(mixed.triangles[7][0], mixed.triangles[7][1]);
  check_fails(place.run(place.write("mixed.off", mixed), {"--cells", "12"}), 1,
              {"mixed.off", "mixed orientation", "triangles", "7", "vertex 2 at (0, 1, 0)"});
  const auto with_text = [&](const std::string& name, const std::string& from,
                             const std::string& to) {
    std::string text = test::read_bytes(place.write("text.off", box));
    const std::size_t at = text.rfind(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    std::filesystem::remove(place.folder / "text.off");
    return place.folder.file(name, text).string();
  };
  check_fails(place.run(with_text("nan.off", "\n1 1 1\n", "\n1 nan 1\n"), {"--cells", "12"}), 1,
              {"nan.off", "line 10", "not finite"});
  check_fails(place.run(with_text("index.off", "3 4 7 6", "3 4 7 8"), {"--cells", "12"}), 1,
              {"index.off", "face 11", "vertex 8 of 8"});
  check_fails(place.run((place.folder / "none.ply").string(), {"--cells", "12"}), 1,
              {"none.ply", "No such file"});
  const std::string empty = place.write("empty.off", {});
  check_fails(place.run(empty, {"--cells", "12"}), 1, {"empty.off", "no triangles"});
  CHECK(place.folder.names() ==
        Words{"empty.off", "index.off", "mixed.off", "nan.off", "open.off"});
}
