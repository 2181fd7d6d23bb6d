#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "boundary.hpp"
#include "convert.hpp"
#include "handles.hpp"

namespace capi = difmesh::capi;

namespace {

using difmesh::Array;
using difmesh::Triangle;
using difmesh::Vec3;

constexpr std::int64_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

template <class Element, class Pointer>
void borrow(const Array<Element>& array, const Pointer** data, int64_t* count, const char* name) {
  capi::required(data, name);
  capi::required(count, "count");
  *count = static_cast<std::int64_t>(array.size());
  *data = array.empty() ? nullptr : reinterpret_cast<const Pointer*>(array.data());
}

void check_indices(std::span<const Triangle> triangles, std::int64_t vertices) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      if (v >= vertices) {
        capi::fail_argument("triangle " + std::to_string(t) + " refers to vertex " +
                            std::to_string(v) + ", but there are " + std::to_string(vertices) +
                            " vertices");
      }
    }
  }
}

/// Room for `count` times three numbers, `stride` apart.
struct Room {
  std::int64_t stride;
  std::int64_t capacity;
  void* out;
};

void check_room(std::size_t count, const Room& room) {
  const auto n = static_cast<std::int64_t>(count);
  if (room.stride < 3) {
    capi::fail_argument("the stride is " + std::to_string(room.stride) +
                        "; it must be 3 or more, the numbers of one vertex or triangle");
  }
  if (n == 0) {
    return;
  }
  capi::required(static_cast<char*>(room.out), "out");
  if (room.capacity < 3 || (room.capacity - 3) / room.stride < n - 1) {
    capi::fail_argument("the capacity of " + std::to_string(room.capacity) +
                        " elements is too little for " + std::to_string(n) +
                        " times 3 numbers with a stride of " + std::to_string(room.stride));
  }
}

/// Each element's three numbers, made of type T by `convert`.
template <class T, class Triple, class Convert>
void copy_triples(const Array<Triple>& from, const Room& room, const Convert& convert) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    T* to = static_cast<T*>(room.out) + static_cast<std::int64_t>(i) * room.stride;
    for (std::size_t n = 0; n < 3; ++n) {
      to[n] = convert(from[i][n]);
    }
  }
}

void copy_vectors(const Array<Vec3>& from, std::int32_t type, const Room& room) {
  check_room(from.size(), room);
  if (type == DIF_FLOAT64) {
    copy_triples<double>(from, room, [](double number) { return number; });
  } else if (type == DIF_FLOAT32) {
    copy_triples<float>(from, room, [](double number) { return static_cast<float>(number); });
  } else {
    capi::fail_argument("type is " + std::to_string(type) +
                        "; DIF_FLOAT32 and DIF_FLOAT64 are possible");
  }
}

template <class T>
void copy_indices(const dif_mesh& mesh, std::int64_t first_vertex, const Room& room) {
  const auto vertices = static_cast<std::int64_t>(mesh.mesh.positions.size());
  const std::int64_t most = std::min<std::uint64_t>(std::numeric_limits<T>::max(),
                                                    std::numeric_limits<std::int64_t>::max());
  if (first_vertex > most - vertices) {
    throw difmesh::Error(difmesh::ErrorCode::too_large,
                         "the indices of " + std::to_string(vertices) +
                             " vertices do not fit into the type, counted from " +
                             std::to_string(first_vertex));
  }
  copy_triples<T>(mesh.mesh.triangles, room, [first_vertex](std::uint32_t vertex) {
    return static_cast<T>(first_vertex + vertex);
  });
}

/// \throw Error for a name that files could not hold
std::string scalars_name(const char* name) {
  const std::string text = &capi::required(name, "name");
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (text.empty() || !std::ranges::all_of(text, is_good)) {
    capi::fail_argument("name is '" + text +
                        "'; scalars have names of letters, digits and underscores");
  }
  return text;
}

}  // namespace

void dif_mesh_free(dif_mesh* mesh) {
  delete mesh;
}

dif_status dif_mesh_positions(const dif_mesh* mesh, const double** positions, int64_t* vertices) {
  return capi::guarded([&] {
    borrow(capi::required(mesh, "mesh").mesh.positions, positions, vertices, "positions");
  });
}

dif_status dif_mesh_triangles(const dif_mesh* mesh, const uint32_t** indices, int64_t* triangles) {
  return capi::guarded(
      [&] { borrow(capi::required(mesh, "mesh").mesh.triangles, indices, triangles, "indices"); });
}

dif_status dif_mesh_normals(const dif_mesh* mesh, const double** normals, int64_t* vertices) {
  return capi::guarded(
      [&] { borrow(capi::required(mesh, "mesh").mesh.normals, normals, vertices, "normals"); });
}

dif_status dif_mesh_edge_ids(const dif_mesh* mesh, const uint64_t** ids, int64_t* vertices) {
  return capi::guarded(
      [&] { borrow(capi::required(mesh, "mesh").mesh.edge_ids, ids, vertices, "ids"); });
}

dif_status dif_mesh_from_arrays(const double* positions, int64_t vertices, const uint32_t* indices,
                                int64_t triangles, dif_mesh** mesh) {
  return capi::guarded([&] {
    dif_mesh*& handle = capi::out_handle(mesh, "mesh");
    capi::required_array(positions, vertices, "positions");
    capi::required_array(indices, triangles, "indices");
    if (vertices > kMostVertices || triangles > kMostVertices) {
      throw difmesh::Error(difmesh::ErrorCode::too_large,
                           "a mesh has at most 2^32 - 1 vertices and triangles");
    }
    const std::span<const Triangle> corners(reinterpret_cast<const Triangle*>(indices),
                                            capi::to_size(triangles));
    check_indices(corners, vertices);
    const std::span<const Vec3> points = capi::to_points(positions, vertices);
    difmesh::Mesh made;
    made.positions.assign(points.begin(), points.end());
    made.triangles.assign(corners.begin(), corners.end());
    handle = new dif_mesh{std::move(made), std::nullopt};
  });
}

dif_status dif_mesh_set_normals(dif_mesh* mesh, const double* normals) {
  return capi::guarded([&] {
    difmesh::Mesh& target = capi::required(mesh, "mesh").mesh;
    const std::size_t count = normals == nullptr ? 0 : target.positions.size();
    const auto vectors = capi::to_points(normals, static_cast<std::int64_t>(count));
    target.normals = Array<Vec3>(vectors.begin(), vectors.end());
  });
}

dif_status dif_mesh_set_edge_ids(dif_mesh* mesh, const uint64_t* ids) {
  return capi::guarded([&] {
    difmesh::Mesh& target = capi::required(mesh, "mesh").mesh;
    const std::size_t count = ids == nullptr ? 0 : target.positions.size();
    target.edge_ids = Array<std::uint64_t>(ids, ids + count);
  });
}

dif_status dif_mesh_set_scalars(dif_mesh* mesh, const char* name, const double* values) {
  return capi::guarded([&] {
    difmesh::Mesh& target = capi::required(mesh, "mesh").mesh;
    const std::string key = scalars_name(name);
    const auto place = std::ranges::find(target.scalars, key, &difmesh::VertexScalar::name);
    if (values == nullptr) {
      if (place != target.scalars.end()) {
        target.scalars.erase(place);
      }
      return;
    }
    Array<double> copied(values, values + target.positions.size());
    if (place != target.scalars.end()) {
      place->values = std::move(copied);
    } else {
      target.scalars.push_back({key, std::move(copied)});
    }
  });
}

dif_status dif_mesh_scalars_name(const dif_mesh* mesh, int64_t index, const char** name) {
  return capi::guarded([&] {
    const std::vector<difmesh::VertexScalar>& scalars = capi::required(mesh, "mesh").mesh.scalars;
    capi::required(name, "name");
    if (index < 0) {
      capi::fail_argument("index is " + std::to_string(index) + "; it must not be negative");
    }
    const bool known = index < static_cast<std::int64_t>(scalars.size());
    *name = known ? scalars[static_cast<std::size_t>(index)].name.c_str() : nullptr;
  });
}

dif_status dif_mesh_scalars(const dif_mesh* mesh, const char* name, const double** values,
                            int64_t* vertices) {
  return capi::guarded([&] {
    const std::vector<difmesh::VertexScalar>& scalars = capi::required(mesh, "mesh").mesh.scalars;
    const std::string key = &capi::required(name, "name");
    const auto place = std::ranges::find(scalars, key, &difmesh::VertexScalar::name);
    if (place == scalars.end()) {
      borrow(Array<double>{}, values, vertices, "values");
    } else {
      borrow(place->values, values, vertices, "values");
    }
  });
}

dif_status dif_mesh_warning(const dif_mesh* mesh, int64_t index, const char** text) {
  return capi::guarded([&] {
    const std::vector<std::string>& warnings = capi::required(mesh, "mesh").warnings;
    capi::required(text, "text");
    if (index < 0) {
      capi::fail_argument("index is " + std::to_string(index) + "; it must not be negative");
    }
    const bool known = index < static_cast<std::int64_t>(warnings.size());
    *text = known ? warnings[static_cast<std::size_t>(index)].c_str() : nullptr;
  });
}

dif_status dif_mesh_copy_positions(const dif_mesh* mesh, int32_t type, int64_t stride,
                                   int64_t capacity, void* out) {
  return capi::guarded([&] {
    copy_vectors(capi::required(mesh, "mesh").mesh.positions, type, {stride, capacity, out});
  });
}

dif_status dif_mesh_copy_normals(const dif_mesh* mesh, int32_t type, int64_t stride,
                                 int64_t capacity, void* out) {
  return capi::guarded([&] {
    const difmesh::Mesh& source = capi::required(mesh, "mesh").mesh;
    if (source.normals.size() != source.positions.size()) {
      capi::fail_argument("the mesh has no normals; see vertex_normals in dif_options");
    }
    copy_vectors(source.normals, type, {stride, capacity, out});
  });
}

dif_status dif_mesh_copy_triangles(const dif_mesh* mesh, int32_t type, int64_t first_vertex,
                                   int64_t stride, int64_t capacity, void* out) {
  return capi::guarded([&] {
    const Room room{stride, capacity, out};
    check_room(capi::required(mesh, "mesh").mesh.triangles.size(), room);
    if (first_vertex < 0) {
      capi::fail_argument("first_vertex is " + std::to_string(first_vertex) +
                          "; it must not be negative");
    }
    switch (type) {
      case DIF_INT32:
        return copy_indices<std::int32_t>(*mesh, first_vertex, room);
      case DIF_UINT32:
        return copy_indices<std::uint32_t>(*mesh, first_vertex, room);
      case DIF_INT64:
        return copy_indices<std::int64_t>(*mesh, first_vertex, room);
      default:
        capi::fail_argument("type is " + std::to_string(type) +
                            "; DIF_INT32, DIF_UINT32 and DIF_INT64 are possible");
    }
  });
}
