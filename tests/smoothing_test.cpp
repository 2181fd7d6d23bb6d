#include "difmesh/smoothing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"
#include "support/fields.hpp"
#include "support/parametric_meshes.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::Array;
using difmesh::BoundaryVertices;
using difmesh::ErrorCode;
using difmesh::Vec3;
using namespace difmesh::test;

Array<Vec3> laplacian(const TriangleMesh& mesh, const difmesh::LaplacianOptions& options) {
  return difmesh::smooth_laplacian(mesh.positions, mesh.triangles, options);
}
Array<Vec3> taubin(const TriangleMesh& mesh, const difmesh::TaubinOptions& options) {
  return difmesh::smooth_taubin(mesh.positions, mesh.triangles, options);
}
Array<Vec3> flow(const TriangleMesh& mesh, const difmesh::CurvatureFlowOptions& options) {
  return difmesh::smooth_by_curvature_flow(mesh.positions, mesh.triangles, options);
}

/// Mean and rms deviation of the distances from the origin.
struct Radii {
  double mean = 0.0;
  double deviation = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0.0;
};
template <class Positions>
Radii radii_of(const Positions& positions) {
  Radii radii;
  double squares = 0.0;
  for (const Vec3& p : positions) {
    const double r = length(p);
    radii.mean += r;
    squares += r * r;
    radii.least = std::min(radii.least, r);
    radii.greatest = std::max(radii.greatest, r);
  }
  const auto count = static_cast<double>(positions.size());
  radii.mean /= count;
  radii.deviation = std::sqrt(std::max(squares / count - radii.mean * radii.mean, 0.0));
  return radii;
}

/// A unit sphere whose vertices are moved along their radii at random.
TriangleMesh rough_sphere(double amplitude) {
  TriangleMesh mesh = octasphere(4);
  Random random(5);
  for (Vec3& p : mesh.positions) {
    p = scaled(p, 1.0 + random.uniform(-amplitude, amplitude));
  }
  return mesh;
}

/// A square of 7 x 7 vertices in the plane z = 0, but for its middle.
TriangleMesh tent(double height) {
  return parametric_mesh({7, 7, false, false}, [&](std::uint32_t i, std::uint32_t j) {
    return Vec3{1.0 * i, 1.0 * j, i == 3 && j == 3 ? height : 0.0};
  });
}

ErrorCode code_of(const std::function<void()>& call, const std::string& words) {
  try {
    call();
  } catch (const difmesh::Error& error) {
    CAPTURE(error.what());
    CHECK(std::string(error.what()).find(words) != std::string::npos);
    return error.code();
  }
  FAIL("no error was thrown");
  return {};
}

}  // namespace

TEST_CASE("smoothing: a Laplacian step is the mean of the neighbours") {
  TriangleMesh mesh = tent(6.0);
  const Array<Vec3> one = laplacian(mesh, {});
  // The middle goes to its six neighbours' mean; they take a sixth of its height.
  CHECK(length(subtract(one[24], {3.0, 3.0, 0.0})) < 1e-15);
  CHECK(length(subtract(one[25], {4.0, 3.0, 1.0})) < 1e-15);
  CHECK(length(subtract(one[17], {3.0, 2.0, 1.0})) < 1e-15);
  CHECK(length(subtract(one[26], {5.0, 3.0, 0.0})) < 1e-15);
  const Array<Vec3> half = laplacian(mesh, {.factor = 0.5});
  CHECK(length(subtract(half[24], {3.0, 3.0, 3.0})) < 1e-15);
  const Array<Vec3> none = laplacian(mesh, {.steps = 0});
  CHECK(std::equal(none.begin(), none.end(), mesh.positions.begin()));
}

TEST_CASE("smoothing: boundary vertices stay or move along the boundary") {
  TriangleMesh mesh = tent(0.0);
  mesh.positions[3] = {3.2, 0.0, 0.0};   // within its side of the square
  mesh.positions[24] = {3.3, 2.9, 0.5};  // the middle
  const Array<Vec3> fixed = laplacian(mesh, {.steps = 200});
  const Array<Vec3> along = laplacian(mesh, {.steps = 1, .boundary = BoundaryVertices::along});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::size_t i = v % 7;
    const std::size_t j = v / 7;
    if (i == 0 || j == 0 || i == 6 || j == 6) {
      CHECK(fixed[v] == mesh.positions[v]);
      CHECK(along[v][2] == 0.0);
      const bool is_corner = (i == 0 || i == 6) && (j == 0 || j == 6);
      const bool on_side =
          along[v][0] == 0.0 || along[v][0] == 6.0 || along[v][1] == 0.0 || along[v][1] == 6.0;
      CHECK(on_side != is_corner);
    } else {
      CHECK(std::abs(fixed[v][2]) < 1e-12);
    }
  }
  CHECK(along[3] == Vec3{3.0, 0.0, 0.0});
  CHECK(along[0] == Vec3{0.5, 0.5, 0.0});
}

TEST_CASE("smoothing: Laplacian steps shrink a rough sphere and Taubin's do not") {
  const TriangleMesh mesh = rough_sphere(0.02);
  const Radii before = radii_of(mesh.positions);
  const Radii by_laplacian = radii_of(laplacian(mesh, {.steps = 15}));
  const Radii by_taubin = radii_of(taubin(mesh, {}));
  CHECK(by_laplacian.mean < 0.97 * before.mean);
  CHECK(by_taubin.mean == doctest::Approx(before.mean).epsilon(0.005));
  CHECK(by_taubin.deviation < 0.35 * before.deviation);
}

TEST_CASE("smoothing: Taubin's steps have their transfer function") {
  // Waves round a regular ring of triangles over triangles: on a torus of equal steps the modes of
  // the umbrella operator are Fourier modes. Heights over a flat periodic lattice would do the
  // same; here one direction wraps and all rows are alike, which makes each row see cos over its
  // own.
  const std::uint32_t around = 32;
  const std::uint32_t mode = 5;
  const TriangleMesh mesh =
      parametric_mesh({around, 64, true, false}, [&](std::uint32_t i, std::uint32_t j) {
        const double angle = 2.0 * std::numbers::pi * i * mode / around;
        return Vec3{0.0, 1.0 * j, std::cos(angle)};
      });
  // Each vertex has two neighbours in its row, one above and below in its column, and one of the
  // next column above and of the last below: k = 1 - (2 + 4 cos)/6.
  const double k = 1.0 - (2.0 + 4.0 * std::cos(2.0 * std::numbers::pi * mode / around)) / 6.0;
  for (const double pass_band : {0.05, 0.1, 0.3}) {
    const double lambda = 0.6;
    const double mu = 1.0 / (pass_band - 1.0 / lambda);
    const Array<Vec3> smooth = taubin(mesh, {.steps = 4, .lambda = lambda, .pass_band = pass_band});
    const double gain = std::pow((1.0 - lambda * k) * (1.0 - mu * k), 4);
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::size_t middle = 32 * around + i;
      CHECK(std::abs(smooth[middle][2] - gain * mesh.positions[middle][2]) < 1e-13);
    }
  }
}

TEST_CASE("smoothing: by curvature a sphere shrinks as the flow says and stays round") {
  const TriangleMesh mesh = octasphere(5);
  const double time = 0.002;
  const int steps = 20;
  const Radii after = radii_of(flow(mesh, {.steps = steps, .time = time}));
  // dR/dt = -2/R.
  CHECK(after.mean == doctest::Approx(std::sqrt(1.0 - 4.0 * time * steps)).epsilon(0.002));
  CHECK(after.deviation < 1e-3);
  // One long step is stable, and implicit: (R - q)/time = 2 q/R².
  const Radii jump = radii_of(flow(mesh, {.steps = 1, .time = 3.0}));
  CHECK(jump.mean == doctest::Approx(1.0 / 7.0).epsilon(0.01));
}

TEST_CASE("smoothing: by curvature needs no even triangles") {
  // The sampling of this sphere is denser by far about its poles; neighbours' means would slide.
  const TriangleMesh mesh = parametric_mesh({80, 41, true, false}, [](std::uint32_t i,
                                                                      std::uint32_t j) {
    const double theta = 2.0 * std::numbers::pi * i / 80;
    const double phi = std::numbers::pi * (0.02 + 0.96 * j / 40.0);
    return Vec3{std::sin(phi) * std::cos(theta), std::sin(phi) * std::sin(theta), -std::cos(phi)};
  });
  const Array<Vec3> smooth = flow(mesh, {.steps = 1, .time = 0.01});
  const double expected = 1.0 / 1.02;
  for (std::uint32_t j = 10; j <= 30; ++j) {
    const Vec3& p = smooth[j * 80 + 3];
    CHECK(length(p) == doctest::Approx(expected).epsilon(0.003));
    const Vec3 was = mesh.positions[j * 80 + 3];
    CHECK(length(subtract(unit(p), unit(was))) < 1e-3);
  }
  for (std::uint32_t i = 0; i < 80; ++i) {
    CHECK(smooth[i] == mesh.positions[i]);  // a boundary
  }
}

TEST_CASE("smoothing: by curvature shrinks the area of noise and moves planes not at all") {
  const TriangleMesh mesh = rough_sphere(0.05);
  const Array<Vec3> smooth = flow(mesh, {.steps = 2, .time = 0.001});
  CHECK(difmesh::measure(smooth, mesh.triangles).area <
        0.95 * difmesh::measure(mesh.positions, mesh.triangles).area);
  const TriangleMesh flat = tent(0.0);
  const Array<Vec3> same = flow(flat, {.time = 100.0});
  for (std::size_t v = 0; v < same.size(); ++v) {
    CHECK(length(subtract(same[v], flat.positions[v])) < 1e-9);
  }
}

TEST_CASE("smoothing: noise stays finite and gives the same bits on any number of threads") {
  const OwnedField field = white_noise({22, 23, 24}, 3);
  const auto mesh = difmesh::reconstruct(field.view(), {.dims = field.dims}).mesh;
  const auto run = [&](int kind, int threads) {
    switch (kind) {
      case 0:
        return difmesh::smooth_laplacian(mesh.positions, mesh.triangles,
                                         {.steps = 3, .threads = threads});
      case 1:
        return difmesh::smooth_taubin(
            mesh.positions, mesh.triangles,
            {.steps = 3, .boundary = BoundaryVertices::along, .threads = threads});
      default:
        return difmesh::smooth_by_curvature_flow(
            mesh.positions, mesh.triangles,
            {.steps = 2, .time = 0.1, .residual = 1e-4, .threads = threads});
    }
  };
  for (int kind = 0; kind < 3; ++kind) {
    const Array<Vec3> one = run(kind, 1);
    REQUIRE(one.size() == mesh.positions.size());
    CHECK(std::all_of(one.begin(), one.end(), [](const Vec3& p) {
      return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    }));
    CHECK_FALSE(same_bytes(one, mesh.positions));
    for (const int threads : {2, 3, 0}) {
      CHECK(same_bytes(one, run(kind, threads)));
    }
  }
}

TEST_CASE("smoothing: vertices without triangles stay") {
  TriangleMesh mesh = octasphere(1);
  mesh.positions.push_back({7.0, 8.0, 9.0});
  mesh.triangles.push_back({18, 18, 3});
  CHECK(laplacian(mesh, {}).back() == Vec3{7.0, 8.0, 9.0});
  CHECK(taubin(mesh, {}).back() == Vec3{7.0, 8.0, 9.0});
  CHECK(flow(mesh, {}).back() == Vec3{7.0, 8.0, 9.0});
  CHECK(laplacian({}, {}).empty());
  CHECK(flow({}, {}).empty());
}

TEST_CASE("smoothing: bad input is named") {
  const TriangleMesh mesh = octasphere(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto invalid = ErrorCode::invalid_argument;
  CHECK(code_of([&] { laplacian(mesh, {.steps = -1}); }, "smooth_laplacian: steps") == invalid);
  CHECK(code_of([&] { laplacian(mesh, {.factor = 1.1}); }, "factor must be") == invalid);
  CHECK(code_of([&] { laplacian(mesh, {.factor = nan}); }, "factor must be") == invalid);
  CHECK(code_of([&] { laplacian(mesh, {.threads = -2}); }, "threads") == invalid);
  CHECK(code_of([&] { laplacian(mesh, {.boundary = static_cast<BoundaryVertices>(2)}); },
                "boundary vertices") == invalid);
  CHECK(code_of([&] { taubin(mesh, {.lambda = 0.0}); }, "smooth_taubin: lambda") == invalid);
  CHECK(code_of([&] { taubin(mesh, {.pass_band = 0.0}); }, "pass_band 0") == invalid);
  CHECK(code_of([&] { taubin(mesh, {.pass_band = 1.6}); }, "pass_band 1.6") == invalid);
  CHECK(code_of([&] { taubin(mesh, {.lambda = 1.0, .pass_band = 0.1}); }, "do not go together") ==
        invalid);
  CHECK(code_of([&] { flow(mesh, {.time = 0.0}); }, "time must be above 0") == invalid);
  CHECK(code_of([&] { flow(mesh, {.residual = 0.0}); }, "residual must be") == invalid);
  TriangleMesh broken = mesh;
  broken.triangles[5][2] = 99;
  CHECK(code_of([&] { laplacian(broken, {}); }, "triangle 5 refers to vertex 99") == invalid);
  broken = mesh;
  broken.positions[4][0] = nan;
  CHECK(code_of([&] { taubin(broken, {}); }, "vertex 4 is not finite") == invalid);
  CHECK(code_of([&] { flow(broken, {}); }, "vertex 4 is not finite") == invalid);
  const difmesh::Progress stop = [](double) { return false; };
  CHECK(code_of([&] { laplacian(mesh, {.progress = stop}); }, "") == ErrorCode::cancelled);
  CHECK(code_of([&] { taubin(mesh, {.progress = stop}); }, "") == ErrorCode::cancelled);
  CHECK(code_of([&] { flow(mesh, {.progress = stop}); }, "") == ErrorCode::cancelled);
}
