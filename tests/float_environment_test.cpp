// The C++ functions under settings of the caller; the C interface's test has all of them.

#include "difmesh/float_environment.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "difmesh/difmesh.hpp"
#include "support/fields.hpp"

using namespace difmesh;

namespace {

constexpr double kSmallest = 5e-324;

// As tests see them: what the thread rounds to, and whether it takes subnormal numbers for 0.
bool rounds_to(int mode) {
  return std::fegetround() == mode;
}
bool has_subnormals() {
  const volatile double smallest = kSmallest;
  const volatile double normal = 0x1p-1022;
  const volatile double half = normal * 0.5;
  return smallest + smallest > smallest && half > 0.0;
}

void set_callers_settings() {
  std::fesetenv(FE_DFL_ENV);
  std::feraiseexcept(FE_DIVBYZERO);
  std::fesetround(FE_UPWARD);
#if defined(__x86_64__)
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#endif
#if defined(__GLIBC__)
  feenableexcept(FE_INVALID | FE_OVERFLOW);
#endif
}

bool are_callers_settings() {
  const int raised = std::fetestexcept(FE_ALL_EXCEPT & ~FE_INEXACT & ~FE_UNDERFLOW);
#if defined(__GLIBC__)
  if (fegetexcept() != (FE_INVALID | FE_OVERFLOW)) {
    return false;
  }
#endif
#if defined(__x86_64__)
  if (has_subnormals()) {
    return false;
  }
#endif
  return rounds_to(FE_UPWARD) && raised == FE_DIVBYZERO;
}

template <class T>
void append(std::vector<double>& numbers, const Array<T>& values) {
  for (const T& value : values) {
    if constexpr (std::is_same_v<T, double>) {
      numbers.push_back(value);
    } else {
      numbers.insert(numbers.end(), value.begin(), value.end());
    }
  }
}

// Made with the default settings.
struct Inputs {
  test::OwnedField noise = test::white_noise({37, 36, 35}, 3);
  test::OwnedField blob = test::blob({20, 19, 18});
};

// Numbers that the functions of the core give.
std::vector<double> numbers_of_all(const Inputs& inputs, bool& undisturbed) {
  std::vector<double> numbers;
  const auto look = [&] { undisturbed = undisturbed && are_callers_settings(); };
  const test::OwnedField& noise = inputs.noise;
  const Grid grid{.dims = {37, 36, 35}, .spacing = {0.1, 0.3, 0.7}};
  Options options;
  options.vertex_normals = true;
  options.edge_ids = true;
  const Reconstruction rough = reconstruct(noise.view(), grid, options);
  look();
  append(numbers, rough.mesh.positions);
  append(numbers, rough.mesh.normals);
  numbers.push_back(rough.report.fraction_volume);
  const Grid cells{.dims = {20, 19, 18}};
  const Mesh mesh = reconstruct(inputs.blob.view(), cells, options).mesh;
  append(numbers, curvature(mesh).mean);
  look();
  numbers.push_back(measure(mesh).volume);
  look();
  append(numbers, smooth_taubin(mesh.positions, mesh.triangles));
  append(numbers, smooth_by_curvature_flow(mesh.positions, mesh.triangles));
  append(numbers, smooth_within_fractions(mesh, cells).mesh.positions);
  look();
  append(numbers, fractions_from_mesh(cells, mesh.positions, mesh.triangles).fractions);
  look();
  const Shape genus = make_shape({.kind = ShapeKind::genus});
  const Grid around{.dims = {9, 9, 9}, .origin = {-1.5, -1.5, -1.5}, .spacing = {0.3, 0.3, 0.3}};
  append(numbers, fractions_from_shape(around, genus).fractions);
  const Array<Vec3> points{{0.1, 0.2, 0.3}, {2, 1, 0}};
  Array<double> distances(2);
  genus.distances(points, distances);
  append(numbers, distances);
  look();
  append(numbers, mollify(noise.view()));
  Array<CellPlane> planes(2);
  const std::vector<Index3> two{{1, 2, 3}, {0, 0, 0}};
  cell_planes(noise.view(), grid, two, options, planes);
  numbers.push_back(planes[0].plane.offset);
  numbers.push_back(planes[1].plane.offset);
  look();
  auto bad = noise;
  bad.at(3, 4, 5) = std::nan("");
  CHECK_THROWS_AS((void)reconstruct(bad.view(), grid, options), Error);
  look();
  return numbers;
}

}  // namespace

TEST_CASE("a guard sets the default floating-point environment and gives back the other") {
  set_callers_settings();
  bool inside_is_default = false;
  {
    const DefaultFloatEnvironment environment;
    inside_is_default = rounds_to(FE_TONEAREST) && has_subnormals() &&
                        std::fetestexcept(FE_ALL_EXCEPT & ~FE_INEXACT & ~FE_UNDERFLOW) == 0;
    const volatile double zero = 0.0;
    const volatile double nothing = zero / zero;  // not a trap
    inside_is_default = inside_is_default && std::isnan(nothing);
  }
  const bool is_given_back = are_callers_settings();
  std::fesetenv(FE_DFL_ENV);
  CHECK(inside_is_default);
  CHECK(is_given_back);
}

TEST_CASE("the core's results and the caller's floating-point settings are independent") {
  const Inputs inputs;
  bool undisturbed = true;
  const std::vector<double> expected = numbers_of_all(inputs, undisturbed);
  undisturbed = true;
  set_callers_settings();
  const std::vector<double> found = numbers_of_all(inputs, undisturbed);
  std::fesetenv(FE_DFL_ENV);
  CHECK(undisturbed);
  CHECK(expected.size() > 100000);
  REQUIRE(found.size() == expected.size());
  CHECK(std::memcmp(found.data(), expected.data(), found.size() * sizeof(double)) == 0);
}
