// In place of gltf_*.cpp where the library is built without glTF.

#include "difmesh/error.hpp"
#include "difmesh/io/glb.hpp"
#include "format_part.hpp"

namespace difmesh {
namespace {

constexpr const char* kNeeds = "glTF (DIFMESH_WITH_GLTF)";

[[noreturn]] void fail() {
  throw Error(ErrorCode::unsupported, std::string("difmesh was built without ") + kNeeds);
}

}  // namespace

namespace detail {

constinit const FormatPart glb_format{
    .facts = {.extension = ".glb", .name = "glTF", .needs = kNeeds}};
constinit const FormatPart gltf_format{
    .facts = {.extension = ".gltf", .name = "glTF", .needs = kNeeds}};

}  // namespace detail

std::vector<char> encode_glb(const Mesh&, const WriteMeshOptions&, MeshFileReport*) {
  fail();
}

std::string encode_glb_base64(const Mesh&, const WriteMeshOptions&) {
  fail();
}

}  // namespace difmesh
