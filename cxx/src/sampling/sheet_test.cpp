#include "sampling/sheet_test.hpp"

#include <algorithm>
#include <cmath>

#include "base/vector3.hpp"

namespace difmesh::detail {
namespace {

// Above, comparing each with each takes longer than cutting the box in two.
constexpr std::size_t kMostConvex = 8;
// Heights below this share of the coordinates that they come from are rounding.
constexpr double kFlat = 0x1p-44;

// Sums of turns round a vertex are rounded by less.
constexpr double kTurnRounding = 1e-6;

}  // namespace

Vec3 SheetTest::normal(std::uint32_t triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3& apex = mesh_.corners[t[0]];
  return cross(minus(mesh_.corners[t[1]], apex), minus(mesh_.corners[t[2]], apex));
}

bool SheetTest::is_sheet(std::span<const std::uint32_t> triangles) {
  const std::size_t count = triangles.size();
  if (count <= 1 || (count == 2 && adjacent(triangles[0], triangles[1]))) {
    return true;
  }
  if (count > kMost) {
    return false;
  }
  if (count > 2 &&
      (round_ordinary_vertex(triangles) ||
       (in_half_space(triangles) &&
        (connected_by_ordinary(triangles) || (connected(triangles) && turns_once(triangles)))))) {
    return true;
  }
  return count <= kMostConvex && convex(triangles);
}

bool SheetTest::adjacent(std::uint32_t a, std::uint32_t b) const {
  const Triangle& s = mesh_.triangles[a];
  const Triangle& t = mesh_.triangles[b];
  const auto share_edge = [&](const auto& same) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (same(s[i], t[(j + 1) % 3]) && same(s[(i + 1) % 3], t[j])) {
          return true;
        }
      }
    }
    return false;
  };
  // By index first: names lie elsewhere in memory.
  return share_edge([](std::uint32_t v, std::uint32_t w) { return v == w; }) ||
         share_edge(
             [this](std::uint32_t v, std::uint32_t w) { return mesh_.names[v] == mesh_.names[w]; });
}

std::uint8_t SheetTest::lead(std::uint8_t place) const {
  while (leader_[place] != place) {
    place = leader_[place];
  }
  return place;
}

bool SheetTest::round_ordinary_vertex(std::span<const std::uint32_t> triangles) const {
  for (const std::uint32_t vertex : mesh_.triangles[triangles[0]]) {
    const auto has_it = [&](std::uint32_t t) {
      const Triangle& triangle = mesh_.triangles[t];
      return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
    };
    if (mesh_.facts.ordinary[vertex] == 1 &&
        std::all_of(triangles.begin() + 1, triangles.end(), has_it)) {
      return true;
    }
  }
  return false;
}

bool SheetTest::connected_by_ordinary(std::span<const std::uint32_t> triangles) {
  corners_.resize(kTable);
  bool all_ordinary = true;
  std::size_t parts = triangles.size();
  for (std::uint8_t i = 0; i < triangles.size() && all_ordinary; ++i) {
    leader_[i] = i;
    for (const std::uint32_t vertex : mesh_.triangles[triangles[i]]) {
      all_ordinary = all_ordinary && mesh_.facts.ordinary[vertex] == 1;
      std::size_t slot = (vertex * 0x9e3779b9U) >> 22;
      while (corners_[slot].place != 0 && corners_[slot].vertex != vertex) {
        slot = (slot + 1) % kTable;
      }
      if (corners_[slot].place == 0) {
        used_[used_count_++] = static_cast<std::uint16_t>(slot);
        corners_[slot] = {vertex, i + 1U};
        continue;
      }
      const std::uint8_t other = lead(static_cast<std::uint8_t>(corners_[slot].place - 1));
      const std::uint8_t own = lead(i);
      parts -= other != own ? 1U : 0U;
      leader_[own] = other;
    }
  }
  for (std::size_t i = 0; i < used_count_; ++i) {
    corners_[used_[i]].place = 0;
  }
  used_count_ = 0;
  return all_ordinary && parts == 1;
}

/// False where the edge is run along twice the same way.
bool SheetTest::insert_edge(std::uint64_t from, std::uint64_t to, std::uint8_t place) {
  const std::uint64_t low = std::min(from, to);
  const std::uint64_t high = std::max(from, to);
  std::size_t slot = (low * 0x9e3779b97f4a7c15U + high) >> 54;
  while (table_[slot].forward != 0 || table_[slot].backward != 0) {
    if (table_[slot].low == low && table_[slot].high == high) {
      break;
    }
    slot = (slot + 1) % kTable;
  }
  Edge& edge = table_[slot];
  if (edge.forward == 0 && edge.backward == 0) {
    used_[used_count_++] = static_cast<std::uint16_t>(slot);
    edge.low = low;
    edge.high = high;
  }
  std::uint8_t& same = from == low ? edge.forward : edge.backward;
  const std::uint8_t other = from == low ? edge.backward : edge.forward;
  if (same != 0) {
    return false;
  }
  same = static_cast<std::uint8_t>(place + 1);
  if (other != 0) {
    leader_[lead(place)] = lead(static_cast<std::uint8_t>(other - 1));
  }
  return true;
}

bool SheetTest::connected(std::span<const std::uint32_t> triangles) {
  table_.resize(kTable);
  bool simple = true;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    leader_[i] = static_cast<std::uint8_t>(i);
  }
  for (std::size_t i = 0; i < triangles.size() && simple; ++i) {
    const Triangle& t = mesh_.triangles[triangles[i]];
    for (std::size_t c = 0; c < 3 && simple; ++c) {
      const std::uint64_t from = mesh_.names[t[c]];
      const std::uint64_t to = mesh_.names[t[(c + 1) % 3]];
      simple = from == to || insert_edge(from, to, static_cast<std::uint8_t>(i));
    }
  }
  for (std::size_t i = 0; i < used_count_; ++i) {
    table_[used_[i]] = {};
  }
  used_count_ = 0;
  std::size_t leaders = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    leaders += leader_[i] == i ? 1U : 0U;
  }
  return simple && leaders == 1;
}

bool SheetTest::in_half_space(std::span<const std::uint32_t> triangles) {
  std::array<std::int64_t, 3> sum{};
  for (const std::uint32_t t : triangles) {
    for (std::size_t a = 0; a < 3; ++a) {
      sum[a] += mesh_.facts.normals[t][a];
    }
  }
  for (const std::uint32_t t : triangles) {
    const std::array<std::int32_t, 3>& normal = mesh_.facts.normals[t];
    const std::int64_t along = normal[0] * sum[0] + normal[1] * sum[1] + normal[2] * sum[2];
    // Triangles without area have no normal, and bound nothing.
    if (along <= 0 && normal != std::array<std::int32_t, 3>{}) {
      return false;
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    direction_[a] = static_cast<double>(sum[a]);
  }
  return true;
}

void SheetTest::add_turn(std::uint64_t name, double angle) {
  std::size_t slot = (name * 0x9e3779b97f4a7c15U) >> 54;
  while (turns_[slot].used && turns_[slot].name != name) {
    slot = (slot + 1) % kTable;
  }
  if (!turns_[slot].used) {
    used_[used_count_++] = static_cast<std::uint16_t>(slot);
    turns_[slot] = {name, 0.0, true};
  }
  turns_[slot].angle += angle;
}

bool SheetTest::turns_once(std::span<const std::uint32_t> triangles) {
  turns_.resize(kTable);
  const AngleGauge gauge(direction_);
  for (const std::uint32_t t : triangles) {
    const Triangle& triangle = mesh_.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      add_turn(mesh_.names[triangle[c]],
               gauge.quarters(mesh_.corners[triangle[c]], mesh_.corners[triangle[(c + 1) % 3]],
                              mesh_.corners[triangle[(c + 2) % 3]]));
    }
  }
  bool once = true;
  for (std::size_t i = 0; i < used_count_; ++i) {
    Turn& turn = turns_[used_[i]];
    once = once && turn.angle < 4.0 + kTurnRounding;
    turn.used = false;
  }
  used_count_ = 0;
  return once;
}

std::array<double, 2> SheetTest::heights(std::uint32_t a, std::uint32_t b) const {
  const Vec3 area = normal(a);
  const double length = std::sqrt(dot(area, area));
  const Vec3& apex = mesh_.corners[mesh_.triangles[a][0]];
  std::array<double, 2> range{0.0, 0.0};
  for (const std::uint32_t vertex : mesh_.triangles[b]) {
    const Vec3 offset = minus(mesh_.corners[vertex], apex);
    const double reach = std::abs(offset[0]) + std::abs(offset[1]) + std::abs(offset[2]);
    const double height = dot(area, offset);
    if (std::abs(height) > kFlat * length * reach) {
      range[0] = std::min(range[0], height);
      range[1] = std::max(range[1], height);
    }
  }
  return range;
}

bool SheetTest::convex(std::span<const std::uint32_t> triangles) const {
  bool inner = true;
  bool outer = true;
  for (std::size_t i = 0; i < triangles.size() && (inner || outer); ++i) {
    for (std::size_t j = 0; j < i && (inner || outer); ++j) {
      const std::array<double, 2> ij = heights(triangles[i], triangles[j]);
      const std::array<double, 2> ji = heights(triangles[j], triangles[i]);
      const bool beside = adjacent(triangles[i], triangles[j]);
      // What lies flat on another, and is not its neighbour, may cover it.
      inner = inner && ij[1] == 0.0 && ji[1] == 0.0 && (beside || (ij[0] < 0.0 && ji[0] < 0.0));
      outer = outer && ij[0] == 0.0 && ji[0] == 0.0 && (beside || (ij[1] > 0.0 && ji[1] > 0.0));
    }
  }
  return inner || outer;
}

}  // namespace difmesh::detail
