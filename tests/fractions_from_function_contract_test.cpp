// Errors, options, threads and progress of fractions_from_function().

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "difmesh/error.hpp"
#include "difmesh/fractions_from_function.hpp"
#include "difmesh/shapes.hpp"
#include "support/function_field.hpp"

using difmesh::batch_of;
using difmesh::ErrorCode;
using difmesh::fractions_from_function;
using difmesh::FractionsFromFunctionOptions;
using difmesh::FunctionBatch;
using difmesh::Grid;
using difmesh::Vec3;
using namespace difmesh::test;

namespace {

ErrorCode code_of(const Grid& grid, const FunctionBatch& f,
                  const FractionsFromFunctionOptions& options = {}) {
  try {
    (void)fractions_from_function(grid, f, options);
  } catch (const difmesh::Error& error) {
    return error.code();
  }
  return ErrorCode{};
}

}  // namespace

TEST_CASE("NaN and infinity are errors that name the place") {
  const Grid grid = cube_grid(4, 2.0);
  const auto message_of = [&](const FunctionBatch& f) -> std::string {
    try {
      (void)fractions_from_function(grid, f);
    } catch (const difmesh::Error& error) {
      CHECK(error.code() == ErrorCode::invalid_value);
      return error.what();
    }
    return "none";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // At corners first: the first of them in the order z, y, x.
  const std::string corner = message_of(
      batch_of([&](const Vec3& p) { return p[0] > 0.5 && p[1] > -0.5 ? nan : p[2] - 0.1; }));
  CHECK(corner.find("nan at (1, 0, -2)") != std::string::npos);
  CHECK(corner.find("cell (3, 2, 0)") != std::string::npos);
  // Then within cells.
  const std::string within = message_of(batch_of([&](const Vec3& p) {
    return p[0] > 1.3 && p[0] < 1.7 && p[2] > 0.0 && p[2] < 1.0 ? nan : p[2] - 0.1;
  }));
  CHECK(within.find("cell (3, 0, 2)") != std::string::npos);
  const std::string infinite = message_of(batch_of([](const Vec3& p) { return 1.0 / p[0]; }));
  CHECK(infinite.find("inf") != std::string::npos);
  // A gradient that is not finite.
  FractionsFromFunctionOptions options;
  options.gradient = [&](std::span<const Vec3>, std::span<Vec3> out) {
    std::fill(out.begin(), out.end(), Vec3{0, nan, 0});
  };
  CHECK(code_of(grid, sphere_by_square({0, 0, 0}, 1.3), options) == ErrorCode::invalid_value);
}

TEST_CASE("what f throws passes through") {
  const Grid grid = cube_grid(8, 2.0);
  CHECK_THROWS_AS(
      (void)fractions_from_function(
          grid, [](const Vec3& p) -> double { throw std::out_of_range(std::to_string(p[0])); }),
      std::out_of_range);
}

TEST_CASE("options out of range are refused") {
  const Grid grid = cube_grid(4, 2.0);
  const auto f = sphere_by_square({0, 0, 0}, 1.0);
  CHECK(code_of({{0, 1, 1}, {0, 0, 0}, {1, 1, 1}}, f) == ErrorCode::invalid_grid);
  CHECK(code_of(grid, nullptr) == ErrorCode::invalid_argument);
  const auto refused = [&](auto member, auto value) {
    FractionsFromFunctionOptions options;
    options.*member = value;
    return code_of(grid, f, options) == ErrorCode::invalid_argument;
  };
  for (const double tolerance : {0.0, -1.0, 0.1, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(refused(&FractionsFromFunctionOptions::tolerance, tolerance));
    CHECK(refused(&FractionsFromFunctionOptions::kink_tolerance, tolerance));
  }
  CHECK(refused(&FractionsFromFunctionOptions::max_calls_per_cell, 999));
  CHECK(refused(&FractionsFromFunctionOptions::max_calls_per_cell, 1'000'000'001));
  CHECK(refused(&FractionsFromFunctionOptions::threads, -1));
  const std::int64_t huge = (std::int64_t{1} << 31) - 3;
  CHECK(code_of({{huge, huge, 1}, {0, 0, 0}, {1, 1, 1}}, f) == ErrorCode::too_large);
}

TEST_CASE("the number of threads changes no bit") {
  difmesh::ShapeOptions options{.kind = difmesh::ShapeKind::golf_ball};
  options.dimples = 20;
  options.dimple_radius = 0.2;
  options.dimple_depth = 0.05;
  const auto f = difmesh::make_shape(options).function();
  const Grid grid{{13, 11, 12}, {-1.1, -1.2, -1.15}, {0.17, 0.22, 0.2}};
  FractionsFromFunctionOptions settings;
  settings.kink_tolerance = 1e-4;
  settings.threads = 1;
  const auto serial = fractions_from_function(grid, f, settings);
  CHECK(serial.report.interfacial_cells > 100);
  for (const int threads : {0, 2, 3, 7}) {
    settings.threads = threads;
    const auto parallel = fractions_from_function(grid, f, settings);
    CHECK(parallel.fractions == serial.fractions);
    CHECK(parallel.report.function_calls == serial.report.function_calls);
    CHECK(parallel.report.fraction_volume == serial.report.fraction_volume);
  }
}

TEST_CASE("progress comes from the calling thread and can cancel") {
  const Grid grid = cube_grid(32, 1.2);
  const auto f = sphere_by_square({0.1, 0.0, 0.0}, 1.0);
  FractionsFromFunctionOptions options;
  const auto caller = std::this_thread::get_id();
  std::vector<double> shares;
  options.progress = [&](double share) {
    CHECK(std::this_thread::get_id() == caller);
    shares.push_back(share);
    return true;
  };
  const auto watched = fractions_from_function(grid, f, options);
  CHECK(shares.size() >= 20);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.back() == 1.0);
  CHECK(watched.fractions == fractions_from_function(grid, f).fractions);
  for (const double stop : {0.0, 0.1, 0.5}) {
    options.progress = [stop](double share) { return share <= stop; };
    CHECK(code_of(grid, f, options) == ErrorCode::cancelled);
  }
}

TEST_CASE("fractions_from_function: cells are counted as bisected where there is a kink, only") {
  const Grid grid = cube_grid(8, 1.0);
  const auto plane = batch_of([](const Vec3& p) { return p[2] + 0.3 * p[0] - 0.31; });
  const auto smooth = fractions_from_function(grid, plane).report;
  CHECK(smooth.interfacial_cells >= 64);
  CHECK(smooth.subdivided_cells == 0);
  const auto roof =
      batch_of([](const Vec3& p) { return std::max(p[2] - 0.31, p[2] + p[0] - 0.33); });
  const auto kinked = fractions_from_function(grid, roof).report;
  CHECK(kinked.subdivided_cells > 0);
  CHECK(kinked.subdivided_cells <= 16);
}
