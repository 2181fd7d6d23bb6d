// In place of draco_*.cpp where the library is built without Draco.

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr const char* kMatter = "difmesh was built without Draco (DIFMESH_WITH_DRACO)";

}  // namespace

EncodedDraco encode_draco(const std::filesystem::path& path, const PackedPrimitive&,
                          const DracoOptions&, int, const std::optional<Vec3>&) {
  fail_write(ErrorCode::invalid_argument, path, kMatter);
}

DracoCounts draco_counts(const std::filesystem::path& path, std::span<const char>) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + kMatter);
}

DecodedDraco decode_draco(const std::filesystem::path& path, std::span<const char>,
                          std::span<const std::uint32_t>) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + kMatter);
}

}  // namespace difmesh::detail
