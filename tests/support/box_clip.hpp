#pragma once
/// \file box_clip.hpp
/// Volume of a box cut by a half-space, by clipping the box's six faces: the tests' own geometry,
/// without any formula of the library. In long double.

#include <array>

#include "difmesh/grid.hpp"

namespace difmesh::test {

struct Box {
  Vec3 low{0.0, 0.0, 0.0};
  Vec3 high{1.0, 1.0, 1.0};
};

/// Share of the box in {normal·x <= level}, in [0,1]. A box of volume 0 gives 0.
/// \pre high >= low, normal not zero.
[[nodiscard]] long double clipped_share(const Box& box, const Vec3& normal, double level);

/// Share of the cuboid of the given spacing, centred at 0, in {normal·x <= offset}: what
/// difmesh::plane_fraction() promises.
[[nodiscard]] long double clipped_share(const Vec3& spacing, const Vec3& normal, double offset);

}  // namespace difmesh::test
