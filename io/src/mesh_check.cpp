#include "mesh_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

void check_vectors(const std::filesystem::path& path, std::span<const Vec3> vectors,
                   const char* what, const char* format) {
  const double largest =
      format != nullptr ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    for (const double component : vectors[v]) {
      if (!(std::abs(component) <= largest)) {
        std::string matter = what;
        matter += " of vertex " + std::to_string(v) + " holds " + to_text(component);
        if (std::isfinite(component)) {
          matter += ", beyond the range of ";
          matter += format;
          matter += "'s float32";
        }
        fail_write(ErrorCode::invalid_value, path, matter);
      }
    }
  }
}

bool is_finite(const Vec3& vector) {
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

bool all_finite(std::span<const Vec3> vectors) {
  return std::all_of(vectors.begin(), vectors.end(), is_finite);
}

[[noreturn]] void fail_not_finite(const std::filesystem::path& path, const Mesh& mesh,
                                  std::size_t triangle, std::uint32_t vertex,
                                  const std::function<std::string(std::size_t)>& place) {
  const std::string where = place ? place(vertex) : std::string();
  fail_format(path, (where.empty() ? "" : where + ": ") + "the position of vertex " +
                        std::to_string(vertex) + ", which triangle " + std::to_string(triangle) +
                        " uses, is not finite: " + to_text(mesh.positions[vertex]));
}

template <class T>
void keep(Array<T>& values, const std::vector<bool>& is_kept) {
  if (values.size() == is_kept.size()) {
    std::size_t count = 0;
    for (std::size_t v = 0; v < is_kept.size(); ++v) {
      if (is_kept[v]) {
        values[count++] = values[v];
      }
    }
    values.resize(count);
  }
}

/// Numbers the triangles' corners as if the other vertices had never been there.
void renumber(Mesh& mesh, const std::vector<bool>& is_kept) {
  std::vector<std::uint32_t> number_of(is_kept.size());
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < is_kept.size(); ++v) {
    number_of[v] = next;
    next += is_kept[v] ? 1U : 0U;
  }
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      v = number_of[v];
    }
  }
}

}  // namespace

std::string place_of(const std::vector<VertexLine>& lines, std::size_t vertex) {
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), vertex,
                       [](const VertexLine& one, std::size_t v) { return one.vertex < v; });
  const bool is_there = found != lines.end() && found->vertex == vertex;
  return is_there ? "line " + std::to_string(found->line) : std::string();
}

void leave_out_not_finite(const std::filesystem::path& path, ScalarMesh& surface,
                          const std::function<std::string(std::size_t vertex)>& place) {
  Mesh& mesh = surface.mesh;
  if (!all_finite(mesh.normals)) {
    mesh.normals.clear();
    add_warning(surface.warnings, path, "left out the normals, as some are not finite");
  }
  if (all_finite(mesh.positions)) {
    return;
  }
  std::vector<bool> is_kept(mesh.positions.size());
  for (std::size_t v = 0; v < is_kept.size(); ++v) {
    is_kept[v] = is_finite(mesh.positions[v]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (!is_kept[v]) {
        fail_not_finite(path, mesh, t, v, place);
      }
    }
  }
  const auto lost = std::count(is_kept.begin(), is_kept.end(), false);
  add_warning(surface.warnings, path,
              "left out " + std::to_string(lost) + (lost == 1 ? " vertex" : " vertices") +
                  " without finite coordinates, which no triangle uses");
  renumber(mesh, is_kept);
  keep(mesh.positions, is_kept);
  keep(mesh.normals, is_kept);
  keep(mesh.edge_ids, is_kept);
  for (VertexScalars& one : surface.scalars) {
    keep(one.values, is_kept);
  }
}

void fail_write(ErrorCode code, const std::filesystem::path& path, const std::string& matter) {
  throw Error(code, "cannot write " + quoted(path) + ": " + matter);
}

void check_mesh(const std::filesystem::path& path, const Mesh& mesh, const char* format) {
  const std::size_t count = mesh.positions.size();
  const auto check_count = [&](std::size_t found, const char* what) {
    if (found != 0 && found != count) {
      fail_write(
          ErrorCode::invalid_argument, path,
          std::to_string(found) + " " + what + " for " + std::to_string(count) + " vertices");
    }
  };
  check_count(mesh.normals.size(), "normals");
  check_count(mesh.edge_ids.size(), "edge_ids");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= count) {
        fail_write(ErrorCode::invalid_argument, path,
                   "triangle " + std::to_string(t) + " refers to vertex " + std::to_string(v) +
                       " of " + std::to_string(count));
      }
    }
  }
  check_vectors(path, mesh.positions, "the position", format);
  check_vectors(path, mesh.normals, "the normal", nullptr);
}

}  // namespace difmesh::detail
