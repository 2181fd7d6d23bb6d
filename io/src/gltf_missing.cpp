// In place of gltf_*.cpp where the library is built without glTF.

#include "difmesh/error.hpp"
#include "difmesh/io/gltf_file.hpp"
#include "gltf_write.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh {
namespace {

constexpr const char* kMatter = "difmesh was built without glTF (DIFMESH_WITH_GLTF)";

}  // namespace

namespace detail {

MeshFileReport write_gltf_as(const std::filesystem::path& path, const Mesh&,
                             const WriteGltfOptions&, bool) {
  fail_write(ErrorCode::invalid_argument, path, kMatter);
}

}  // namespace detail

MeshFileReport write_gltf(const std::filesystem::path& path, const Mesh&, const WriteGltfOptions&) {
  detail::fail_write(ErrorCode::invalid_argument, path, kMatter);
}

std::vector<char> encode_glb(const Mesh&, const WriteGltfOptions&, MeshFileReport*) {
  throw Error(ErrorCode::invalid_argument, kMatter);
}

std::string encode_glb_base64(const Mesh&, const WriteGltfOptions&) {
  throw Error(ErrorCode::invalid_argument, kMatter);
}

ScalarMesh read_gltf(const std::filesystem::path& path, const ReadMeshOptions&) {
  throw Error(ErrorCode::file_format, detail::quoted(path) + ": " + kMatter);
}

}  // namespace difmesh
