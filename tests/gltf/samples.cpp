// Writes every kind of file that there is of glTF and Draco, for judge.mjs, which knows the spheres
// by their formula.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/io/mesh_file.hpp"

namespace {

using difmesh::Mesh;
using difmesh::Vec3;

/// Adds a sphere in rows of latitude about a centre; vertex v of it has the id 3 v + 2^40.
void add_sphere(Mesh& mesh, std::uint32_t rows, double radius, const Vec3& centre) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::uint32_t around = 2 * rows;
  const auto put = [&](double theta, double phi) {
    const Vec3 normal{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      std::cos(theta)};
    mesh.normals.push_back(normal);
    mesh.positions.push_back({centre[0] + radius * normal[0], centre[1] + radius * normal[1],
                              centre[2] + radius * normal[2]});
    mesh.edge_ids.push_back(3 * mesh.edge_ids.size() + (std::uint64_t{1} << 40U));
  };
  put(0.0, 0.0);
  for (std::uint32_t i = 1; i < rows; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      put(std::numbers::pi * i / rows, 2.0 * std::numbers::pi * j / around);
    }
  }
  put(std::numbers::pi, 0.0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return first + 1 + (i - 1) * around + j % around;
  };
  const std::uint32_t south = first + 1 + (rows - 1) * around;
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({first, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rows; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({south, at(rows - 1, j + 1), at(rows - 1, j)});
  }
}

Mesh spheres(std::uint32_t rows, std::uint32_t count, const Vec3& place = {0, 0, 0},
             double radius = 1.5) {
  Mesh mesh;
  for (std::uint32_t s = 0; s < count; ++s) {
    add_sphere(mesh, rows, radius, {place[0] + 4.0 * radius * s, place[1], place[2]});
  }
  return mesh;
}

difmesh::VertexScalar heights(const Mesh& mesh, const Vec3& place) {
  difmesh::VertexScalar scalars{"height", {}};
  for (const Vec3& position : mesh.positions) {
    scalars.values.push_back(position[2] - place[2]);
  }
  return scalars;
}

class Samples {
 public:
  explicit Samples(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    list_.open(folder_ / "samples.jsonl");
  }

  void add(const std::string& name, std::uint32_t rows, std::uint32_t count,
           const std::function<void(difmesh::WriteMeshOptions&)>& choose = {},
           const Vec3& place = {0, 0, 0}, double radius = 1.5) {
    Mesh mesh = spheres(rows, count, place, radius);
    mesh.scalars = {heights(mesh, place)};
    difmesh::WriteMeshOptions options;
    if (choose) {
      choose(options);
    }
    const difmesh::MeshFileReport report = difmesh::write_mesh(folder_ / name, mesh, options);
    list_.precision(17);
    list_ << "{\"file\":\"" << name << "\",\"rows\":" << rows << ",\"spheres\":" << count
          << ",\"radius\":" << radius << ",\"place\":[" << place[0] << ',' << place[1] << ','
          << place[2] << "],\"vertices\":" << report.vertices
          << ",\"triangles\":" << report.triangles << ",\"primitives\":" << report.primitives
          << ",\"bits\":" << report.position_bits << ",\"error\":" << report.position_error
          << ",\"up\":\"" << (options.up == difmesh::UpAxis::z ? 'z' : 'y')
          << "\",\"metres\":" << options.metres_per_unit
          << ",\"color\":" << (options.color ? "true" : "false") << "}\n";
  }

  void one_triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    difmesh::write_mesh(folder_ / "triangle.glb", mesh);
    difmesh::write_mesh(folder_ / "triangle_draco.glb", mesh, {.draco = {{}}});
  }

  void empty_is_refused() {
    try {
      difmesh::write_mesh(folder_ / "empty.glb", {});
    } catch (const difmesh::Error& error) {
      std::cout << "empty: " << error.what() << '\n';
      return;
    }
    throw std::runtime_error("an empty surface was written");
  }

 private:
  std::filesystem::path folder_;
  std::ofstream list_;
};

void write_all(Samples& samples) {
  using Options = difmesh::WriteMeshOptions;
  const auto draco = [](int bits, difmesh::DracoMethod method) {
    return [bits, method](Options& o) {
      o.draco = difmesh::DracoOptions{.position_bits = bits, .method = method};
    };
  };
  constexpr auto kEdgebreaker = difmesh::DracoMethod::edgebreaker;
  constexpr auto kSequential = difmesh::DracoMethod::sequential;
  samples.add("plain.glb", 40, 1);
  samples.add("plain.gltf", 40, 1);
  samples.add("three.glb", 40, 3);
  samples.add("short_indices.glb", 180, 1);  // 64442 vertices
  samples.add("long_indices.glb", 182, 1);   // 65886
  samples.add("far.glb", 40, 1, {}, {1e6, -1e6, 1e6}, 0.05);
  samples.add("bare.glb", 40, 1, [](Options& o) {
    o.scalars = false;
    o.edge_ids = false;
    o.normals = false;
  });
  samples.add("colors.glb", 40, 1, [](Options& o) {
    o.color = difmesh::ColorBy{"height", difmesh::ColorMap::viridis, {}};
  });
  samples.add("split.glb", 40, 1, [](Options& o) { o.most_vertices = 500; });
  samples.add("z_up.glb", 40, 1, [](Options& o) {
    o.up = difmesh::UpAxis::z;
    o.metres_per_unit = 0.001;
  });
  samples.add("draco.glb", 40, 1, draco(0, kEdgebreaker));
  samples.add("draco_11.gltf", 40, 1, draco(11, kEdgebreaker));
  samples.add("draco_sequential.glb", 40, 1, draco(14, kSequential));
  samples.add("draco_three.glb", 40, 3, draco(14, kEdgebreaker));
  samples.add("draco_far.glb", 40, 1, draco(14, kEdgebreaker), {1e6, -1e6, 1e6}, 0.05);
  samples.add("draco_colors.glb", 40, 1, [&](Options& o) {
    draco(14, kEdgebreaker)(o);
    o.color = difmesh::ColorBy{"height", difmesh::ColorMap::cool_warm, {}};
  });
  samples.add("draco_split.glb", 40, 1, [&](Options& o) {
    draco(14, kEdgebreaker)(o);
    o.most_vertices = 500;
  });
  samples.add("alone.drc", 40, 1, draco(14, kEdgebreaker));
  samples.add("large.glb", 548, 1);  // 1.2 million triangles
  samples.add("large_draco.glb", 548, 1, draco(14, kEdgebreaker));
  samples.one_triangle();
  samples.empty_is_refused();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Samples samples(argc > 1 ? argv[1] : "samples");
    write_all(samples);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
