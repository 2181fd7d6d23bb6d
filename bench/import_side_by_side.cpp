// A surface of 1.2 million triangles into OpenMesh and CGAL: by the adapters, and by the libraries'
// own builders with memory reserved, in turn in the same process, so that a machine that changes
// its speed changes both. Prints medians, the median of the ratios of neighbouring runs, and memory
// on the heap: of the finished mesh, and at the worst while it is built.
//   import_side_by_side [rounds]

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Surface_mesh.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "difmesh/adapters/cgal.hpp"
#include "difmesh/adapters/openmesh.hpp"
#include "difmesh/reconstruct.hpp"
#include "fields.hpp"
#include "heap.hpp"

using namespace difmesh;

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

void check(bool fine) {
  if (!fine) {
    std::fputs("a face was refused\n", stderr);
    std::exit(1);
  }
}

OpenMeshMesh openmesh_by_itself(const Mesh& mesh) {
  OpenMeshMesh other;
  other.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  std::vector<OpenMesh::VertexHandle> vertices;
  vertices.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    vertices.push_back(other.add_vertex({p[0], p[1], p[2]}));
  }
  for (const Triangle& t : mesh.triangles) {
    check(other.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid());
  }
  return other;
}

SurfaceMesh surface_mesh_by_itself(const Mesh& mesh) {
  using size_type = SurfaceMesh::size_type;
  SurfaceMesh other;
  other.reserve(static_cast<size_type>(mesh.positions.size()),
                static_cast<size_type>(3 * mesh.triangles.size() / 2),
                static_cast<size_type>(mesh.triangles.size()));
  for (const Vec3& p : mesh.positions) {
    other.add_vertex({p[0], p[1], p[2]});
  }
  using V = SurfaceMesh::Vertex_index;
  for (const Triangle& t : mesh.triangles) {
    check(other.add_face(V(t[0]), V(t[1]), V(t[2])) != SurfaceMesh::null_face());
  }
  return other;
}

/// CGAL's builder for its Polyhedron_3.
class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  explicit Builder(const Mesh& mesh) : mesh_(mesh) {}
  void operator()(Polyhedron::HalfedgeDS& hds) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(hds);
    builder.begin_surface(mesh_.positions.size(), mesh_.triangles.size());
    for (const Vec3& p : mesh_.positions) {
      builder.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    for (const Triangle& t : mesh_.triangles) {
      builder.add_facet(t.begin(), t.end());
    }
    builder.end_surface();
    check(!builder.error());
  }

 private:
  const Mesh& mesh_;
};

Polyhedron polyhedron_by_itself(const Mesh& mesh) {
  Polyhedron other;
  Builder builder(mesh);
  other.delegate(builder);
  return other;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Run {
  double seconds;
  bench::HeapUse heap;
};

template <class Build>
Run run(const Build& build) {
  const bench::HeapMeter meter;
  const auto start = std::chrono::steady_clock::now();
  const auto made = build();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return {time.count(), meter.use()};
}

template <class Ours, class Theirs>
void compare(const char* name, int rounds, const Ours& ours, const Theirs& theirs) {
  std::vector<double> our_times;
  std::vector<double> their_times;
  std::vector<double> ratios;
  Run a{};
  Run b{};
  for (int round = -1; round < rounds; ++round) {
    a = run(ours);
    b = run(theirs);
    if (round >= 0) {
      our_times.push_back(a.seconds);
      their_times.push_back(b.seconds);
      ratios.push_back(a.seconds / b.seconds);
    }
  }
  const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) * 1e-6; };
  std::printf("| %-12s | %6.0f | %6.0f | %5.2f | %5.0f / %5.0f | %5.0f / %5.0f |\n", name,
              1e3 * median(our_times), 1e3 * median(their_times), median(ratios),
              megabytes(a.heap.left), megabytes(a.heap.most), megabytes(b.heap.left),
              megabytes(b.heap.most));
  std::fflush(stdout);
}

void compare_all(const char* name, const std::vector<float>& field, std::int64_t n, int rounds) {
  const Grid grid{{n, n, n}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const Mesh mesh = reconstruct(FieldView::x_fastest(field.data(), grid.dims), grid).mesh;
  std::printf("\n%s: %zu triangles\n\n", name, mesh.triangles.size());
  std::printf("| | adapter ms | own ms | ratio | adapter MB: mesh / at worst | own MB |\n");
  std::printf("|---|---|---|---|---|---|\n");
  compare(
      "OpenMesh", rounds, [&] { return to_openmesh<OpenMeshMesh>(mesh); },
      [&] { return openmesh_by_itself(mesh); });
  compare(
      "Surface_mesh", rounds, [&] { return to_cgal<SurfaceMesh>(mesh); },
      [&] { return surface_mesh_by_itself(mesh); });
  compare(
      "Polyhedron_3", rounds, [&] { return to_cgal<Polyhedron>(mesh); },
      [&] { return polyhedron_by_itself(mesh); });
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
  compare_all("sphere", bench::sphere<float>(510), 510, rounds);
  compare_all("gyroid", bench::gyroid<float>(240), 240, rounds);
  return 0;
}
