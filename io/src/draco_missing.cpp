// In place of draco_*.cpp where the library is built without Draco.

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Draco within glTF: of files of Draco alone the table of formats tells.
std::string matter() {
  return "difmesh was built without " + std::string(kDracoMissing);
}

}  // namespace

EncodedDraco encode_draco(const std::filesystem::path& path, const PackedPrimitive&,
                          const DracoOptions&, int, const std::optional<Vec3>&) {
  fail_write(ErrorCode::unsupported, path, matter());
}

DracoCounts draco_counts(const std::filesystem::path& path, std::span<const char>) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + matter());
}

DecodedDraco decode_draco(const std::filesystem::path& path, std::span<const char>,
                          std::span<const std::uint32_t>) {
  throw Error(ErrorCode::file_format, quoted(path) + ": " + matter());
}

}  // namespace difmesh::detail
