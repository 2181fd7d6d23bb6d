#include "difmesh/curvature.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/shapes.hpp"
#include "support/fields.hpp"
#include "support/parametric_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Curvature;
using difmesh::CurvatureOptions;
using difmesh::ErrorCode;
using difmesh::Vec3;
using namespace difmesh::test;

constexpr double kPi = std::numbers::pi;

Curvature curvature_of(const TriangleMesh& mesh, const CurvatureOptions& options = {}) {
  return difmesh::curvature(mesh.positions, mesh.triangles, options);
}

/// Paraboloid z = a x² + b xy + c y² over a slanted lattice with noise in x and y, on a grid of
/// 9 x 9 vertices with the apex in the middle.
struct Paraboloid {
  double a, b, c;

  [[nodiscard]] TriangleMesh mesh(std::uint64_t seed) const {
    Random random(seed);
    return parametric_mesh({9, 9, false, false}, [&](std::uint32_t i, std::uint32_t j) {
      const bool is_apex = i == 4 && j == 4;
      const double noise = is_apex ? 0.0 : 0.02;
      const double u = static_cast<double>(i) - 4.0;
      const double v = static_cast<double>(j) - 4.0;
      const double x = 0.1 * u + 0.03 * v + random.uniform(-noise, noise);
      const double y = 0.08 * v + random.uniform(-noise, noise);
      return Vec3{x, y, a * x * x + b * x * y + c * y * y};
    });
  }
  static constexpr std::size_t kApex = 4 * 9 + 4;
};

/// A mesh turned by a fixed rotation and moved.
TriangleMesh moved(TriangleMesh mesh) {
  const Vec3 x = unit({1.0, 2.0, -0.5});
  const Vec3 helper{0.3, -1.0, 2.0};
  const Vec3 y = unit(subtract(helper, scaled(x, dot(helper, x))));
  const Vec3 z = cross(x, y);
  for (Vec3& p : mesh.positions) {
    p = add({10.0, -3.0, 7.0}, add(scaled(x, p[0]), add(scaled(y, p[1]), scaled(z, p[2]))));
  }
  return mesh;
}

std::pair<ErrorCode, std::string> failure_of(const TriangleMesh& mesh,
                                             const CurvatureOptions& options = {}) {
  try {
    static_cast<void>(curvature_of(mesh, options));
  } catch (const difmesh::Error& error) {
    return {error.code(), error.what()};
  }
  FAIL("no error was thrown");
  return {};
}

struct Errors {
  double rms = 0.0;
  double max = 0.0;
};

/// Of mean and Gaussian curvature of points on a surface with known ones.
template <class Exact>
std::array<Errors, 2> errors_of(const TriangleMesh& mesh, const Exact& exact) {
  const Curvature curvature = curvature_of(mesh);
  std::array<Errors, 2> errors{};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto [mean, gaussian] = exact(mesh.positions[v]);
    const std::array<double, 2> away{std::abs(curvature.mean[v] - mean),
                                     std::abs(curvature.gaussian[v] - gaussian)};
    for (std::size_t n = 0; n < 2; ++n) {
      errors[n].rms += away[n] * away[n] / static_cast<double>(mesh.positions.size());
      errors[n].max = std::max(errors[n].max, away[n]);
    }
  }
  for (Errors& error : errors) {
    error.rms = std::sqrt(error.rms);
  }
  return errors;
}

}  // namespace

TEST_CASE("curvature: paraboloids are exact at their apex however they are turned") {
  for (const auto& [a, b, c] : {Paraboloid{0.7, 0.4, -0.3}, Paraboloid{1.0, 0.0, 1.0},
                                Paraboloid{-0.2, 1.1, 0.9}, Paraboloid{0.0, 0.0, 0.0}}) {
    const TriangleMesh mesh = moved(Paraboloid{a, b, c}.mesh(11));
    CurvatureOptions options;
    options.principal = true;
    const Curvature curvature = curvature_of(mesh, options);
    const std::size_t apex = Paraboloid::kApex;
    // z grows towards the empty side: a bowl is concave.
    const double half = std::sqrt((a - c) * (a - c) + b * b);
    CHECK(std::abs(curvature.mean[apex] + (a + c)) < 1e-11);
    CHECK(std::abs(curvature.gaussian[apex] - (4.0 * a * c - b * b)) < 1e-11);
    CHECK(std::abs(curvature.largest[apex] + (a + c) - half) < 1e-11);
    CHECK(std::abs(curvature.smallest[apex] + (a + c) + half) < 1e-11);
  }
}

TEST_CASE("curvature: rows of vertices that stand far apart do as well as a square lattice") {
  // Vertices lie `stretch` times closer along one direction than across it, whatever the frame of
  // the fit.
  for (const double stretch : {3.0, 20.0, 60.0}) {
    for (int turn = 0; turn < 8; ++turn) {
      const double angle = 0.2 + 0.25 * std::numbers::pi * turn;
      TriangleMesh mesh = Paraboloid{0.7, 0.4, -0.3}.mesh(7);
      for (Vec3& p : mesh.positions) {
        const double along = p[0] / stretch;
        const double x = std::cos(angle) * along - std::sin(angle) * p[1];
        const double y = std::sin(angle) * along + std::cos(angle) * p[1];
        p = {x, y, 0.7 * x * x + 0.4 * x * y - 0.3 * y * y};
      }
      const Curvature curvature = curvature_of(moved(mesh));
      CAPTURE(stretch);
      CAPTURE(turn);
      CHECK(std::abs(curvature.mean[Paraboloid::kApex] + 0.4) < 1e-9 * stretch * stretch);
      CHECK(std::abs(curvature.gaussian[Paraboloid::kApex] + 1.0) < 1e-9 * stretch * stretch);
    }
  }
}

TEST_CASE("curvature: planes have none to the rims") {
  const TriangleMesh mesh = moved(Paraboloid{0.0, 0.0, 0.0}.mesh(3));
  const Curvature curvature = curvature_of(mesh);
  CHECK(curvature.undefined_vertices == 0);
  CHECK(curvature.widened_vertices > 30);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    CHECK(std::abs(curvature.mean[v]) < 1e-11);
    CHECK(std::abs(curvature.gaussian[v]) < 1e-11);
  }
}

TEST_CASE("curvature: spheres converge with the square of the edges") {
  const auto exact = [](const Vec3&) { return std::array{1.0, 1.0}; };
  std::array<Errors, 2> coarse = errors_of(octasphere(3), exact);
  for (int halvings = 4; halvings <= 5; ++halvings) {
    const std::array<Errors, 2> fine = errors_of(octasphere(halvings), exact);
    for (std::size_t n = 0; n < 2; ++n) {
      CHECK(std::log2(coarse[n].rms / fine[n].rms) > 1.9);
      CHECK(std::log2(coarse[n].max / fine[n].max) > 1.75);
    }
    coarse = fine;
  }
  CHECK(coarse[0].max < 6e-3);
  CHECK(coarse[1].max < 1.2e-2);
}

TEST_CASE("curvature: an ellipsoid has its closed-form curvatures") {
  const Vec3 axes{1.0, 0.8, 0.6};
  const auto mesh = [&](int halvings) {
    TriangleMesh result = octasphere(halvings);
    for (Vec3& p : result.positions) {
      p = {axes[0] * p[0], axes[1] * p[1], axes[2] * p[2]};
    }
    return result;
  };
  // With s = Σx²/a⁴: K = 1/(a²b²c² s²), 2H = (a² + b² + c² - |x|²) / (a²b²c² s^(3/2)).
  const auto exact = [&](const Vec3& p) {
    double s = 0.0;
    double squares = 0.0;
    double product = 1.0;
    for (std::size_t t = 0; t < 3; ++t) {
      const double square = axes[t] * axes[t];
      s += p[t] * p[t] / (square * square);
      squares += square;
      product *= square;
    }
    return std::array{(squares - dot(p, p)) / (2.0 * product * s * std::sqrt(s)),
                      1.0 / (product * s * s)};
  };
  const std::array<Errors, 2> coarse = errors_of(mesh(4), exact);
  const std::array<Errors, 2> fine = errors_of(mesh(5), exact);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(std::log2(coarse[n].rms / fine[n].rms) > 1.7);
    CHECK(std::log2(coarse[n].max / fine[n].max) > 0.8);
  }
  CHECK(fine[0].rms < 8e-3);
  CHECK(fine[1].rms < 2e-2);
}

TEST_CASE("curvature: a torus is saddle-shaped inside and the signs say which side is material") {
  const double ring = 1.5;
  const double tube = 0.5;
  const TriangleMesh mesh = torus_mesh(240, 80, ring, tube);
  const auto exact = [&](const Vec3& p) {
    const double rho = std::hypot(p[0], p[1]);
    const double cosine = (rho - ring) / tube;
    return std::array{0.5 * (1.0 / tube + cosine / rho), cosine / (tube * rho)};
  };
  const std::array<Errors, 2> errors = errors_of(mesh, exact);
  CHECK(errors[0].max < 0.01);
  CHECK(errors[1].max < 0.02);
  const Curvature outside = curvature_of(mesh);
  const Curvature inside = curvature_of(mesh.reversed());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(inside.mean[v] == doctest::Approx(-outside.mean[v]).epsilon(1e-9));
    REQUIRE(std::abs(inside.gaussian[v] - outside.gaussian[v]) < 1e-9);
  }
}

TEST_CASE("curvature: a cylinder keeps its curvature at the open ends") {
  const double radius = 2.0;
  const TriangleMesh mesh = cylinder_mesh(64, 21, radius, 4.0);
  CurvatureOptions options;
  options.principal = true;
  const Curvature curvature = curvature_of(mesh, options);
  CHECK(curvature.undefined_vertices == 0);
  CHECK(curvature.widened_vertices >= 2 * 64);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(curvature.mean[v] == doctest::Approx(0.5 / radius).epsilon(0.02));
    REQUIRE(std::abs(curvature.gaussian[v]) < 1e-3);
    REQUIRE(curvature.largest[v] == doctest::Approx(1.0 / radius).epsilon(0.02));
    REQUIRE(std::abs(curvature.smallest[v]) < 1e-3);
  }
}

TEST_CASE("curvature: powers of two of the unit change no digit") {
  const TriangleMesh mesh = octasphere(3);
  const Curvature curvature = curvature_of(mesh);
  for (const double scale : {0x1p-290, 0x1p-3, 0x1p40, 0x1p290}) {
    TriangleMesh larger = mesh;
    for (Vec3& p : larger.positions) {
      p = scaled(p, scale);
    }
    const Curvature other = curvature_of(larger);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      REQUIRE(other.mean[v] * scale == curvature.mean[v]);
      REQUIRE(other.gaussian[v] * scale * scale == curvature.gaussian[v]);
    }
  }
}

TEST_CASE("curvature: noise gives the same bits on any number of threads") {
  const OwnedField field = white_noise({24, 23, 22}, 9);
  const auto mesh = difmesh::reconstruct(field.view(), {.dims = field.dims}).mesh;
  CurvatureOptions options;
  options.principal = true;
  options.threads = 1;
  const Curvature one = difmesh::curvature(mesh, options);
  std::int64_t undefined = 0;
  for (std::size_t v = 0; v < one.mean.size(); ++v) {
    const bool finite = std::isfinite(one.mean[v]) && std::isfinite(one.gaussian[v]) &&
                        std::isfinite(one.largest[v]) && std::isfinite(one.smallest[v]);
    const bool none = std::isnan(one.mean[v]) && std::isnan(one.gaussian[v]) &&
                      std::isnan(one.largest[v]) && std::isnan(one.smallest[v]);
    REQUIRE((finite || none));
    undefined += none ? 1 : 0;
    if (finite) {
      REQUIRE(one.largest[v] >= one.smallest[v]);
    }
  }
  CHECK(one.undefined_vertices == undefined);
  CHECK(static_cast<double>(undefined) < 0.02 * static_cast<double>(one.mean.size()));
  for (const int threads : {2, 3, 0}) {
    options.threads = threads;
    const Curvature other = difmesh::curvature(mesh, options);
    CHECK(same_bytes(one.mean, other.mean));
    CHECK(same_bytes(one.gaussian, other.gaussian));
    CHECK(same_bytes(one.largest, other.largest));
    CHECK(same_bytes(one.smallest, other.smallest));
    CHECK(other.undefined_vertices == one.undefined_vertices);
    CHECK(other.widened_vertices == one.widened_vertices);
  }
}

TEST_CASE("curvature: what determines no patch is not a number") {
  // Too few vertices.
  CHECK(curvature_of(tetrahedron_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}))
            .undefined_vertices == 4);
  CHECK(curvature_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).undefined_vertices == 3);
  // Six, but seen from each the other five lie on two lines.
  CHECK(curvature_of(octasphere(0)).undefined_vertices == 6);
  // Two rows, however long.
  const TriangleMesh strip =
      parametric_mesh({40, 2, false, false}, [](std::uint32_t i, std::uint32_t j) {
        return Vec3{0.1 * i, 0.1 * j, 0.01 * i * i};
      });
  CHECK(curvature_of(strip).undefined_vertices == 80);
  // Vertices in no triangle, or in one that has an index twice.
  TriangleMesh mesh = octasphere(2);
  mesh.positions.push_back({5.0, 5.0, 5.0});
  mesh.triangles.push_back({66, 66, 0});
  const Curvature curvature = curvature_of(mesh);
  CHECK(curvature.undefined_vertices == 1);
  CHECK(std::isnan(curvature.mean[66]));
  CHECK(std::isnan(curvature.gaussian[66]));
  // Triangles without area.
  TriangleMesh flat = octasphere(1);
  for (Vec3& p : flat.positions) {
    p = {1.0, 1.0, 1.0};
  }
  CHECK(curvature_of(flat).undefined_vertices == 18);
  CHECK(curvature_of({}).mean.empty());
}

TEST_CASE("curvature: three rows of vertices are enough") {
  const TriangleMesh mesh = cylinder_mesh(48, 3, 1.0, 0.3);
  const Curvature curvature = curvature_of(mesh);
  CHECK(curvature.undefined_vertices == 0);
  for (const double mean : curvature.mean) {
    CHECK(mean == doctest::Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("curvature: bad input is named") {
  TriangleMesh mesh = octasphere(1);
  mesh.triangles[3][1] = 18;
  auto [code, message] = failure_of(mesh);
  CHECK(code == ErrorCode::invalid_argument);
  CHECK(message.find("curvature: triangle 3 refers to vertex 18") != std::string::npos);

  mesh = octasphere(1);
  mesh.positions[7][2] = std::numeric_limits<double>::infinity();
  std::tie(code, message) = failure_of(mesh);
  CHECK(code == ErrorCode::invalid_argument);
  CHECK(message.find("vertex 7 is not finite") != std::string::npos);

  for (const int rings : {0, 9, -1}) {
    CurvatureOptions options;
    options.rings = rings;
    std::tie(code, message) = failure_of(octasphere(1), options);
    CHECK(code == ErrorCode::invalid_argument);
    CHECK(message.find("rings must be 1 to 8, got " + std::to_string(rings)) != std::string::npos);
  }
  CurvatureOptions options;
  options.threads = -1;
  CHECK(failure_of(octasphere(1), options).first == ErrorCode::invalid_argument);
  options = {};
  options.progress = [](double) { return false; };
  CHECK(failure_of(octasphere(1), options).first == ErrorCode::cancelled);
}

TEST_CASE("curvature: progress grows to 1") {
  CurvatureOptions options;
  std::vector<double> shares;
  options.progress = [&](double share) {
    shares.push_back(share);
    return true;
  };
  static_cast<void>(curvature_of(octasphere(5), options));
  CHECK(shares.size() > 5);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.back() == 1.0);
}

TEST_CASE("curvature: surfaces by plic have a tenth of the error that those by manson have") {
#ifdef DIFMESH_SANITIZED
  const double radius = 24.0;
  const double factor = 7.0;
#else
  const double radius = 50.0;
  const double factor = 15.0;
#endif
  const auto cells = static_cast<std::int64_t>(2.0 * radius) + 6;
  const double middle = 0.5 * static_cast<double>(cells);
  const difmesh::Grid grid{.dims = {cells, cells, cells}};
  const auto ball = difmesh::make_shape(
      {.centre = {middle + 0.13, middle - 0.29, middle + 0.41}, .radius = radius});
  const auto fractions = difmesh::fractions_from_shape(grid, ball).fractions;
  const auto rms = [&](difmesh::Placement placement) {
    difmesh::Options options;
    options.placement = placement;
    const auto view = difmesh::FieldView::x_fastest(fractions.data(), grid.dims);
    const auto mesh = difmesh::reconstruct(view, grid, options).mesh;
    const Curvature curvature = difmesh::curvature(mesh);
    CHECK(curvature.undefined_vertices == 0);
    double sum = 0.0;
    for (const double mean : curvature.mean) {
      sum += (mean * radius - 1.0) * (mean * radius - 1.0);
    }
    return std::sqrt(sum / static_cast<double>(curvature.mean.size()));
  };
  const double plic = rms(difmesh::Placement::plic);
  const double manson = rms(difmesh::Placement::manson);
  CAPTURE(plic);
  CAPTURE(manson);
  CHECK(plic < 4e-3);
  CHECK(manson > factor * plic);
  CHECK(rms(difmesh::Placement::linear) > 100.0 * plic);
}
