#include "difmesh/plane.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/box_clip.hpp"
#include "support/vec3.hpp"

namespace {

using difmesh::plane_fraction;
using difmesh::plane_offset;
using difmesh::Vec3;
using difmesh::test::clipped_share;
using difmesh::test::Random;
using difmesh::test::scaled;
using difmesh::test::unit;

#ifdef DIFMESH_SANITIZED
constexpr int kRandomNormals = 60;
#else
constexpr int kRandomNormals = 600;
#endif
constexpr double kPromised = 1e-14;

const std::vector<Vec3> kSpacings{
    {1.0, 1.0, 1.0}, {1.0, 2.0, 5.0}, {1000.0, 1.0, 1.0}, {1.0, 1000.0, 30.0}, {1e-3, 1e-3, 1e-6}};

/// Directions where a formula may divide by next to nothing or lose its digits, and random ones.
std::vector<Vec3> normals() {
  std::vector<Vec3> list{{1, 0, 0}, {0, 1, 0},  {0, 0, -1}, {1, 1, 0}, {0, -1, 1},
                         {1, 1, 1}, {-1, 1, 1}, {1, 1, 2},  {1, 2, 2}, {3, 1, -1},
                         {1, 2, 0}, {0, 3, 4},  {1, 2, 3},  {2, 3, 5}, {0.5, 0.5, 1}};
  for (const double tilt : {1e-300, 1e-100, 1e-16, 1e-12, 1e-8, 1e-4}) {
    for (const Vec3& tilted : {Vec3{1, tilt, 0}, Vec3{tilt, 1, tilt}, Vec3{tilt, -3 * tilt, 1},
                               Vec3{1, 1, tilt}, Vec3{1, tilt, 1 - tilt}, Vec3{1, 1 + tilt, tilt},
                               Vec3{1, 1 - tilt, 1 + tilt}, Vec3{tilt, tilt * tilt, 1}}) {
      list.push_back(tilted);
    }
  }
  Random random(1);
  for (int n = 0; n < kRandomNormals; ++n) {
    Vec3 normal = random.direction();
    if (n % 4 == 1) {
      normal[static_cast<std::size_t>(n / 4 % 3)] *= std::pow(10.0, random.uniform(-18.0, 0.0));
    } else if (n % 4 == 2) {
      normal[0] = normal[1];
    }
    list.push_back(normal);
  }
  for (Vec3& normal : list) {
    normal = unit(normal);
  }
  return list;
}

/// From 1e-15 to 1 - 1e-15, dense at both ends.
std::vector<double> fractions() {
  std::vector<double> list{0.5, 1.0 / 6.0, 1.0 / 3.0, 5.0 / 6.0, 0.25, 0.5 - 1e-12, 0.5 + 1e-12};
  for (double exponent = -15.0; exponent < -0.3; exponent += 0.49) {
    list.push_back(std::pow(10.0, exponent));
    list.push_back(1.0 - std::pow(10.0, exponent));
  }
  for (int n = 1; n < 24; ++n) {
    list.push_back(n / 24.0);
  }
  return list;
}

double reach(const Vec3& normal, const Vec3& spacing) {
  return 0.5 * (std::abs(normal[0]) * spacing[0] + std::abs(normal[1]) * spacing[1] +
                std::abs(normal[2]) * spacing[2]);
}

/// The worst case of a loop, so that a failure names one instead of thousands.
struct Worst {
  double error = 0.0;
  Vec3 normal{};
  Vec3 spacing{};
  double argument = 0.0;

  void see(double found, const Vec3& n, const Vec3& c, double a) {
    if (!(found <= error)) {  // NaN as well
      *this = {found, n, c, a};
    }
  }
  void check(double bound) const {
    CAPTURE(normal[0]);
    CAPTURE(normal[1]);
    CAPTURE(normal[2]);
    CAPTURE(spacing[0]);
    CAPTURE(spacing[1]);
    CAPTURE(spacing[2]);
    CAPTURE(argument);
    CHECK(error <= bound);
  }
};

}  // namespace

TEST_CASE("plane: the offset of a fraction gives that fraction back") {
  Worst worst;
  for (const Vec3& spacing : kSpacings) {
    for (const Vec3& normal : normals()) {
      for (const double fraction : fractions()) {
        const double offset = plane_offset(normal, spacing, fraction);
        const double back = plane_fraction(normal, spacing, offset);
        worst.see(std::abs(back - fraction), normal, spacing, fraction);
      }
    }
  }
  worst.check(kPromised);
}

// Two components alike to the last bits and a third that is next to nothing leave ranges of offsets
// that are empty by rounding.
TEST_CASE("plane: offsets are finite and right for components that vanish or tie") {
  constexpr double kFar = 2.0;
  for (double small : {0.0, 5e-324, 1e-310, 1e-300, 1e-160, 1e-100, 1.1102230246251565e-16, 1e-15,
                       1e-9, 1e-4, 0.1}) {
    for (int ties = -2; ties <= 2; ++ties) {
      double other = 0.5;
      for (int n = 0; n < std::abs(ties); ++n) {
        other = std::nextafter(other, ties > 0 ? kFar : 0.0);
      }
      for (const double third : {0.5, 0.25, 1e-3, small}) {
        for (const double fraction : {1e-300, 1e-30, 1e-16, 1e-6, 0.25, std::nextafter(0.5, 0.0),
                                      0.5, std::nextafter(0.5, 1.0), 0.75, 1.0 - 1e-16}) {
          const Vec3 normal{small, other, -third};
          const double offset = plane_offset(normal, {1.0, 1.0, 1.0}, fraction);
          CAPTURE(small);
          CAPTURE(other);
          CAPTURE(third);
          CAPTURE(fraction);
          REQUIRE(std::isfinite(offset));
          CHECK(std::abs(plane_fraction(normal, {1.0, 1.0, 1.0}, offset) - fraction) <= kPromised);
        }
      }
    }
  }
}

TEST_CASE("plane: the fraction is the volume of the clipped cell") {
  Worst worst;
  Random random(2);
  for (const Vec3& spacing : kSpacings) {
    for (const Vec3& normal : normals()) {
      for (int n = 0; n < 12; ++n) {
        const double offset = random.uniform(-1.02, 1.02) * reach(normal, spacing);
        const auto clipped = static_cast<double>(clipped_share(spacing, normal, offset));
        worst.see(std::abs(plane_fraction(normal, spacing, offset) - clipped), normal, spacing,
                  offset);
      }
    }
  }
  worst.check(kPromised);
}

TEST_CASE("plane: the offset cuts off the fraction by clipping as well") {
  Worst worst;
  Random random(3);
  for (const Vec3& spacing : kSpacings) {
    for (const Vec3& normal : normals()) {
      for (int n = 0; n < 6; ++n) {
        const double small = std::pow(10.0, random.uniform(-15.0, 0.0));
        const double fraction = n % 3 == 0 ? small : (n % 3 == 1 ? 1.0 - small : random.uniform());
        const double offset = plane_offset(normal, spacing, fraction);
        const auto clipped = static_cast<double>(clipped_share(spacing, normal, offset));
        worst.see(std::abs(clipped - fraction), normal, spacing, fraction);
      }
    }
  }
  worst.check(kPromised);
}

TEST_CASE("plane: no fraction and all of it touch the corners") {
  for (const Vec3& spacing : kSpacings) {
    for (const Vec3& normal : normals()) {
      const double corner = reach(normal, spacing);
      CHECK(plane_offset(normal, spacing, 0.0) == doctest::Approx(-corner).epsilon(1e-15));
      CHECK(plane_offset(normal, spacing, 1.0) == doctest::Approx(corner).epsilon(1e-15));
      CHECK(plane_offset(normal, spacing, -0.3) == plane_offset(normal, spacing, 0.0));
      CHECK(plane_offset(normal, spacing, 1.7) == plane_offset(normal, spacing, 1.0));
      for (const double factor : {1.0 + 1e-15, 1.5, 1e6}) {
        CHECK(plane_fraction(normal, spacing, factor * corner) == 1.0);
        CHECK(plane_fraction(normal, spacing, -factor * corner) == 0.0);
      }
      CHECK(std::abs(plane_offset(normal, spacing, 0.5)) <= 1e-15 * corner);
    }
  }
}

TEST_CASE("plane: mirrored and permuted cells have the same bits") {
  Random random(4);
  for (const Vec3& spacing : kSpacings) {
    for (const Vec3& normal : normals()) {
      const double offset = random.uniform(-1.0, 1.0) * reach(normal, spacing);
      const double fraction = std::floor(random.uniform() * 0x1p30) * 0x1p-30;  // 1 - it is exact
      const double share = plane_fraction(normal, spacing, offset);
      const double place = plane_offset(normal, spacing, fraction);
      for (std::size_t a = 0; a < 3; ++a) {
        Vec3 mirrored = normal;
        mirrored[a] = -mirrored[a];
        CHECK(plane_fraction(mirrored, spacing, offset) == share);
        CHECK(plane_offset(mirrored, spacing, fraction) == place);

        Vec3 swapped_normal = normal;
        Vec3 swapped_spacing = spacing;
        std::swap(swapped_normal[a], swapped_normal[(a + 1) % 3]);
        std::swap(swapped_spacing[a], swapped_spacing[(a + 1) % 3]);
        CHECK(plane_fraction(swapped_normal, swapped_spacing, offset) == share);
        CHECK(plane_offset(swapped_normal, swapped_spacing, fraction) == place);
      }
      CHECK(plane_fraction(normal, spacing, -offset) ==
            doctest::Approx(1.0 - share).epsilon(1e-15));
      CHECK(plane_offset(normal, spacing, 1.0 - fraction) == -place);
    }
  }
}

TEST_CASE("plane: the offset is on the side of the centre where the fraction is of one half") {
  const Vec3 spacing{1.0, 2.0, 5.0};
  for (const Vec3& normal : normals()) {
    CHECK(plane_offset(normal, spacing, 0.5) == 0.0);
    double less = 0.5;
    double more = 0.5;
    for (int n = 0; n < 4; ++n) {
      less = std::nextafter(less, 0.0);
      more = std::nextafter(more, 1.0);
      CHECK(plane_offset(normal, spacing, less) < 0.0);
      CHECK(plane_offset(normal, spacing, more) > 0.0);
    }
  }
}

TEST_CASE("plane: normals and offsets scale together") {
  Random random(5);
  for (const Vec3& normal : normals()) {
    const Vec3 spacing{1.0, 2.0, 5.0};
    const double offset = random.uniform(-1.0, 1.0) * reach(normal, spacing);
    const double share = plane_fraction(normal, spacing, offset);
    for (const double factor : {1e-12, 0.3, 7.0, 1e12}) {
      const Vec3 longer = scaled(normal, factor);
      CHECK(std::abs(plane_fraction(longer, spacing, factor * offset) - share) <= kPromised);
      CHECK(std::abs(plane_fraction(longer, spacing, plane_offset(longer, spacing, share)) -
                     share) <= kPromised);
    }
  }
}

TEST_CASE("plane: fraction and offset grow together") {
  constexpr double kRounding = 1e-15;
  for (const Vec3& normal : normals()) {
    const Vec3 spacing{1.0, 2.0, 5.0};
    const double corner = reach(normal, spacing);
    double last_share = 0.0;
    double last_offset = -corner;
    for (int n = 0; n <= 300; ++n) {
      const double part = n / 300.0;
      const double share = plane_fraction(normal, spacing, (2.0 * part - 1.0) * corner);
      const double offset = plane_offset(normal, spacing, part);
      REQUIRE(share >= last_share - kRounding);
      REQUIRE(offset >= last_offset - kRounding * corner);
      REQUIRE(share <= 1.0);
      last_share = share;
      last_offset = offset;
    }
  }
}
