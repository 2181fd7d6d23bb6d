// Writing 1.2 million triangles: Draco's encoder called directly on its own mesh, and our files of
// the same surface, which check, round, describe and compress it. One thread each. Then sizes and
// errors of Draco by bits and method, once each.
//   gltf_bench --benchmark_enable_random_interleaving --benchmark_repetitions=9

#include <benchmark/benchmark.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <memory>
#include <vector>

#include "difmesh/io/glb.hpp"
#include "difmesh/reconstruct.hpp"
#include "fields.hpp"

using namespace difmesh;

namespace {

constexpr int kBits = 14;
constexpr int kSpeed = 5;

const Mesh& surface() {
  static const Mesh mesh = [] {
    constexpr std::int64_t n = 125;
    const std::vector<double> field = bench::gyroid<double>(n);
    const Grid grid{{n, n, n}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
    Options options;
    options.vertex_normals = true;
    return reconstruct(FieldView::x_fastest(field.data(), grid.dims), grid, options).mesh;
  }();
  return mesh;
}

void set_counters(benchmark::State& state, std::int64_t bytes) {
  state.counters["triangles"] = static_cast<double>(surface().triangles.size());
  state.counters["bytes"] = static_cast<double>(bytes);
}

/// The mesh as a user of Draco has it before the encoder is called: positions in float32.
std::unique_ptr<draco::Mesh> draco_mesh() {
  const Mesh& mesh = surface();
  auto made = std::make_unique<draco::Mesh>();
  made->set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  made->SetNumFaces(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    made->SetFace(draco::FaceIndex(t),
                  {{draco::PointIndex(c[0]), draco::PointIndex(c[1]), draco::PointIndex(c[2])}});
  }
  draco::GeometryAttribute position;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id =
      made->AddAttribute(position, true, static_cast<std::uint32_t>(mesh.positions.size()));
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const std::array<float, 3> rounded{static_cast<float>(p[0]), static_cast<float>(p[1]),
                                       static_cast<float>(p[2])};
    made->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), rounded.data());
  }
  return made;
}

void draco_alone(benchmark::State& state) {
  const std::unique_ptr<draco::Mesh> mesh = draco_mesh();
  std::int64_t bytes = 0;
  for (auto _ : state) {
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetAttributeQuantization(0, kBits);
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok()) {
      state.SkipWithError("Draco refuses the mesh");
    }
    bytes = static_cast<std::int64_t>(buffer.size());
  }
  set_counters(state, bytes);
}

void glb(benchmark::State& state, const WriteMeshOptions& options) {
  MeshFileReport report;
  for (auto _ : state) {
    benchmark::DoNotOptimize(encode_glb(surface(), options, &report));
  }
  set_counters(state, report.bytes);
  state.counters["bits"] = report.position_bits;
  state.counters["error"] = report.position_error;
}

WriteMeshOptions compressed(int bits, DracoMethod method, bool normals) {
  return {.normals = normals,
          .draco = DracoOptions{
              .position_bits = bits, .cell_size = 1.0, .speed = kSpeed, .method = method}};
}

constexpr auto kEdgebreaker = DracoMethod::edgebreaker;
constexpr auto kSequential = DracoMethod::sequential;

BENCHMARK(draco_alone)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, draco, compressed(kBits, kEdgebreaker, false))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, plain, WriteMeshOptions{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, draco_11_bits, compressed(11, kEdgebreaker, true))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, draco_14_bits, compressed(14, kEdgebreaker, true))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, draco_default, compressed(0, kEdgebreaker, true))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(glb, draco_sequential, compressed(14, kSequential, true))
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
