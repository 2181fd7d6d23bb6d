#pragma once
/// \file surfaces.hpp
/// Surfaces and .glb files for the tests of glTF and Draco.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "difmesh/reconstruct.hpp"
#include "io/files.hpp"

namespace test {

inline difmesh::Mesh with_scalars(difmesh::Mesh mesh, std::vector<difmesh::VertexScalar> scalars) {
  mesh.scalars = std::move(scalars);
  return mesh;
}

using Json = nlohmann::json;

/// The surface of a ball that fills four tenths of a cube of cells, with normals and edge ids.
inline difmesh::Mesh ball(std::int64_t cells, const difmesh::Vec3& origin = {0, 0, 0},
                          double spacing = 1.0) {
  const difmesh::Grid grid{
      .dims = {cells, cells, cells}, .origin = origin, .spacing = {spacing, spacing, spacing}};
  std::vector<double> fractions;
  const double centre = 0.5 * static_cast<double>(cells - 1);
  for_cells(grid.dims, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const double r = std::hypot(static_cast<double>(i) - centre - 0.1,
                                static_cast<double>(j) - centre, static_cast<double>(k) - centre);
    fractions.push_back(std::clamp(0.4 * static_cast<double>(cells) + 0.5 - r, 0.0, 1.0));
  });
  difmesh::Options options;
  options.vertex_normals = true;
  options.edge_ids = true;
  return difmesh::reconstruct(difmesh::FieldView::x_fastest(fractions.data(), grid.dims), grid,
                              options)
      .mesh;
}

/// A grid of n x n points in the plane z = 0, of spacing 1, seen from above.
inline difmesh::Mesh sheet(std::uint32_t n) {
  difmesh::Mesh mesh;
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      mesh.positions.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
      if (i + 1 < n && j + 1 < n) {
        const std::uint32_t a = j * n + i;
        mesh.triangles.push_back({a, a + 1, a + n + 1});
        mesh.triangles.push_back({a, a + n + 1, a + n});
      }
    }
  }
  return mesh;
}

inline std::uint32_t u32_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  REQUIRE(at + 4 <= bytes.size());
  for (std::size_t b = 4; b-- > 0;) {
    value = value * 256U + static_cast<unsigned char>(bytes[at + b]);
  }
  return value;
}

/// The two chunks of a .glb file, taken apart by the letter of the format.
struct Glb {
  Json json;
  std::string data;

  Glb() = default;
  explicit Glb(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 4) == "glTF");
    REQUIRE(u32_at(bytes, 4) == 2);
    REQUIRE(u32_at(bytes, 8) == bytes.size());
    const std::size_t length = u32_at(bytes, 12);
    REQUIRE(bytes.substr(16, 4) == "JSON");
    REQUIRE(length % 4 == 0);
    json = Json::parse(bytes.substr(20, length));
    const std::size_t at = 20 + length;
    REQUIRE(bytes.substr(at + 4, 4) == std::string("BIN\0", 4));
    REQUIRE(u32_at(bytes, at) % 4 == 0);
    data = bytes.substr(at + 8, u32_at(bytes, at));
    REQUIRE(at + 8 + data.size() == bytes.size());
  }

  [[nodiscard]] std::string bytes() const {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string chunk = data;
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    const auto size = [](std::size_t n) { return bytes_of(static_cast<std::uint32_t>(n)); };
    return "glTF" + size(2) + size(28 + text.size() + chunk.size()) + size(text.size()) + "JSON" +
           text + size(chunk.size()) + std::string("BIN\0", 4) + chunk;
  }

  /// Component of an element of a plain accessor.
  template <class T>
  [[nodiscard]] T component(const Json& accessor, std::size_t element, std::size_t c) const {
    const Json& view = json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::string type = accessor.at("type");
    const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    T value{};
    const std::size_t at =
        view.at("byteOffset").get<std::size_t>() + (element * width + c) * sizeof(T);
    REQUIRE(at + sizeof(T) <= data.size());
    std::memcpy(&value, data.data() + at, sizeof value);
    return value;
  }
  [[nodiscard]] const Json& primitive(std::size_t p = 0) const {
    return json.at("meshes").at(0).at("primitives").at(p);
  }
  [[nodiscard]] const Json& attribute(const char* name, std::size_t p = 0) const {
    return json.at("accessors").at(primitive(p).at("attributes").at(name).get<std::size_t>());
  }
};

}  // namespace test
