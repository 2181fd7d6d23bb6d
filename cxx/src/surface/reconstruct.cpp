#include "difmesh/reconstruct.hpp"

#include <string>
#include <utility>

#include "difmesh/float_environment.hpp"
#include "difmesh/values.hpp"
#include "grid/block_field.hpp"
#include "surface/part.hpp"
#include "surface/scale_warning.hpp"

namespace difmesh {
namespace {

Reconstruction run(const detail::BlockField& field, const Options& options) {
  detail::PartSums sums(field.grid);
  Reconstruction result;
  result.mesh = detail::reconstruct_part(field, options, sums);
  result.report = sums.finish();
  return result;
}

}  // namespace

Reconstruction reconstruct(const FieldView& field, const Grid& grid, const Options& options) {
  const DefaultFloatEnvironment environment;
  const Block whole{{0, 0, 0}, grid.dims, {0, 0, 0}, {0, 0, 0}};
  Reconstruction result = run(detail::make_block_field(field, whole, grid, options), options);
  if (detail::may_lack_full_cells(field.type, grid, options, result.report)) {
    std::string doubt = doubt_of_scale(ValueView(field));
    if (!doubt.empty()) {
      result.report.warnings.push_back(std::move(doubt));
    }
  }
  return result;
}

Reconstruction reconstruct_block(const FieldView& field, const Block& block, const Grid& grid,
                                 const Options& options) {
  const DefaultFloatEnvironment environment;
  Options named = options;
  named.edge_ids = true;
  return run(detail::make_block_field(field, block, grid, named), named);
}

}  // namespace difmesh
