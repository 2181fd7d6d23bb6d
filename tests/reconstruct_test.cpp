#include "difmesh/reconstruct.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/measure.hpp"
#include "support/dual_edges.hpp"
#include "support/fields.hpp"
#include "support/near_pure.hpp"

using namespace difmesh;
using difmesh::test::blob;
using difmesh::test::OwnedField;
using difmesh::test::same_bits;
using difmesh::test::white_noise;

namespace {

Options with_sides(Side side) {
  Options options;
  options.boundary.fill(side);
  return options;
}

Grid unit_grid(const Index3& dims) {
  return {dims, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
}

// The error of a call, as "code: message".
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::to_string(static_cast<int>(error.code())) + ": " + error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string reconstruct_error(const OwnedField& field, const Grid& grid,
                              const Options& options = {}) {
  return error_of([&] { (void)reconstruct(field.view(), grid, options); });
}

// Positions by the name of their edge.
std::map<std::uint64_t, Vec3> by_edge(const Mesh& mesh) {
  std::map<std::uint64_t, Vec3> result;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    result[mesh.edge_ids[n]] = mesh.positions[n];
  }
  return result;
}

// Whether each vertex lies strictly between the ends of its dual edge, whose nodes -1 and n lie on
// open domain faces.
bool are_within_edges(const Mesh& mesh, const Grid& grid) {
  return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3& position) {
    const auto n = static_cast<std::size_t>(&position - mesh.positions.data());
    const test::DualEdge edge = test::dual_edge(mesh.edge_ids[n], grid.dims);
    bool is_within = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto node = [&](std::int64_t index) {
        const double place = static_cast<double>(index) + 0.5;
        return grid.origin[a] +
               std::clamp(place, 0.0, static_cast<double>(grid.dims[a])) * grid.spacing[a];
      };
      const std::int64_t low = edge.node[a];
      is_within =
          is_within && (a == edge.axis ? position[a] > node(low) && position[a] < node(low + 1)
                                       : position[a] == node(low));
    }
    return is_within;
  });
}

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST_SUITE("reconstruct: bad input is named") {
  TEST_CASE("grid") {
    const OwnedField field({4, 4, 4});
    Grid grid = unit_grid({4, 4, 4});
    grid.dims[1] = 0;
    CHECK(contains(reconstruct_error(field, grid), "11: dims: 0 cells in y"));
    grid = unit_grid({4, 4, 4});
    grid.spacing[2] = 0.0;
    CHECK(contains(reconstruct_error(field, grid), "11: spacing in z"));
    grid.spacing[2] = -1.0;
    CHECK(contains(reconstruct_error(field, grid), "11: spacing in z"));
    grid.spacing[2] = std::nan("");
    CHECK(contains(reconstruct_error(field, grid), "11: spacing in z is nan"));
    grid = unit_grid({4, 4, 4});
    grid.origin[0] = std::numeric_limits<double>::infinity();
    CHECK(contains(reconstruct_error(field, grid), "11: origin in x is not finite"));
    grid.origin[0] = 1e15;
    CHECK(contains(reconstruct_error(field, grid), "11: spacing in x"));
  }

  TEST_CASE("sizes beyond 63 bits") {
    const std::int64_t most = (std::int64_t{1} << 31) - 3;
    CHECK(contains(error_of([&] {
                     validate(unit_grid({most, most, 2}));
                   }),
                   "20: dims: 2147483645"));
    CHECK(error_of([&] { validate(unit_grid({most, 1, 1})); }) == "no error");
    // 2^20 cells each way are 2^60: three ids per node still fit below 2^63.
    const std::int64_t large = std::int64_t{1} << 20;
    CHECK(error_of([&] { validate(unit_grid({large, large, large})); }) == "no error");
    CHECK(contains(error_of([&] { validate(unit_grid({most + 1, 1, 1})); }), "11: dims"));
  }

  TEST_CASE("field") {
    const OwnedField field({4, 4, 4});
    CHECK(contains(reconstruct_error(field, unit_grid({4, 5, 4})), "10: field: 4 cells in y"));
    const FieldView none(nullptr, ScalarType::float64, {4, 4, 4}, {1, 4, 16});
    CHECK(contains(error_of([&] {
                     (void)reconstruct(none, unit_grid({4, 4, 4}));
                   }),
                   "10: field: no data"));
    CHECK(contains(error_of([&] {
                     (void)field.view().sub({2, 0, 0}, {3, 4, 4});
                   }),
                   "10: sub-view"));
  }

  TEST_CASE("values") {
    OwnedField field({70, 5, 4}, 0.25);
    const Grid grid = unit_grid(field.dims);
    field.at(69, 3, 2) = std::nan("");
    field.at(68, 4, 2) = -std::numeric_limits<double>::infinity();
    CHECK(contains(reconstruct_error(field, grid), "12: cell (69, 3, 2) holds nan"));
    field.at(69, 3, 2) = 0.0;
    CHECK(contains(reconstruct_error(field, grid), "12: cell (68, 4, 2) holds -inf"));
    field.at(68, 4, 2) = 1.1 + 1e-9;
    CHECK(contains(reconstruct_error(field, grid), "12: cell (68, 4, 2) holds 1.1"));
    field.at(3, 0, 0) = -0.11;
    CHECK(contains(reconstruct_error(field, grid), "12: cell (3, 0, 0) holds -0.11"));
    Options wide;
    wide.overshoot_bound = 0.2;
    CHECK(reconstruct_error(field, grid, wide) == "no error");
    // The bound itself is allowed.
    Options exact;
    exact.overshoot_bound = 0.25;
    field.at(68, 4, 2) = 1.25;
    field.at(3, 0, 0) = -0.25;
    CHECK(reconstruct_error(field, grid, exact) == "no error");
    field.at(3, 0, 0) = std::nextafter(-0.25, -1.0);
    CHECK(contains(reconstruct_error(field, grid, exact), "12: cell (3, 0, 0) holds -0.25"));
  }

  TEST_CASE("options") {
    const OwnedField field({4, 4, 4});
    const Grid grid = unit_grid(field.dims);
    Options options;
    options.boundary[2] = Side::periodic;
    CHECK(
        contains(reconstruct_error(field, grid, options), "10: options: boundary in y: periodic"));
    options = {};
    options.threads = -1;
    CHECK(contains(reconstruct_error(field, grid, options), "10: options: threads"));
    options = {};
    options.purity_tolerance = std::nan("");
    CHECK(contains(reconstruct_error(field, grid, options), "10: options: purity_tolerance"));
    options = {};
    options.clearance = 0.0;
    CHECK(contains(reconstruct_error(field, grid, options), "10: options: clearance"));
  }
}

TEST_SUITE("reconstruct: layouts and types") {
  TEST_CASE("any strides give the same bits") {
    const Index3 dims{19, 17, 23};
    const OwnedField field = blob(dims);
    const Grid grid{dims, {1.0, -2.0, 0.5}, {0.1, 0.2, 0.3}};
    const Mesh mesh = reconstruct(field.view(), grid).mesh;
    REQUIRE(mesh.positions.size() > 500);

    // Inside a larger array, z fastest, every other element, x and y backwards.
    const Index3 step{-2 * (dims[1] + 3) * (dims[2] + 2), -2 * (dims[2] + 2), 2};
    std::vector<double> larger(static_cast<std::size_t>(-step[0] * (dims[0] + 1)), std::nan(""));
    double* first = larger.data() - (dims[0] - 1) * step[0] - (dims[1] - 1) * step[1] + 5;
    for (std::int64_t k = 0; k < dims[2]; ++k) {
      for (std::int64_t j = 0; j < dims[1]; ++j) {
        for (std::int64_t i = 0; i < dims[0]; ++i) {
          first[i * step[0] + j * step[1] + k * step[2]] =
              field.values[test::element({i, j, k}, dims)];
        }
      }
    }
    const FieldView odd(first, ScalarType::float64, dims, step);
    CHECK(same_bits(reconstruct(odd, grid).mesh, mesh));
  }

  TEST_CASE("a sub-view is the field of its cells") {
    const OwnedField field = white_noise({12, 11, 10}, 3);
    const Index3 low{3, 2, 1};
    const Index3 dims{7, 8, 6};
    OwnedField part(dims);
    for (std::int64_t k = 0; k < dims[2]; ++k) {
      for (std::int64_t j = 0; j < dims[1]; ++j) {
        for (std::int64_t i = 0; i < dims[0]; ++i) {
          part.at(i, j, k) =
              field.values[test::element({i + low[0], j + low[1], k + low[2]}, field.dims)];
        }
      }
    }
    CHECK(same_bits(reconstruct(field.view().sub(low, dims), unit_grid(dims)).mesh,
                    reconstruct(part.view(), unit_grid(dims)).mesh));
  }

  TEST_CASE_TEMPLATE("integers are shares of their largest value", T, std::uint8_t, std::uint16_t) {
    const Index3 dims{20, 18, 16};
    OwnedField field = blob(dims);
    std::vector<T> integers;
    constexpr double kMost = std::numeric_limits<T>::max();
    for (double& value : field.values) {
      integers.push_back(static_cast<T>(std::lround(value * kMost)));
      value = static_cast<double>(integers.back()) / kMost;
    }
    const Grid grid = unit_grid(dims);
    const Reconstruction exact = reconstruct(field.view(), grid);
    const Reconstruction scaled = reconstruct(FieldView::x_fastest(integers.data(), dims), grid);
    CHECK(same_bits(scaled.mesh, exact.mesh));
    CHECK(scaled.report.fraction_volume == exact.report.fraction_volume);
    CHECK(scaled.report.interfacial_cells == exact.report.interfacial_cells);
  }

  TEST_CASE("float32 is float64 rounded") {
    const Index3 dims{70, 13, 12};
    OwnedField field = white_noise(dims, 5);
    std::vector<float> narrow;
    for (double& value : field.values) {
      narrow.push_back(static_cast<float>(value));
      value = static_cast<double>(narrow.back());
    }
    CHECK(same_bits(reconstruct(FieldView::x_fastest(narrow.data(), dims), unit_grid(dims)).mesh,
                    reconstruct(field.view(), unit_grid(dims)).mesh));
  }
}

TEST_SUITE("reconstruct: running") {
  TEST_CASE("the mesh does not depend on the number of threads") {
    const OwnedField fields[] = {blob({60, 50, 40}), white_noise({33, 21, 27}, 8)};
    for (const OwnedField& field : fields) {
      Options options;
      options.vertex_normals = true;
      options.edge_ids = true;
      options.threads = 1;
      const Reconstruction serial = reconstruct(field.view(), unit_grid(field.dims), options);
      for (const int threads : {2, 3, 7, 0}) {
        options.threads = threads;
        const Reconstruction parallel = reconstruct(field.view(), unit_grid(field.dims), options);
        CHECK(same_bits(parallel.mesh, serial.mesh));
        CHECK(parallel.report.fraction_volume == serial.report.fraction_volume);
        CHECK(parallel.report.enclosed_volume == serial.report.enclosed_volume);
        CHECK(parallel.report.newton_steps_mean == serial.report.newton_steps_mean);
      }
    }
  }

  TEST_CASE("progress rises to 1 on the calling thread and changes nothing") {
    const OwnedField field = blob({50, 50, 50});
    const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims)).mesh;
    const auto caller = std::this_thread::get_id();
    std::vector<double> shares;
    bool elsewhere = false;
    Options options;
    options.progress = [&](double share) {
      elsewhere = elsewhere || std::this_thread::get_id() != caller;
      shares.push_back(share);
      return true;
    };
    CHECK(same_bits(reconstruct(field.view(), unit_grid(field.dims), options).mesh, mesh));
    CHECK_FALSE(elsewhere);
    REQUIRE(shares.size() >= 20);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.front() < 0.1);
    CHECK(shares.back() == 1.0);
    double largest = 0.0;
    for (std::size_t n = 1; n < shares.size(); ++n) {
      largest = std::max(largest, shares[n] - shares[n - 1]);
    }
    CHECK(largest < 0.11);
  }

  TEST_CASE("the callback cancels and its exceptions pass through") {
    const OwnedField field = blob({40, 40, 40});
    for (const int calls : {1, 10, 30}) {
      int left = calls;
      Options options;
      options.progress = [&](double) { return --left > 0; };
      CHECK(contains(reconstruct_error(field, unit_grid(field.dims), options), "30: cancelled"));
      CHECK(left == 0);
    }
    Options options;
    options.progress = [](double) -> bool { throw 42; };
    CHECK_THROWS_AS((void)reconstruct(field.view(), unit_grid(field.dims), options), int);
  }
}

TEST_SUITE("reconstruct: fields without much in them") {
  TEST_CASE("empty and full fields have no surface unless a side makes one") {
    for (const double value : {0.0, 1.0}) {
      const OwnedField field({5, 6, 7}, value);
      for (const Side side : {Side::open, Side::mirror, Side::periodic, Side::empty, Side::full}) {
        const Reconstruction result =
            reconstruct(field.view(), unit_grid(field.dims), with_sides(side));
        const bool surface =
            (side == Side::empty && value == 1.0) || (side == Side::full && value == 0.0);
        CHECK(result.mesh.triangles.empty() == !surface);
        CHECK(result.report.closed);
        if (surface) {
          // The whole domain, but for the corners and edges that triangles cut off.
          CHECK(std::abs(std::abs(result.report.enclosed_volume) - 210.0) < 210.0 - 4 * 5 * 6);
          CHECK((result.report.enclosed_volume > 0.0) == (value == 1.0));
          const Measure facts = measure(result.mesh);
          CHECK(facts.euler_number == 2);
          CHECK(facts.low == Vec3{0.0, 0.0, 0.0});
          CHECK(facts.high == Vec3{5.0, 6.0, 7.0});
        }
      }
    }
  }

  TEST_CASE("one cell") {
    OwnedField field({1, 1, 1}, 0.7);
    const Reconstruction closed =
        reconstruct(field.view(), unit_grid(field.dims), with_sides(Side::empty));
    // No gradient: along each edge the material is a layer, which ends gamma - 1/2 from the centre.
    REQUIRE(closed.mesh.positions.size() == 6);
    CHECK(closed.report.gradient_free_cells == 1);
    for (const Vec3& p : closed.mesh.positions) {
      CHECK(distance(p, {0.5, 0.5, 0.5}) == doctest::Approx(0.2).epsilon(1e-13));
    }
    CHECK(closed.report.enclosed_volume == doctest::Approx(4.0 / 3.0 * 0.008).epsilon(1e-12));
    CHECK(reconstruct(field.view(), unit_grid(field.dims)).mesh.triangles.empty());
  }

  TEST_CASE("a film symmetric about its cells lies where its edges say") {
    for (const std::size_t axis : {0U, 1U, 2U}) {
      OwnedField field({7, 7, 7});
      for (std::int64_t n = 0; n < 343; ++n) {
        const Index3 cell{n % 7, n / 7 % 7, n / 49};
        field.values[static_cast<std::size_t>(n)] = cell[axis] == 3 ? 0.8 : 0.0;
      }
      const Reconstruction film = reconstruct(field.view(), unit_grid(field.dims));
      CHECK(film.mesh.positions.size() == 2 * 81);
      CHECK(film.report.gradient_free_cells == 49);
      for (const Vec3& p : film.mesh.positions) {
        CHECK(std::abs(std::abs(p[axis] - 3.5) - 0.3) < 1e-13);
      }
    }
  }

  TEST_CASE("domains one cell thick keep a prism's area") {
    // A disk in x and y, one cell in z: the surface is a cylinder's wall through both open sides.
    const Index3 dims{24, 24, 1};
    OwnedField field(dims);
    for (std::int64_t j = 0; j < 24; ++j) {
      for (std::int64_t i = 0; i < 24; ++i) {
        double inside = 0.0;
        for (int s = 0; s < 64 * 64; ++s) {
          const double x = static_cast<double>(i) + (s % 64 + 0.5) / 64.0 - 12.2;
          const double y = static_cast<double>(j) + (s / 64 + 0.5) / 64.0 - 11.9;
          inside += x * x + y * y < 64.0 ? 1.0 : 0.0;
        }
        field.at(i, j, 0) = inside / 4096.0;
      }
    }
    const Reconstruction wall = reconstruct(field.view(), unit_grid(dims));
    const Measure facts = measure(wall.mesh);
    CHECK(facts.manifold);
    CHECK(facts.euler_number == 0);
    CHECK(facts.area == doctest::Approx(2.0 * 3.14159265358979 * 8.0).epsilon(0.01));
    CHECK(facts.low[2] == 0.0);
    CHECK(facts.high[2] == 1.0);
    for (const Vec3& p : wall.mesh.positions) {
      CHECK(std::abs(std::hypot(p[0] - 12.2, p[1] - 11.9) - 8.0) < 0.02);
    }
  }
}

TEST_SUITE("reconstruct: fractions of exactly one half") {
  TEST_CASE("a flat interface through cell centres is flat and whole") {
    OwnedField field({6, 5, 8});
    for (std::int64_t k = 0; k < 8; ++k) {
      for (std::int64_t j = 0; j < 5; ++j) {
        for (std::int64_t i = 0; i < 6; ++i) {
          field.at(i, j, k) = k < 4 ? 1.0 : (k == 4 ? 0.5 : 0.0);
        }
      }
    }
    for (const Placement placement : {Placement::linear, Placement::manson, Placement::plic}) {
      Options options;
      options.placement = placement;
      const Reconstruction flat = reconstruct(field.view(), unit_grid(field.dims), options);
      const Measure facts = measure(flat.mesh);
      CHECK(facts.manifold);
      CHECK(facts.degenerate_triangles == 0);
      CHECK(facts.area == doctest::Approx(30.0).epsilon(1e-12));
      for (const Vec3& p : flat.mesh.positions) {
        CHECK(std::abs(p[2] - 4.5) <= 1.1e-12);
        CHECK(p[2] != 4.5);
      }
    }
  }

  TEST_CASE("vertices keep the clearance") {
    const OwnedField field = test::half_noise({14, 14, 14}, 2);
    for (const double clearance : {1e-12, 1e-3, 0.25}) {
      Options options = with_sides(Side::empty);
      options.clearance = clearance;
      options.edge_ids = true;
      const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims), options).mesh;
      REQUIRE(mesh.positions.size() > 1000);
      double nearest = 1.0;
      for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const test::DualEdge edge = test::dual_edge(mesh.edge_ids[n], field.dims);
        const double along =
            mesh.positions[n][edge.axis] - 0.5 - static_cast<double>(edge.node[edge.axis]);
        nearest = std::min({nearest, along, 1.0 - along});
      }
      CHECK(nearest == doctest::Approx(clearance).epsilon(0.01));
      CHECK(measure(mesh).degenerate_triangles == 0);
    }
  }
}

TEST_SUITE("reconstruct: symmetries") {
  // The field seen through another view: axis a of the view is axis from[a] of the field, backwards
  // where flip[a]. The vertex of each dual edge must move along.
  void check_view(const OwnedField& field, const Grid& grid, const std::array<std::size_t, 3>& from,
                  const std::array<bool, 3>& flip, const Options& base) {
    Options options = base;
    options.edge_ids = true;
    const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
    const FieldView plain = field.view();
    FieldView view = plain;
    Grid seen = grid;
    std::int64_t first = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = from[a];
      view.dims[a] = seen.dims[a] = plain.dims[b];
      view.strides[a] = flip[a] ? -plain.strides[b] : plain.strides[b];
      first += flip[a] ? (plain.dims[b] - 1) * plain.strides[b] : 0;
      seen.spacing[a] = grid.spacing[b];
      seen.origin[a] = grid.origin[b];
      options.boundary[2 * a] = base.boundary[2 * b + (flip[a] ? 1 : 0)];
      options.boundary[2 * a + 1] = base.boundary[2 * b + (flip[a] ? 0 : 1)];
    }
    view.data = field.values.data() + first;
    const auto moved = by_edge(reconstruct(view, seen, options).mesh);
    REQUIRE(moved.size() == mesh.positions.size());
    double worst = 0.0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      const test::DualEdge edge = test::dual_edge(mesh.edge_ids[n], grid.dims);
      Index3 node{};
      Vec3 expected{};
      std::size_t axis = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = from[a];
        const std::int64_t low = edge.node[b];
        node[a] = flip[a] ? grid.dims[b] - 1 - low - (edge.axis == b ? 1 : 0) : low;
        const double length = grid.spacing[b] * static_cast<double>(grid.dims[b]);
        const double x = mesh.positions[n][b] - grid.origin[b];
        expected[a] = grid.origin[b] + (flip[a] ? length - x : x);
        axis = edge.axis == b ? a : axis;
      }
      std::uint64_t id = 0;
      for (std::size_t a = 3; a-- > 0;) {
        id = id * static_cast<std::uint64_t>(seen.dims[a] + 2) +
             static_cast<std::uint64_t>(node[a] + 1);
      }
      const auto found = moved.find(3 * id + axis);
      REQUIRE(found != moved.end());
      worst = std::max(worst, distance(found->second, expected));
    }
    CHECK(worst <= 1e-12 * std::hypot(grid.spacing[0] * static_cast<double>(grid.dims[0]),
                                      grid.spacing[1] * static_cast<double>(grid.dims[1]),
                                      grid.spacing[2] * static_cast<double>(grid.dims[2])));
  }

  TEST_CASE("mirrors and permutations of the axes") {
    const OwnedField fields[] = {blob({22, 19, 17}), white_noise({9, 10, 11}, 21)};
    Options options;
    options.boundary = {Side::open, Side::empty, Side::mirror, Side::open, Side::full, Side::open};
    Options periodic;
    periodic.boundary = {Side::open,     Side::empty,  Side::periodic,
                         Side::periodic, Side::mirror, Side::open};
    Options open;
    for (const OwnedField& field : fields) {
      const Grid grid{field.dims, {0.3, -0.2, 0.7}, {0.1, 0.13, 0.08}};
      for (int m = 1; m < 8; ++m) {
        check_view(field, grid, {0, 1, 2}, {(m & 1) != 0, (m & 2) != 0, (m & 4) != 0}, open);
      }
      for (const std::array<std::size_t, 3>& from :
           {std::array<std::size_t, 3>{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
        check_view(field, grid, from, {false, false, false}, open);
        check_view(field, grid, from, {true, false, true}, options);
        check_view(field, grid, from, {false, false, false}, periodic);
      }
    }
  }

  TEST_CASE("scaling and translation") {
    const OwnedField field = blob({22, 19, 17});
    const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims)).mesh;
    for (const double factor : {1e-9, 0.3, 1e6}) {
      const Vec3 shift{5.0 * factor, -77.7 * factor, 0.01 * factor};
      const Grid grid{field.dims, shift, {factor, factor, factor}};
      const Mesh moved = reconstruct(field.view(), grid).mesh;
      REQUIRE(moved.positions.size() == mesh.positions.size());
      CHECK(test::same_bytes(moved.triangles, mesh.triangles));
      double worst = 0.0;
      for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const Vec3& p = mesh.positions[n];
        worst = std::max(
            worst, distance(moved.positions[n], {p[0] * factor + shift[0], p[1] * factor + shift[1],
                                                 p[2] * factor + shift[2]}));
      }
      CHECK(worst <= 1e-12 * 22.0 * factor);
    }
  }

  TEST_CASE("exchanging empty and full turns the triangles around") {
    OwnedField field = blob({22, 19, 17});
    const Grid grid = unit_grid(field.dims);
    const Reconstruction direct = reconstruct(field.view(), grid, with_sides(Side::empty));
    for (double& value : field.values) {
      value = 1.0 - value;
    }
    const Reconstruction inverse = reconstruct(field.view(), grid, with_sides(Side::full));
    REQUIRE(inverse.mesh.positions.size() == direct.mesh.positions.size());
    double worst = 0.0;
    for (std::size_t n = 0; n < direct.mesh.positions.size(); ++n) {
      worst = std::max(worst, distance(direct.mesh.positions[n], inverse.mesh.positions[n]));
    }
    CHECK(worst < 1e-12 * 22.0);
    CHECK(direct.report.enclosed_volume > 0.0);
    CHECK(inverse.report.enclosed_volume ==
          doctest::Approx(-direct.report.enclosed_volume).epsilon(1e-12));
  }
}

TEST_SUITE("reconstruct: sides") {
  TEST_CASE("mirror: the surface meets the face at right angles") {
    const OwnedField field = white_noise({8, 9, 10}, 4);
    Options options = with_sides(Side::mirror);
    options.edge_ids = true;
    const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims), options).mesh;
    const auto vertices = by_edge(mesh);
    std::size_t on_faces = 0;
    for (const auto& [id, p] : vertices) {
      const test::DualEdge edge = test::dual_edge(id, field.dims);
      for (std::size_t a = 0; a < 3; ++a) {
        const bool low = edge.node[a] == -1;
        if (!low && edge.node[a] != field.dims[a]) {
          continue;
        }
        ++on_faces;
        CHECK(p[a] == (low ? 0.0 : static_cast<double>(field.dims[a])));
        test::DualEdge inner = edge;
        inner.node[a] += low ? 1 : -1;
        std::uint64_t number = 0;
        for (std::size_t b = 3; b-- > 0;) {
          number = number * static_cast<std::uint64_t>(field.dims[b] + 2) +
                   static_cast<std::uint64_t>(inner.node[b] + 1);
        }
        const auto found = vertices.find(3 * number + edge.axis);
        REQUIRE(found != vertices.end());
        for (std::size_t b = 0; b < 3; ++b) {
          CHECK((b == a || p[b] == found->second[b]));
        }
      }
    }
    CHECK(on_faces > 300);
  }

  TEST_CASE("periodic: boundary loops match to the last bit") {
    const OwnedField field = white_noise({8, 9, 10}, 4);
    Options options = with_sides(Side::periodic);
    options.edge_ids = true;
    options.vertex_normals = true;
    const Grid grid{field.dims, {0.1, 0.2, -0.7}, {0.3, 0.7, 0.11}};
    const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
    std::map<std::uint64_t, std::size_t> number;
    for (std::size_t n = 0; n < mesh.edge_ids.size(); ++n) {
      number[mesh.edge_ids[n]] = n;
    }
    std::array<std::size_t, 3> pairs{};
    for (const auto& [id, n] : number) {
      const test::DualEdge edge = test::dual_edge(id, field.dims);
      for (std::size_t a = 0; a < 3; ++a) {
        CHECK(edge.node[a] >= 0);
        if (edge.node[a] != 0 || edge.axis == a) {
          continue;
        }
        std::uint64_t step = 3 * static_cast<std::uint64_t>(field.dims[a]);
        for (std::size_t b = 0; b < a; ++b) {
          step *= static_cast<std::uint64_t>(field.dims[b] + 2);
        }
        const auto image = number.find(id + step);
        REQUIRE(image != number.end());
        Vec3 expected = mesh.positions[n];
        expected[a] += static_cast<double>(field.dims[a]) * grid.spacing[a];
        CHECK(mesh.positions[image->second] == expected);
        CHECK(mesh.normals[image->second] == mesh.normals[n]);
        ++pairs[a];
      }
    }
    for (const std::size_t count : pairs) {
      CHECK(count > 50);
    }
  }

  TEST_CASE("open: every boundary edge lies on a domain face") {
    const OwnedField field = white_noise({8, 9, 10}, 6);
    const Grid grid{field.dims, {0.1, 0.2, -0.7}, {0.3, 0.7, 0.11}};
    const Mesh mesh = reconstruct(field.view(), grid).mesh;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto ends = std::minmax(t[c], t[(c + 1) % 3]);
        ++edges[{ends.first, ends.second}];
      }
    }
    std::size_t boundary = 0;
    for (const auto& [ends, count] : edges) {
      if (count == 2) {
        continue;
      }
      REQUIRE(count == 1);
      ++boundary;
      const Vec3& p = mesh.positions[ends.first];
      const Vec3& q = mesh.positions[ends.second];
      bool on_one_face = false;
      for (std::size_t a = 0; a < 3; ++a) {
        const double high = grid.origin[a] + static_cast<double>(grid.dims[a]) * grid.spacing[a];
        on_one_face = on_one_face || (p[a] == q[a] && (p[a] == grid.origin[a] || p[a] == high));
      }
      CHECK(on_one_face);
    }
    CHECK(boundary > 200);
  }

  TEST_CASE("open: smears of a solver make no film on the face") {
    for (const double smear : {1e-5, 1e-4, 1e-3, 9e-3}) {
      for (const bool full : {false, true}) {
        const OwnedField field({6, 6, 6}, full ? 1.0 - smear : smear);
        Options options;
        options.boundary[4] = full ? Side::full : Side::empty;
        CHECK(reconstruct(field.view(), unit_grid(field.dims), options).mesh.triangles.empty());
        OwnedField around = blob({24, 24, 24});
        for (double& value : around.values) {
          value = std::clamp(value, smear, 1.0 - smear);
        }
        options.boundary = {Side::periodic, Side::periodic, Side::open,
                            Side::mirror,   Side::open,     Side::empty};
        CHECK(reconstruct(around.view(), unit_grid(around.dims), options).report.closed);
      }
    }
  }

  TEST_CASE("empty: the surface stays within the domain") {
    const OwnedField field = white_noise({8, 9, 10}, 9);
    for (const Placement placement : {Placement::linear, Placement::manson, Placement::plic}) {
      Options options = with_sides(Side::empty);
      options.placement = placement;
      const Reconstruction result = reconstruct(field.view(), unit_grid(field.dims), options);
      CHECK(result.report.closed);
      const Measure facts = measure(result.mesh);
      CHECK(facts.closed);
      CHECK(facts.volume == doctest::Approx(result.report.enclosed_volume).epsilon(1e-12));
      for (std::size_t a = 0; a < 3; ++a) {
        CHECK(facts.low[a] >= 0.0);
        CHECK(facts.high[a] <= static_cast<double>(field.dims[a]));
      }
    }
  }
}

TEST_SUITE("reconstruct: normals and ids") {
  TEST_CASE("vertex normals are unit and follow the triangles") {
    const OwnedField field = blob({40, 38, 36});
    Options options;
    options.vertex_normals = true;
    for (const Placement placement : {Placement::linear, Placement::plic}) {
      options.placement = placement;
      const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims), options).mesh;
      REQUIRE(mesh.normals.size() == mesh.positions.size());
      for (const Vec3& n : mesh.normals) {
        CHECK(std::hypot(n[0], n[1], n[2]) == doctest::Approx(1.0).epsilon(1e-14));
      }
      for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.positions[t[0]];
        const Vec3& b = mesh.positions[t[1]];
        const Vec3& c = mesh.positions[t[2]];
        const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const Vec3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const Vec3 facet{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]};
        const Vec3& n = mesh.normals[t[0]];
        CHECK(facet[0] * n[0] + facet[1] * n[1] + facet[2] * n[2] > 0.0);
      }
    }
  }

  TEST_CASE("vertex normals are unit where the planes of an edge lean opposite ways") {
    // The middle of a film along y: what is left of two normals is rounding, here of the least
    // numbers.
    Options options;
    options.vertex_normals = true;
    options.placement = Placement::midpoint;
    for (const double middle : {0.99, 0.6, 0.5}) {
      for (const double least : {9.8813129168249309e-324, 4e-320, 1e-310, 1e-17, 0.0}) {
        OwnedField field({3, 2, 2});
        for (std::int64_t n = 0; n < 4; ++n) {
          field.at(0, n % 2, n / 2) = 1.0;
          field.at(1, n % 2, n / 2) = least;
          field.at(2, n % 2, n / 2) = middle;
        }
        const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims), options).mesh;
        REQUIRE(mesh.normals.size() == mesh.positions.size());
        REQUIRE(mesh.positions.size() >= 8);
        for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
          const Vec3& n = mesh.normals[v];
          CHECK(std::hypot(n[0], n[1], n[2]) == doctest::Approx(1.0).epsilon(1e-14));
          // The gas lies between: out of the material is towards x = 1.5.
          CHECK(n[0] * (1.5 - mesh.positions[v][0]) > 0.0);
        }
      }
    }
  }

  TEST_CASE("edge ids ascend and each vertex lies on its edge") {
    const OwnedField field = white_noise({9, 7, 8}, 12);
    Options options;
    options.edge_ids = true;
    const Mesh mesh = reconstruct(field.view(), unit_grid(field.dims), options).mesh;
    CHECK(std::adjacent_find(mesh.edge_ids.begin(), mesh.edge_ids.end(),
                             [](auto a, auto b) { return a >= b; }) == mesh.edge_ids.end());
    CHECK(are_within_edges(mesh, unit_grid(field.dims)));
  }

  TEST_CASE("open: no rounding at one half carries a vertex off its edge") {
    const double limits[] = {0.0, test::beside(0.5, -1), 0.5, test::beside(0.5, 1), 1.0};
    int vertices = 0;
    for (const Normals normals : {Normals::youngs, Normals::myc, Normals::height_function,
                                  Normals::elvira, Normals::lvira}) {
      Options options;
      options.normals = normals;
      options.edge_ids = true;
      options.threads = 1;
      for (int n = 0; n < 3 * 625; ++n) {
        // All fields of four cells, in the planes across each axis.
        Index3 dims{2, 2, 2};
        dims[static_cast<std::size_t>(n % 3)] = 1;
        OwnedField field(dims);
        int rest = n / 3;
        for (double& value : field.values) {
          value = limits[rest % 5];
          rest /= 5;
        }
        const Grid grid{dims, {0.1, -0.7, 1e5}, {0.3, 1e-3, 700.0}};
        const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
        CAPTURE(n);
        REQUIRE(are_within_edges(mesh, grid));
        vertices += static_cast<int>(mesh.positions.size());
      }
    }
    CHECK(vertices > 50000);
  }

  TEST_CASE("open: roundings of a flat interface through cell centres leave it flat") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Options options;
      options.normals = static_cast<Normals>(seed % 5);
      options.edge_ids = true;
      Index3 dims{1 + static_cast<std::int64_t>(seed % 3),
                  1 + static_cast<std::int64_t>(seed / 3 % 4), 9};
      OwnedField field(dims);
      const OwnedField roundings = white_noise(dims, seed);
      for (std::size_t n = 0; n < field.values.size(); ++n) {
        const auto k = static_cast<std::int64_t>(n) / (dims[0] * dims[1]);
        const int ulps = static_cast<int>(3.0 * roundings.values[n]) - 1;
        field.values[n] = k < 4 ? 1.0 : (k == 4 ? test::beside(0.5, ulps) : 0.0);
      }
      const Mesh mesh = reconstruct(field.view(), unit_grid(dims), options).mesh;
      CAPTURE(seed);
      REQUIRE(are_within_edges(mesh, unit_grid(dims)));
      const Measure facts = measure(mesh);
      CHECK(facts.manifold);
      // Where neighbours round to different sides the surface steps over the centres by the
      // clearance, no more.
      CHECK(facts.area == doctest::Approx(static_cast<double>(dims[0] * dims[1])).epsilon(1e-9));
      for (const Vec3& p : mesh.positions) {
        REQUIRE(std::abs(p[2] - 4.5) <= 1.1e-12);
      }
    }
  }

  TEST_CASE(
      "open: vertices keep within their edges where coordinates are as large as they may be") {
    for (const double sign : {-1.0, 1.0}) {
      for (const Vec3& spacing : {Vec3{1.0, 1e-6, 1e6}, Vec3{1e6, 1.0, 1e-6}}) {
        const OwnedField field = test::near_half_noise({5, 4, 3}, 3);
        Grid grid{field.dims, {}, spacing};
        for (std::size_t a = 0; a < 3; ++a) {
          grid.origin[a] = sign * (0x1p40 - 8.0) * spacing[a];
        }
        for (const double clearance : {1e-13, 0.25}) {
          Options options;
          options.clearance = clearance;
          options.edge_ids = true;
          const Mesh mesh = reconstruct(field.view(), grid, options).mesh;
          REQUIRE(mesh.positions.size() > 50);
          CHECK(are_within_edges(mesh, grid));
        }
      }
    }
  }
}

TEST_CASE("reconstruct: the report counts what is in the field") {
  OwnedField field = blob({30, 30, 30});
  field.at(0, 0, 0) = -1e-3;
  field.at(1, 0, 0) = 1.0 + 5e-2;
  field.at(2, 0, 0) = 1e-9;
  double sum = 0.0;
  std::int64_t interfacial = 0;
  for (const double value : field.values) {
    const double fraction = std::clamp(value, 0.0, 1.0);
    sum += fraction;
    interfacial += fraction > 1e-6 && fraction < 1.0 - 1e-6 ? 1 : 0;
  }
  const Grid grid{field.dims, {0.0, 0.0, 0.0}, {0.5, 0.25, 2.0}};
  const Report report = reconstruct(field.view(), grid, with_sides(Side::empty)).report;
  CHECK(report.cells == 27000);
  CHECK(report.clamped_cells == 2);
  CHECK(report.largest_overshoot == doctest::Approx(5e-2).epsilon(1e-12));
  CHECK(report.interfacial_cells == interfacial);
  CHECK(report.fraction_volume == doctest::Approx(sum * 0.25).epsilon(1e-13));
  CHECK(report.closed);
  CHECK(report.enclosed_volume == doctest::Approx(report.fraction_volume).epsilon(0.02));
  CHECK(report.solved_edges > 1000);
  CHECK(report.newton_steps_mean > 1.0);
  CHECK(report.newton_steps_mean <= static_cast<double>(report.newton_steps_max));
  CHECK(report.height_function_cells > 0);
  CHECK(report.height_function_cells < report.planes);
  CHECK(report.seconds.total > 0.0);
}
