#include "sampling/triangle_bins.hpp"

#include <algorithm>
#include <atomic>

namespace difmesh::detail {
namespace {

// The sums of a block take 16 bytes per cell; half a megabyte stays in the cache of one core.
constexpr std::int64_t kCellsPerBlock = std::int64_t{1} << 15;
// Enough for many threads, on thin grids too.
constexpr std::int64_t kLeastBlocks = 64;
constexpr std::int64_t kTrianglesPerPortion = 4096;

}  // namespace

RowBlocks::RowBlocks(const Index3& dims) noexcept : dims_(dims) {
  const std::int64_t all_rows = dims[1] * dims[2];
  const std::int64_t rows = std::clamp<std::int64_t>(
      std::min(kCellsPerBlock / dims[0], all_rows / kLeastBlocks), 1, all_rows);
  rows_ = std::min(rows, dims[1]);
  layers_ = std::max<std::int64_t>(rows / dims[1], 1);
  across_j_ = (dims[1] + rows_ - 1) / rows_;
  across_k_ = (dims[2] + layers_ - 1) / layers_;
}

RowBlocks::Rows RowBlocks::rows(std::int64_t block) const noexcept {
  const std::int64_t j = block % across_j_ * rows_;
  const std::int64_t k = block / across_j_ * layers_;
  return {j, std::min(j + rows_, dims_[1]), k, std::min(k + layers_, dims_[2])};
}

// Two passes, the first counting. Threads may write one bin at a time in any order: nothing that is
// made of the bins depends on it.
TriangleBins::TriangleBins(const RowBlocks& blocks, std::span<const Vec3> corners,
                           std::span<const Triangle> triangles, Workers& workers)
    : begin_(static_cast<std::size_t>(blocks.count()) + 2) {
  const auto visit_all = [&](const auto& visit) {
    workers.for_portions(static_cast<std::int64_t>(triangles.size()), kTrianglesPerPortion,
                         [&](std::int64_t first, std::int64_t end) {
                           for (std::int64_t t = first; t < end; ++t) {
                             const Triangle& triangle = triangles[static_cast<std::size_t>(t)];
                             blocks.for_blocks(corners[triangle[0]], corners[triangle[1]],
                                               corners[triangle[2]], [&](std::int64_t block) {
                                                 visit(static_cast<std::size_t>(block),
                                                       static_cast<std::uint32_t>(t));
                                               });
                           }
                         });
  };
  const auto next = [](std::uint64_t& counter) {
    return std::atomic_ref<std::uint64_t>(counter).fetch_add(1, std::memory_order_relaxed);
  };
  // Counts stand two places on, so that after filling through place + 1 all begins are in place.
  visit_all([&](std::size_t block, std::uint32_t) { next(begin_[block + 2]); });
  for (std::size_t i = 1; i < begin_.size(); ++i) {
    begin_[i] += begin_[i - 1];
  }
  triangles_.resize(begin_.back());
  visit_all([&](std::size_t block, std::uint32_t triangle) {
    triangles_[next(begin_[block + 1])] = triangle;
  });
  begin_.pop_back();
}

}  // namespace difmesh::detail
