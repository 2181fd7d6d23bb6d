// Why no library for the container: tinygltf 2.7.0 keeps all data in memory twice when it writes,
// and cuts sizes to 32 bits without a word. It cannot read files of strangers either: it follows
// the offsets of images unchecked, and refuses primitives whose accessors have no bufferView, as
// Draco's have, unless its own decoding is on, which trusts them. What is left of it is JSON, and
// that nlohmann's library does.

#include "gltf_write.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "atomic_file.hpp"
#include "base64.hpp"
#include "difmesh/error.hpp"
#include "difmesh/float_environment.hpp"
#include "difmesh/io/glb.hpp"
#include "format_part.hpp"
#include "gltf_bytes.hpp"
#include "gltf_document.hpp"
#include "gltf_read.hpp"
#include "mesh_check.hpp"
#include "text.hpp"
#include "used_part.hpp"

namespace difmesh {
namespace detail {
namespace {

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

using Sink = std::function<void(const void* data, std::size_t bytes)>;

void check_options(const std::filesystem::path& path, const Mesh& mesh,
                   const WriteMeshOptions& options) {
  if (mesh.triangles.empty()) {
    fail_write(ErrorCode::invalid_value, path,
               "the mesh has no triangles, and glTF holds no empty mesh");
  }
  if (options.draco) {
    check_draco(path, *options.draco);
  }
  if (!(options.metres_per_unit > 0.0) || !std::isfinite(options.metres_per_unit)) {
    fail_write(ErrorCode::invalid_argument, path,
               "metres_per_unit is " + to_text(options.metres_per_unit));
  }
  if (options.most_vertices < 3) {
    fail_write(ErrorCode::invalid_argument, path,
               "most_vertices is " + std::to_string(options.most_vertices) + ", less than 3");
  }
  for (const double coordinate : options.local_origin.value_or(Vec3{0, 0, 0})) {
    if (!std::isfinite(coordinate)) {
      fail_write(ErrorCode::invalid_argument, path, "local_origin is not finite");
    }
  }
  if (!options.color) {
    return;
  }
  const bool is_known = std::ranges::any_of(
      written_scalars(mesh, options),
      [&](const VertexScalar& scalar) { return scalar.name == options.color->scalars; });
  if (!is_known) {
    fail_write(ErrorCode::invalid_argument, path,
               "colors by " + in_quotes(options.color->scalars) + ", which is none of the scalars");
  }
  if (const auto& range = options.color->range) {
    if (!std::isfinite((*range)[0]) || !std::isfinite((*range)[1]) || (*range)[0] > (*range)[1]) {
      fail_write(ErrorCode::invalid_argument, path,
                 "the range of colors is " + to_text((*range)[0]) + " to " + to_text((*range)[1]));
    }
  }
}

/// A lower bound, from counts alone: before memory is taken for what cannot be written.
std::uint64_t least_data_bytes(const Mesh& mesh, const WriteMeshOptions& options) {
  const std::uint64_t per_vertex =
      12U + (options.normals ? 12U : 0U) + 4U * written_scalars(mesh, options).size() +
      (options.color ? 8U : 0U) + (options.edge_ids && !mesh.edge_ids.empty() ? 8U : 0U);
  const std::uint64_t per_index = mesh.positions.size() > kMostShortIndices ? 4U : 2U;
  return mesh.positions.size() * per_vertex + 3U * mesh.triangles.size() * per_index;
}

void put_u32(const Sink& sink, std::uint64_t number) {
  const auto value = little_endian(static_cast<std::uint32_t>(number));
  sink(&value, sizeof value);
}

void put_padding(const Sink& sink, std::uint64_t bytes, char filler) {
  const std::string padding(static_cast<std::size_t>(padded(bytes) - bytes), filler);
  sink(padding.data(), padding.size());
}

void put_glb(const Sink& sink, const std::filesystem::path& path, const GltfDocument& document) {
  const std::string json = document.json({});
  put_u32(sink, 0x46546C67);  // "glTF"
  put_u32(sink, 2);
  put_u32(sink, glb_size(path, json.size(), document.data_bytes()));
  put_u32(sink, padded(json.size()));
  put_u32(sink, 0x4E4F534A);  // "JSON"
  sink(json.data(), json.size());
  put_padding(sink, json.size(), ' ');
  put_u32(sink, padded(document.data_bytes()));
  put_u32(sink, 0x004E4942);  // "BIN"
  document.write_data(sink);
  put_padding(sink, document.data_bytes(), '\0');
}

void put_text(const Sink& sink, const std::filesystem::path& path, const GltfDocument& document) {
  (void)glb_size(path, 0, document.data_bytes());
  Base64Encoder base64("data:application/octet-stream;base64,", document.data_bytes());
  document.write_data([&](const void* data, std::size_t bytes) { base64.add(data, bytes); });
  const std::string json = document.json(base64.finish());
  sink(json.data(), json.size());
  sink("\n", 1);
}

GltfDocument describe_used(const std::filesystem::path& path, const Mesh& mesh,
                           const WriteMeshOptions& options) {
  if (!options.draco) {
    (void)glb_size(path, 0, least_data_bytes(mesh, options));
  }
  const Vec3 origin = options.local_origin.value_or(centre_of(mesh.positions));
  PackedSurface surface = pack({path, mesh, options, origin});
  const int bits = options.draco ? position_bits_of(mesh, *options.draco) : 0;
  return {path, std::move(surface), options, bits};
}

GltfDocument describe(const std::filesystem::path& path, const Mesh& mesh,
                      const WriteMeshOptions& options) {
  check_options(path, mesh, options);
  const std::optional<Mesh> part = used_part(mesh);
  return describe_used(path, part ? *part : mesh, options);
}

template <bool kIsBinary>
MeshFileReport write_gltf(const std::filesystem::path& path, const Mesh& mesh,
                          const WriteMeshOptions& options) {
  const GltfDocument document = describe(path, mesh, options);
  AtomicFile file(path);
  const Sink sink = [&](const void* data, std::size_t bytes) { file.write(data, bytes); };
  kIsBinary ? put_glb(sink, path, document) : put_text(sink, path, document);
  MeshFileReport report = document.report();
  report.bytes = file.size();
  file.commit();
  return report;
}

constexpr MeshFormat gltf_facts(std::string_view extension) {
  return {.extension = extension,
          .name = "glTF",
          .normals = true,
          .edge_ids = true,
          .scalars = true,
          .colors = true,
          .scene = true,
          .compression = Compression::optional};
}

}  // namespace

constinit const FormatPart glb_format{
    .facts = gltf_facts(".glb"), .read = read_gltf, .write = write_gltf<true>};
constinit const FormatPart gltf_format{
    .facts = gltf_facts(".gltf"), .read = read_gltf, .write = write_gltf<false>};

std::uint64_t glb_size(const std::filesystem::path& path, std::uint64_t json_bytes,
                       std::uint64_t data_bytes) {
  // Compared one by one: the sum may overflow.
  const std::uint64_t size = 12U + 8U + padded(json_bytes) + 8U + padded(data_bytes);
  if (json_bytes > kMostBytes || data_bytes > kMostBytes || size > kMostBytes) {
    fail_write(ErrorCode::too_large, path,
               std::to_string(data_bytes) +
                   " bytes of data are more than the 4 GiB that glTF's lengths can say; compress "
                   "with Draco, leave attributes out, or write .ply");
  }
  return size;
}

}  // namespace detail

std::vector<char> encode_glb(const Mesh& mesh, const WriteMeshOptions& options,
                             MeshFileReport* report) {
  const DefaultFloatEnvironment environment;
  const std::filesystem::path path = "glb in memory";
  detail::check_portion(path, portion_of(mesh), {});
  detail::check_scalars(path, detail::written_scalars(mesh, options));
  const detail::GltfDocument document = detail::describe(path, mesh, options);
  std::vector<char> bytes;
  const detail::Sink sink = [&](const void* data, std::size_t count) {
    const auto* from = static_cast<const char*>(data);
    bytes.insert(bytes.end(), from, from + count);
  };
  detail::put_glb(sink, path, document);
  if (report != nullptr) {
    *report = document.report();
    report->bytes = static_cast<std::int64_t>(bytes.size());
  }
  return bytes;
}

std::string encode_glb_base64(const Mesh& mesh, const WriteMeshOptions& options) {
  const std::vector<char> bytes = encode_glb(mesh, options);
  detail::Base64Encoder base64("", bytes.size());
  base64.add(bytes.data(), bytes.size());
  return base64.finish();
}

}  // namespace difmesh
