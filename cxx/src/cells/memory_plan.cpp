#include "cells/memory_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <new>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/out_of_memory.hpp"
#include "planes/unit_plane.hpp"

namespace difmesh::detail {
namespace {

// Less is neither worth asking for nor long in being missed.
constexpr double kWorthAsking = 0x1p26;
constexpr double kBytesOfPlane = sizeof(UnitPlane);

// Memory that is had is given back untouched, which costs some microseconds.
bool can_have(double bytes) {
  try {
    ::operator delete(::operator new(static_cast<std::size_t>(bytes)));
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

[[noreturn]] void fail(const BlockField& field, double bytes, const char* what) {
  std::array<char, 256> text{};
  const Index3& dims = field.block.dims;
  std::snprintf(text.data(), text.size(),
                "out of memory: %lld x %lld x %lld cells need %.3g GB for %s",
                static_cast<long long>(dims[0]), static_cast<long long>(dims[1]),
                static_cast<long long>(dims[2]), bytes * 1e-9, what);
  throw OutOfMemory(text.data());
}

bool is_open(const BlockField& field, std::size_t axis, int high) {
  const std::int64_t end = field.block.offset[axis] + field.block.dims[axis];
  return field.side(static_cast<int>(axis), high) == Side::open &&
         (high == 0 ? field.block.offset[axis] == 0 : end == field.grid.dims[axis]);
}

}  // namespace

void check_memory(const BlockField& field) {
  const auto along = [&](std::size_t axis) { return static_cast<double>(field.block.dims[axis]); };
  const double rows = (along(1) + 2.0) * (along(2) + 2.0);
  const double words = std::ceil((along(0) + 2.0) / 64.0);
  // Of each row: its bits, its kind, interfacial ends, planes, and the vertices before it.
  const double bytes = rows * (8.0 * words + 1.0 + 1.0 + 4.0 + 8.0);
  if (bytes > 0x1p62) {
    throw Error(ErrorCode::too_large, std::to_string(field.block.dims[0]) + " x " +
                                          std::to_string(field.block.dims[1]) + " x " +
                                          std::to_string(field.block.dims[2]) +
                                          " cells need more memory than any machine has");
  }
  if (bytes >= kWorthAsking && !can_have(bytes)) {
    fail(field, bytes, "one bit each and some bytes per row");
  }
}

LayerPlanes::LayerPlanes(const BlockField& field, bool wanted) : field_(&field) {
  if (!wanted) {
    return;
  }
  double cells = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto layer = [&](std::size_t a) {
      return a == axis ? 1.0 : static_cast<double>(field.block.dims[a]);
    };
    const int sides = (is_open(field, axis, 0) ? 1 : 0) + (is_open(field, axis, 1) ? 1 : 0);
    cells += static_cast<double>(std::min<std::int64_t>(sides, field.block.dims[axis])) * layer(0) *
             layer(1) * layer(2);
  }
  // The least that cannot be had, to a fourth part.
  double refused = 0.0;
  for (double bytes = kBytesOfPlane * cells;
       bytes >= kWorthAsking && (bytes > 0x1p62 || !can_have(bytes)); bytes *= 0.75) {
    refused = bytes;
  }
  if (refused > 0.0) {
    limit_ = static_cast<std::int64_t>(std::min(refused, 0x1p62) / kBytesOfPlane);
  }
}

bool LayerPlanes::has_row(std::int64_t j, std::int64_t k) const {
  const Index3& dims = field_->block.dims;
  return (j == 0 && is_open(*field_, 1, 0)) || (j + 1 == dims[1] && is_open(*field_, 1, 1)) ||
         (k == 0 && is_open(*field_, 2, 0)) || (k + 1 == dims[2] && is_open(*field_, 2, 1));
}

void LayerPlanes::add(std::int64_t planes) {
  const std::int64_t sum = planes_.fetch_add(planes, std::memory_order_relaxed) + planes;
  if (sum >= limit_) {
    fail(*field_, static_cast<double>(limit_) * kBytesOfPlane,
         "planes of interfacial ones along open sides, or more");
  }
}

void fail_memory(const BlockField& field, const char* what) {
  std::array<char, 256> text{};
  const Index3& dims = field.block.dims;
  std::snprintf(text.data(), text.size(), "out of memory for %s of %lld x %lld x %lld cells", what,
                static_cast<long long>(dims[0]), static_cast<long long>(dims[1]),
                static_cast<long long>(dims[2]));
  throw OutOfMemory(text.data());
}

}  // namespace difmesh::detail
