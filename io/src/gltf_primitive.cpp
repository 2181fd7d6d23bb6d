#include "gltf_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "difmesh/error.hpp"
#include "draco_codec.hpp"
#include "drc.hpp"
#include "flat_numbers.hpp"
#include "mesh_check.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::uint64_t kCopies = 64;

enum Mode : std::uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// Reads one primitive.
class PrimitiveReader {
 public:
  PrimitiveReader(GltfSource& source, JsonPlace place, Budget& budget)
      : source_(source), place_(std::move(place)), budget_(budget) {}

  GltfSurface read() {
    const JsonPlace position = place_.at("attributes").at("POSITION");
    const AccessorView positions = source_.accessor(position);
    vertices_ = positions.count;
    if (positions.components != 3) {
      positions.place.fail("holds positions, but is no VEC3");
    }
    if (positions.bytes == nullptr && place_.has("extensions") &&
        place_.at("extensions").has(kDraco)) {
      decode();
    }
    const auto count = static_cast<std::uint64_t>(place_.at("attributes").value().size());
    budget_.take(place_, vertices_ * (24U + 8U * count));
    surface_.content.mesh.positions.resize(vertices_);
    read_numbers("POSITION", positions, flat_numbers(surface_.content.mesh.positions));
    read_attributes();
    if (decoded_) {
      surface_.content.mesh.triangles = std::move(decoded_->triangles);
    } else {
      read_triangles();
    }
    leave_out_unused(positions);
    return std::move(surface_);
  }

 private:
  void decode() {
    const JsonPlace extension = place_.at("extensions").at(kDraco);
    if (place_.whole_or("mode", kTriangles) != kTriangles) {
      place_.fail("is compressed, but no list of triangles");
    }
    const std::span<const char> bytes = source_.view(extension.at("bufferView"));
    budget_.take_compressed(extension, bytes.size());
    const AccessorView indices = source_.accessor(place_.at("indices"));
    const DracoCounts promised = draco_counts(source_.path(), bytes);
    if (3 * promised.faces != indices.count) {
      extension.fail("holds " + std::to_string(promised.faces) + " triangles, its accessor " +
                     std::to_string(indices.count) + " indices");
    }
    std::vector<std::uint32_t> ids;
    const JsonPlace attributes = extension.at("attributes");
    (void)attributes.at("POSITION");
    for (const auto& [name, id] : attributes.value().items()) {
      ids.push_back(static_cast<std::uint32_t>(attributes.at(name.c_str()).whole()));
    }
    decoded_ = decode_draco(source_.path(), bytes, ids);
    if (3 * decoded_->triangles.size() != indices.count || decoded_->points != vertices_) {
      extension.fail("gives " + std::to_string(decoded_->points) + " vertices and " +
                     std::to_string(decoded_->triangles.size()) + " triangles, its accessors " +
                     std::to_string(vertices_) + " and " + std::to_string(indices.count / 3));
    }
    budget_.allow(kCopies * (vertices_ * 64U + decoded_->triangles.size() * 12U));
  }

  /// Vertices without finite coordinates, unless a triangle uses them, which fails.
  void leave_out_unused(const AccessorView& positions) {
    leave_out_not_finite(source_.path(), surface_.content, [&](std::size_t v) {
      return positions.place.place() + ", element " + std::to_string(v);
    });
    if (surface_.content.mesh.positions.size() < vertices_) {
      surface_.content.warnings.clear();
      surface_.whole_index.clear();
      source_.omissions().note(place_.place(),
                               "has vertices without finite coordinates, which no triangle uses; "
                               "they were left out");
    }
  }

  void read_attributes() {
    const JsonPlace attributes = place_.at("attributes");
    for (const auto& [name, index] : attributes.value().items()) {
      if (name != "NORMAL" && name[0] != '_') {
        continue;
      }
      const AccessorView view = source_.accessor(attributes.at(name.c_str()));
      if (view.count != vertices_) {
        view.place.fail("has " + std::to_string(view.count) + " elements for " +
                        std::to_string(vertices_) + " vertices");
      }
      const bool is_word = view.type == 5123 && !view.normalized;
      if (name == "NORMAL" && view.components == 3) {
        surface_.content.mesh.normals = vectors(name, view).value_or(Array<Vec3>());
      } else if (name == "_EDGE_ID" && view.components == 4 && is_word) {
        surface_.content.mesh.edge_ids = joined_digits(source_.path(), *numbers(name, view), 4);
      } else if (name == "_VERTEX" && view.components == 2 && is_word) {
        surface_.whole_index = joined_digits(source_.path(), *numbers(name, view), 2);
      } else if (name[0] == '_' && view.components == 1) {
        if (std::optional<Array<double>> values = numbers(name, view)) {
          surface_.content.mesh.scalars.push_back({lower_case(name.substr(1)), std::move(*values)});
        }
      }
    }
  }

  /// The attribute as Draco's data have it.
  const DecodedAttribute& in_draco(const std::string& name, const AccessorView& view) const {
    const JsonPlace ids = place_.at("extensions").at(kDraco).at("attributes");
    const std::uint64_t id = ids.at(name.c_str()).whole();
    for (const DecodedAttribute& attribute : decoded_->attributes) {
      if (attribute.id == id) {
        if (attribute.components != view.components || attribute.is_integer == view.is_float()) {
          view.place.fail("disagrees with Draco's data, which hold " +
                          std::to_string(attribute.components) +
                          (attribute.is_integer ? " whole numbers" : " numbers") + " per vertex");
        }
        return attribute;
      }
    }
    ids.at(name.c_str()).fail("is " + std::to_string(id) + ", which Draco's data do not hold");
  }

  [[nodiscard]] bool is_in_draco(const std::string& name) const {
    return decoded_ && place_.at("extensions").at(kDraco).at("attributes").has(name.c_str());
  }

  /// Component by component; without bytes zeros, as the standard says.
  void read_numbers(const std::string& name, const AccessorView& view, double* out) const {
    if (view.bytes == nullptr && is_in_draco(name)) {
      for (const double value : in_draco(name, view).values) {
        *out++ = view.scaled(value);
      }
      return;
    }
    for (std::size_t e = 0; e < view.count; ++e) {
      for (std::size_t c = 0; c < view.components; ++c) {
        *out++ = view.number(e, c);
      }
    }
  }

  /// Whether all numbers are finite. Surfaces can do without normals and scalars that are not.
  bool check_finite(const std::string& name, const AccessorView& view,
                    const double* numbers) const {
    const double* const end = numbers + view.count * view.components;
    if (std::all_of(numbers, end, [](double number) { return std::isfinite(number); })) {
      return true;
    }
    source_.omissions().note(place_.at("attributes").at(name.c_str()).place(),
                             "is not finite everywhere, and was left out");
    return false;
  }

  [[nodiscard]] std::optional<Array<double>> numbers(const std::string& name,
                                                     const AccessorView& view) const {
    Array<double> result(view.count * view.components);
    read_numbers(name, view, result.data());
    return check_finite(name, view, result.data()) ? std::optional(std::move(result))
                                                   : std::nullopt;
  }

  [[nodiscard]] std::optional<Array<Vec3>> vectors(const std::string& name,
                                                   const AccessorView& view) const {
    Array<Vec3> result(view.count);
    read_numbers(name, view, flat_numbers(result));
    return check_finite(name, view, flat_numbers(result)) ? std::optional(std::move(result))
                                                          : std::nullopt;
  }

  void read_triangles() {
    std::optional<AccessorView> view;
    std::size_t count = vertices_;
    if (place_.has("indices")) {
      view = source_.accessor(place_.at("indices"));
      count = view->count;
      const bool is_unsigned = view->type == 5121 || view->type == 5123 || view->type == 5125;
      if (view->components != 1 || !is_unsigned || view->normalized) {
        view->place.fail("holds no indices");
      }
    }
    const auto corner = [&](std::size_t i) {
      const std::uint64_t v = view ? view->whole(i, 0) : i;
      if (v >= vertices_) {
        place_.at("indices").fail("name vertex " + std::to_string(v) + " of " +
                                  std::to_string(vertices_));
      }
      return static_cast<std::uint32_t>(v);
    };
    const std::uint64_t mode = place_.whole_or("mode", kTriangles);
    if (mode == kTriangles ? count % 3 != 0 : count < 3) {
      place_.fail("has " + std::to_string(count) + " corners, which make no triangles");
    }
    const std::size_t triangles = mode == kTriangles ? count / 3 : count - 2;
    budget_.take(place_, 12U * triangles);
    surface_.content.mesh.triangles.reserve(triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      Triangle triangle{};
      if (mode == kTriangles) {
        triangle = {corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)};
      } else if (mode == kStrip) {
        triangle = {corner(t), corner(t + 1 + t % 2), corner(t + 2 - t % 2)};
      } else {
        triangle = {corner(t + 1), corner(t + 2), corner(0)};
      }
      surface_.content.mesh.triangles.push_back(triangle);
    }
  }

  GltfSource& source_;
  JsonPlace place_;
  Budget& budget_;
  std::size_t vertices_ = 0;
  std::optional<DecodedDraco> decoded_;
  GltfSurface surface_;
};

template <class T>
void gather(Array<T>& values, const std::vector<std::uint32_t>& chosen) {
  if (values.empty()) {
    return;
  }
  Array<T> gathered;
  gathered.reserve(chosen.size());
  for (const std::uint32_t v : chosen) {
    gathered.push_back(values[v]);
  }
  values = std::move(gathered);
}

/// Undoes the splitting: vertices of one index become one, in the order of the indices.
void join(GltfSurface& surface) {
  const auto count = static_cast<std::uint32_t>(surface.whole_index.size());
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    order[v] = v;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return surface.whole_index[a] < surface.whole_index[b];
  });
  std::vector<std::uint32_t> chosen;
  std::vector<std::uint32_t> place(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == 0 || surface.whole_index[order[i]] != surface.whole_index[order[i - 1]]) {
      chosen.push_back(order[i]);
    }
    place[order[i]] = static_cast<std::uint32_t>(chosen.size() - 1);
  }
  Mesh& mesh = surface.content.mesh;
  gather(mesh.positions, chosen);
  gather(mesh.normals, chosen);
  gather(mesh.edge_ids, chosen);
  for (VertexScalar& scalars : surface.content.mesh.scalars) {
    gather(scalars.values, chosen);
  }
  for (Triangle& t : mesh.triangles) {
    t = {place[t[0]], place[t[1]], place[t[2]]};
  }
  surface.whole_index.clear();
}

bool was_split(const JsonPlace& mesh) {
  if (!mesh.has("extras") || !mesh.at("extras").has("difmesh")) {
    return false;
  }
  const JsonPlace extras = mesh.at("extras").at("difmesh");
  return extras.has("split") && extras.at("split").value() == true;
}

template <class T>
void append_or_drop(Array<T>& to, const Array<T>& from) {
  if (to.empty() || from.empty()) {
    to.clear();
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
}

void append_scalars(std::vector<VertexScalar>& to, const std::vector<VertexScalar>& from) {
  std::vector<VertexScalar> kept;
  for (VertexScalar& scalars : to) {
    for (const VertexScalar& other : from) {
      if (other.name == scalars.name) {
        scalars.values.insert(scalars.values.end(), other.values.begin(), other.values.end());
        kept.push_back(std::move(scalars));
        break;
      }
    }
  }
  to = std::move(kept);
}

}  // namespace

std::uint64_t GltfSurface::bytes() const {
  const Mesh& mesh = content.mesh;
  return 24U * (mesh.positions.size() + mesh.normals.size()) + 8U * mesh.edge_ids.size() +
         12U * mesh.triangles.size() + 8U * mesh.scalars.size() * mesh.positions.size();
}

void Budget::take(const JsonPlace& place, std::uint64_t bytes) {
  const std::uint64_t limit = kCopies * (source_.bytes_read() + 1024U) + extra_;
  if (bytes > limit - std::min(limit, taken_)) {
    place.fail("takes the scene to " + std::to_string(taken_ + bytes) +
               " bytes of memory, too much for a file of " + std::to_string(source_.bytes_read()) +
               " to be trusted");
  }
  taken_ += bytes;
}

void Budget::take_compressed(const JsonPlace& place, std::uint64_t bytes) {
  compressed_ += bytes;
  if (compressed_ > 4 * source_.bytes_read()) {
    place.fail("decodes the same data of Draco again and again");
  }
}

GltfSurface read_gltf_mesh(GltfSource& source, const JsonPlace& mesh, Budget& budget) {
  GltfSurface surface;
  const JsonPlace primitives = mesh.at("primitives");
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    const JsonPlace primitive = primitives.at(p);
    const std::uint64_t mode = primitive.whole_or("mode", kTriangles);
    if (mode > kFan) {
      primitive.at("mode").fail("is " + std::to_string(mode));
    }
    if (mode < kTriangles) {
      source.omissions().note(primitive.place(), "holds points or lines, and was left out");
    } else if (!primitive.at("attributes").value().is_object()) {
      primitive.at("attributes").fail("is no object");
    } else if (!primitive.at("attributes").has("POSITION")) {
      source.omissions().note(primitive.place(), "has no POSITION, and was left out");
    } else {
      append(surface, PrimitiveReader(source, primitive, budget).read(), source.path());
    }
  }
  if (was_split(mesh) && !surface.whole_index.empty()) {
    join(surface);
  }
  surface.whole_index.clear();
  return surface;
}

void append(GltfSurface& to, GltfSurface&& from, const std::filesystem::path& path) {
  if (to.content.mesh.positions.empty()) {
    to = std::move(from);
    return;
  }
  Mesh& mesh = to.content.mesh;
  const std::size_t first = mesh.positions.size();
  if (first + from.content.mesh.positions.size() > static_cast<std::size_t>(kMostVertices)) {
    throw Error(ErrorCode::too_large,
                quoted(path) + ": more vertices than 32-bit indices can name");
  }
  const auto offset = static_cast<std::uint32_t>(first);
  for (const Triangle& t : from.content.mesh.triangles) {
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  mesh.positions.insert(mesh.positions.end(), from.content.mesh.positions.begin(),
                        from.content.mesh.positions.end());
  append_or_drop(mesh.normals, from.content.mesh.normals);
  append_or_drop(mesh.edge_ids, from.content.mesh.edge_ids);
  append_or_drop(to.whole_index, from.whole_index);
  append_scalars(mesh.scalars, from.content.mesh.scalars);
}

}  // namespace difmesh::detail
