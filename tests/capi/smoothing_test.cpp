// Curvature, smoothing and mollification through the C interface are those of the core, bit for
// bit.

#include "difmesh/smoothing.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "difmesh/constrained_smoothing.hpp"
#include "difmesh/curvature.hpp"
#include "difmesh/mollify.hpp"
#include "difmesh/reconstruct.hpp"
#include "difmesh/vertex_normals.hpp"
#include "handles.hpp"

namespace {

using difmesh::Array;
using difmesh::Mesh;
using difmesh::Vec3;
namespace test = difmesh::test;

const difmesh::Grid kGrid{.dims = {18, 17, 16}};

struct Ball {
  test::OwnedField values = test::blob(kGrid.dims);
  dif_field field = test::c_field(values);
  test::MeshHandle handle;
  Mesh mesh;

  Ball() {
    dif_options options = test::prepared(dif_options_init);
    options.edge_ids = 1;
    options.vertex_normals = 1;
    handle = test::c_reconstruct(field, &options);
    mesh = test::mesh_of(handle.get());
    REQUIRE(mesh.positions.size() > 400);
  }
};

bool same(const std::vector<double>& found, const Array<double>& wanted) {
  return found.size() == wanted.size() &&
         std::memcmp(found.data(), wanted.data(), found.size() * sizeof(double)) == 0;
}

test::MeshHandle smoothed(const Ball& ball, const dif_grid* grid,
                          const dif_smoothing_options* options) {
  dif_mesh* made = nullptr;
  const dif_status status = dif_mesh_smooth(ball.handle.get(), grid, options, &made);
  INFO(std::string(dif_last_message()));
  REQUIRE(status == DIF_OK);
  return test::MeshHandle(made);
}

}  // namespace

TEST_CASE("curvature is that of the core") {
  const Ball ball;
  difmesh::CurvatureOptions wanted;
  wanted.principal = true;
  const std::size_t count = ball.mesh.positions.size();
  for (const int rings : {2, 3}) {
    wanted.rings = rings;
    const difmesh::Curvature expected = difmesh::curvature(ball.mesh, wanted);
    dif_curvature_options options = test::prepared(dif_curvature_options_init);
    options.rings = rings;
    std::vector<double> mean(count);
    std::vector<double> gaussian(count);
    std::vector<double> largest(count);
    std::vector<double> smallest(count);
    REQUIRE(dif_mesh_curvature(ball.handle.get(), &options, mean.data(), gaussian.data(),
                               largest.data(), smallest.data()) == DIF_OK);
    CHECK(same(mean, expected.mean));
    CHECK(same(gaussian, expected.gaussian));
    CHECK(same(largest, expected.largest));
    CHECK(same(smallest, expected.smallest));
  }
  std::vector<double> mean(count);
  REQUIRE(dif_mesh_curvature(ball.handle.get(), nullptr, mean.data(), nullptr, nullptr, nullptr) ==
          DIF_OK);
  CHECK(same(mean, difmesh::curvature(ball.mesh).mean));
  CHECK(dif_mesh_curvature(ball.handle.get(), nullptr, nullptr, nullptr, nullptr, nullptr) ==
        DIF_OK);
}

TEST_CASE("smoothing is that of the core and gives a new mesh") {
  const Ball ball;
  const Mesh& mesh = ball.mesh;
  const dif_grid grid = test::c_grid(kGrid);
  dif_smoothing_options options = test::prepared(dif_smoothing_options_init);
  const auto check = [&](const dif_grid* where, const Array<Vec3>& expected) {
    CAPTURE(options.kind);
    const Mesh smooth = test::mesh_of(smoothed(ball, where, &options).get());
    CHECK(test::same_bytes(smooth.positions, expected));
    CHECK(test::same_bytes(smooth.triangles, mesh.triangles));
    CHECK(test::same_bytes(smooth.edge_ids, mesh.edge_ids));
    CHECK(test::same_bytes(smooth.normals, difmesh::with_positions(mesh, expected).normals));
    CHECK_FALSE(test::same_bytes(smooth.positions, mesh.positions));
  };
  check(nullptr, difmesh::smooth_taubin(mesh.positions, mesh.triangles));
  options.kind = DIF_SMOOTHING_TAUBIN;
  options.steps = 2;
  options.lambda = 0.5;
  options.pass_band = 0.2;
  options.boundary = DIF_BOUNDARY_ALONG;
  check(nullptr, difmesh::smooth_taubin(mesh.positions, mesh.triangles,
                                        {.steps = 2, .lambda = 0.5, .pass_band = 0.2}));
  options.kind = DIF_SMOOTHING_LAPLACIAN;
  options.factor = 0.25;
  check(nullptr,
        difmesh::smooth_laplacian(mesh.positions, mesh.triangles, {.steps = 2, .factor = 0.25}));
  options.steps = 0;
  check(nullptr, difmesh::smooth_laplacian(mesh.positions, mesh.triangles, {.factor = 0.25}));
  options.kind = DIF_SMOOTHING_FLOW;
  options.time = 0.5;
  options.residual = 1e-6;
  check(nullptr, difmesh::smooth_by_curvature_flow(mesh.positions, mesh.triangles,
                                                   {.time = 0.5, .residual = 1e-6}));
  options.kind = DIF_SMOOTHING_CONSTRAINED;
  options.tolerance = 2e-3;
  check(&grid, difmesh::smooth_within_fractions(mesh, kGrid, {.tolerance = 2e-3}).mesh.positions);
  // The mesh itself is as it was.
  CHECK(test::same_bits(test::mesh_of(ball.handle.get()), mesh));
  dif_report report = test::prepared(dif_report_init);
  CHECK(dif_mesh_report(smoothed(ball, nullptr, nullptr).get(), &report) ==
        DIF_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("mollification is that of the core") {
  const Ball ball;
  dif_mollify_options options = test::prepared(dif_mollify_options_init);
  std::vector<double> values(ball.values.values.size());
  REQUIRE(dif_mollify(&ball.field, nullptr, values.data()) == DIF_OK);
  CHECK(same(values, difmesh::mollify(ball.values.view())));
  options.radius = 3.0;
  options.boundary[0] = options.boundary[1] = DIF_SIDE_PERIODIC;
  options.boundary[4] = DIF_SIDE_EMPTY;
  options.boundary[5] = DIF_SIDE_FULL;
  REQUIRE(dif_mollify(&ball.field, &options, values.data()) == DIF_OK);
  difmesh::MollifyOptions wanted;
  wanted.radius = 3.0;
  wanted.boundary[0] = wanted.boundary[1] = difmesh::Side::periodic;
  wanted.boundary[4] = difmesh::Side::empty;
  wanted.boundary[5] = difmesh::Side::full;
  CHECK(same(values, difmesh::mollify(ball.values.view(), wanted)));
}

TEST_CASE("curvature smoothing and mollification can be cancelled") {
  const Ball ball;
  const dif_progress stop = [](void*, double) -> std::int32_t { return 1; };
  std::vector<double> numbers(ball.values.values.size() + ball.mesh.positions.size(), 7.0);
  dif_curvature_options curvature = test::prepared(dif_curvature_options_init);
  curvature.progress = stop;
  CHECK(dif_mesh_curvature(ball.handle.get(), &curvature, numbers.data(), nullptr, nullptr,
                           nullptr) == DIF_ERROR_CANCELLED);
  dif_mollify_options mollify = test::prepared(dif_mollify_options_init);
  mollify.progress = stop;
  CHECK(dif_mollify(&ball.field, &mollify, numbers.data()) == DIF_ERROR_CANCELLED);
  CHECK(numbers == std::vector<double>(numbers.size(), 7.0));
  dif_smoothing_options smoothing = test::prepared(dif_smoothing_options_init);
  smoothing.progress = stop;
  dif_mesh* made = nullptr;
  CHECK(dif_mesh_smooth(ball.handle.get(), nullptr, &smoothing, &made) == DIF_ERROR_CANCELLED);
  CHECK(made == nullptr);
}

TEST_CASE("normals that suit the neighbours are those of the core") {
  const Ball ball;
  for (const auto& [number, normals] : {std::pair{DIF_NORMALS_ELVIRA, difmesh::Normals::elvira},
                                        std::pair{DIF_NORMALS_LVIRA, difmesh::Normals::lvira}}) {
    dif_options options = test::prepared(dif_options_init);
    options.normals = number;
    difmesh::Options wanted;
    wanted.normals = normals;
    CHECK(test::same_bits(test::mesh_of(test::c_reconstruct(ball.field, &options).get()),
                          difmesh::reconstruct(ball.values.view(), kGrid, wanted).mesh));
  }
}
