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

/// What vectors are called in messages.
struct VectorWords {
  const char* what;
  std::size_t first_vertex;
  std::string_view float32_format;  ///< empty: float64
};

void check_vectors(const std::filesystem::path& path, std::span<const Vec3> vectors,
                   const VectorWords& words) {
  const double largest = words.float32_format.empty() ? std::numeric_limits<double>::max()
                                                      : std::numeric_limits<float>::max();
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    for (const double component : vectors[v]) {
      if (!(std::abs(component) <= largest)) {
        std::string matter = words.what;
        matter += " of vertex " + std::to_string(words.first_vertex + v) + " holds ";
        matter += to_text(component);
        if (std::isfinite(component)) {
          matter += ", beyond the range of ";
          matter += words.float32_format;
          matter += "'s float32";
        }
        fail_write(ErrorCode::invalid_value, path, matter);
      }
    }
  }
}

std::string upper_case(std::string text) {
  for (char& c : text) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return text;
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

void leave_out_not_finite(const std::filesystem::path& path, MeshFile& surface,
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
  for (VertexScalar& one : mesh.scalars) {
    keep(one.values, is_kept);
  }
}

void fail_write(ErrorCode code, const std::filesystem::path& path, const std::string& matter) {
  throw Error(code, "cannot write " + quoted(path) + ": " + matter);
}

void check_portion(const std::filesystem::path& path, const MeshPortion& portion,
                   const PortionStart& start, std::string_view float32_format) {
  const std::size_t count = portion.positions.size();
  const auto check_count = [&](std::size_t found, const std::string& what) {
    if (found != count) {
      fail_write(
          ErrorCode::invalid_argument, path,
          std::to_string(found) + " " + what + " for " + std::to_string(count) + " vertices");
    }
  };
  check_count(portion.normals.empty() ? count : portion.normals.size(), "normals");
  check_count(portion.edge_ids.empty() ? count : portion.edge_ids.size(), "edge_ids");
  for (const VertexScalar& scalar : portion.scalars) {
    check_count(scalar.values.size(), "values of " + in_quotes(scalar.name));
  }
  for (std::size_t t = 0; t < portion.triangles.size(); ++t) {
    for (const std::uint32_t v : portion.triangles[t]) {
      if (v >= start.vertices + count) {
        fail_write(ErrorCode::invalid_argument, path,
                   "triangle " + std::to_string(start.triangles + t) + " refers to vertex " +
                       std::to_string(v) + " of " + std::to_string(start.vertices + count));
      }
    }
  }
  check_vectors(path, portion.positions, {"the position", start.vertices, float32_format});
  check_vectors(path, portion.normals, {"the normal", start.vertices, {}});
}

void check_scalars(const std::filesystem::path& path, std::span<const VertexScalar> scalars,
                   std::size_t first_vertex) {
  std::vector<std::string> taken{"EDGE_ID", "VERTEX"};  // glTF's capitals
  for (const VertexScalar& scalar : scalars) {
    const auto is_good = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (scalar.name.empty() || !std::ranges::all_of(scalar.name, is_good)) {
      fail_write(ErrorCode::invalid_argument, path,
                 "scalars are called " + in_quotes(scalar.name) +
                     "; names are letters, digits and underscores");
    }
    const std::string name = upper_case(scalar.name);
    if (std::ranges::find(taken, name) != taken.end()) {
      fail_write(ErrorCode::invalid_argument, path,
                 "the name " + in_quotes(scalar.name) + " of scalars is taken");
    }
    taken.push_back(name);
    for (std::size_t v = 0; v < scalar.values.size(); ++v) {
      if (!(std::abs(scalar.values[v]) <= std::numeric_limits<float>::max())) {
        fail_write(ErrorCode::invalid_value, path,
                   in_quotes(scalar.name) + " of vertex " + std::to_string(first_vertex + v) +
                       " is " + to_text(scalar.values[v]) + ", no number of float32");
      }
    }
  }
}

}  // namespace difmesh::detail
