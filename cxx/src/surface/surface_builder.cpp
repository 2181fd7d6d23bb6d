#include "difmesh/surface_builder.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/out_of_memory.hpp"
#include "difmesh/values.hpp"
#include "grid/block_field.hpp"
#include "surface/layer_buffer.hpp"
#include "surface/part.hpp"
#include "surface/scale_warning.hpp"
#include "surface/seam.hpp"

namespace difmesh {
namespace {

// The cells of a group of layers, and how few layers it has at least.
constexpr std::int64_t kCellsAtOnce = 1 << 22;
constexpr std::int64_t kLeastLayers = 16;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "builder: " + message);
}

}  // namespace

class SurfaceBuilder::Work {
 public:
  Work(const Grid& grid, const Options& options, MeshSink sink, const BuilderOptions& builder)
      : grid_(detail::with_uniform_axes(grid)),
        options_(options),
        part_(builder.part.value_or(Block{{0, 0, 0}, grid.dims, {0, 0, 0}, {0, 0, 0}})),
        is_whole_(!builder.part),
        ghosts_(ghost_layers(options.placement)),
        sink_(std::move(sink)),
        seam_(grid.dims, options.edge_ids, [this](const MeshPortion& portion) { give(portion); }),
        sums_(grid_) {
    detail::check_block(part_, grid, options);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size_[axis] = part_.ghost_low[axis] + part_.dims[axis] + part_.ghost_high[axis];
    }
    at_once_ = builder.layers_at_once > 0
                   ? std::min(builder.layers_at_once, size_[2])
                   : std::max(kLeastLayers, kCellsAtOnce / size_[0] / size_[1]);
    options_.edge_ids = true;
  }

  [[nodiscard]] std::int64_t missing() const { return size_[2] - given_; }

  void add(const FieldView& slab) {
    check(slab);
    failed_ = true;  // until it has not
    if (is_whole_) {
      doubt_.add(slab);
    }
    try {
      take(slab);
    } catch (const OutOfMemory&) {
      throw;
    } catch (const std::bad_alloc&) {
      if (in_sink_) {
        throw;
      }
      throw OutOfMemory("builder: out of memory for " + std::to_string(size_[0]) + " x " +
                        std::to_string(size_[1]) + " x " + std::to_string(slab.dims[2]) +
                        " cells and those that wait");
    }
    failed_ = false;
  }

  Report finish() {
    if (failed_) {
      fail("an earlier call failed");
    }
    if (missing() > 0) {
      fail(std::to_string(missing()) + " of " + std::to_string(size_[2]) + " layers are missing");
    }
    Report report = sums_.finish();
    if (is_whole_ && detail::may_lack_full_cells(type_, grid_, options_, report)) {
      std::string doubt = doubt_.sentence(type_, kScaleRemedy);
      if (!doubt.empty()) {
        report.warnings.push_back(std::move(doubt));
      }
    }
    return report;
  }

 private:
  // What the sink throws is not the builder's.
  void give(const MeshPortion& portion) {
    in_sink_ = true;
    sink_(portion);
    in_sink_ = false;
  }

  void check(const FieldView& slab) {
    if (failed_) {
      fail("an earlier call failed");
    }
    detail::check_view(slab);
    if (given_ > 0 && slab.type != type_) {
      fail("the slab at layer " + std::to_string(given_) + " has another element type");
    }
    if (slab.dims[0] != size_[0] || slab.dims[1] != size_[1]) {
      fail("the slab at layer " + std::to_string(given_) + " has " + std::to_string(slab.dims[0]) +
           " x " + std::to_string(slab.dims[1]) + " cells in x and y, not " +
           std::to_string(size_[0]) + " x " + std::to_string(size_[1]));
    }
    if (slab.dims[2] < 1 || slab.dims[2] > missing()) {
      fail("the slab at layer " + std::to_string(given_) + " has " + std::to_string(slab.dims[2]) +
           " layers; 1 to " + std::to_string(missing()) + " are possible");
    }
    if (is_whole_ && options_.boundary[4] == Side::periodic && slab.dims[2] < size_[2]) {
      fail("periodic in z: give the field in one slab, or a part with ghost layers");
    }
    type_ = slab.type;
  }

  // Layers are counted from the first that is given.
  void take(const FieldView& slab) {
    const std::int64_t begin = given_;
    const std::int64_t layers = slab.dims[2];
    const bool is_thick = layers >= at_once_ + 2 * ghosts_ || layers == size_[2];
    if (!is_thick) {
      buffer_.append(slab, 0, layers);
      given_ += layers;
      if (ready() - done() >= at_once_ || missing() == 0) {
        work_on(buffer_.view(), buffer_.first());
        buffer_.drop_before(done() - ghosts_);
      }
      return;
    }
    if (begin > 0) {
      // What waits is worked on with the first layers of the slab.
      buffer_.append(slab, 0, 2 * ghosts_);
      given_ += 2 * ghosts_;
      work_on(buffer_.view(), buffer_.first());
    }
    given_ = begin + layers;
    work_on(slab, begin);
    const std::int64_t kept = std::clamp<std::int64_t>(done() - ghosts_, begin, given_);
    buffer_.restart(kept);
    buffer_.append(slab, kept - begin, given_ - kept);
  }

  // The end of the layers that can be worked on.
  [[nodiscard]] std::int64_t ready() const {
    const std::int64_t end = part_.ghost_low[2] + part_.dims[2];
    return missing() == 0 ? end : std::clamp(given_ - ghosts_, part_.ghost_low[2], end);
  }
  [[nodiscard]] std::int64_t done() const { return part_.ghost_low[2] + done_; }

  // \param cells from layer `first` on
  void work_on(const FieldView& cells, std::int64_t first) {
    const std::int64_t begin = done();
    const std::int64_t end = ready();
    if (begin >= end) {
      return;
    }
    const std::int64_t low = std::max(begin - ghosts_, std::int64_t{0});
    const std::int64_t high = std::min(end + ghosts_, given_);
    Block block = part_;
    block.offset[2] = part_.offset[2] + done_;
    block.dims[2] = end - begin;
    block.ghost_low[2] = begin - low;
    block.ghost_high[2] = high - end;
    const FieldView view = cells.sub({0, 0, low - first}, {size_[0], size_[1], high - low});
    Options options = options_;
    if (options_.progress) {
      options.progress = [&](double share) {
        const double layers = static_cast<double>(done_) + share * static_cast<double>(end - begin);
        return options_.progress(std::min(1.0, layers / static_cast<double>(part_.dims[2])));
      };
    }
    Mesh mesh = detail::reconstruct_part(detail::make_block_field(view, block, grid_, options),
                                         options, sums_);
    done_ += end - begin;
    seam_.add(std::move(mesh),
              done_ < part_.dims[2] ? block.offset[2] + block.dims[2] : grid_.dims[2]);
  }

  Grid grid_;
  Options options_;
  Block part_;
  bool is_whole_;
  std::int64_t ghosts_;  // layers on both sides of those that are worked on
  MeshSink sink_;
  bool in_sink_ = false;
  detail::Seam seam_;
  detail::PartSums sums_;
  detail::LayerBuffer buffer_;
  detail::SlabDoubt doubt_;
  Index3 size_{};  // of the part with its ghosts
  std::int64_t at_once_;
  std::int64_t given_ = 0;  // layers, ghosts included
  std::int64_t done_ = 0;   // layers of the part
  ScalarType type_ = ScalarType::float64;
  bool failed_ = false;
};

SurfaceBuilder::SurfaceBuilder(const Grid& grid, const Options& options, MeshSink sink,
                               const BuilderOptions& builder) {
  if (!sink) {
    fail("there is no sink");
  }
  if (builder.layers_at_once < 0) {
    fail("layers_at_once must not be negative, got " + std::to_string(builder.layers_at_once));
  }
  work_ = std::make_unique<Work>(grid, options, std::move(sink), builder);
}

SurfaceBuilder::SurfaceBuilder(SurfaceBuilder&&) noexcept = default;
SurfaceBuilder& SurfaceBuilder::operator=(SurfaceBuilder&&) noexcept = default;
SurfaceBuilder::~SurfaceBuilder() = default;

void SurfaceBuilder::add(const FieldView& slab) {
  const DefaultFloatEnvironment environment;
  if (!work_) {
    fail("it was moved to another one");
  }
  work_->add(slab);
}

Report SurfaceBuilder::finish() {
  const DefaultFloatEnvironment environment;
  if (!work_) {
    fail("it was moved to another one");
  }
  return work_->finish();
}

std::int64_t SurfaceBuilder::missing_layers() const noexcept {
  return work_ ? work_->missing() : 0;
}

}  // namespace difmesh
