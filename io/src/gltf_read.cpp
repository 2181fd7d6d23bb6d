#include "gltf_read.hpp"

#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gltf_extensions.hpp"
#include "gltf_primitive.hpp"
#include "gltf_source.hpp"
#include "input_file.hpp"
#include "memory.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// x -> linear x + shift.
struct Affine {
  std::array<Vec3, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows
  Vec3 shift{0, 0, 0};

  [[nodiscard]] Vec3 turned(const Vec3& v) const {
    Vec3 result{};
    for (std::size_t r = 0; r < 3; ++r) {
      result[r] = linear[r][0] * v[0] + linear[r][1] * v[1] + linear[r][2] * v[2];
    }
    return result;
  }
  [[nodiscard]] Vec3 operator()(const Vec3& v) const {
    const Vec3 t = turned(v);
    return {t[0] + shift[0], t[1] + shift[1], t[2] + shift[2]};
  }
  /// First the other, then this.
  [[nodiscard]] Affine after(const Affine& first) const {
    Affine both;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        both.linear[r][c] = linear[r][0] * first.linear[0][c] + linear[r][1] * first.linear[1][c] +
                            linear[r][2] * first.linear[2][c];
      }
    }
    both.shift = (*this)(first.shift);
    return both;
  }
  /// Cofactors: what normals are turned by, up to their length; and the determinant.
  [[nodiscard]] Affine cofactors() const {
    Affine result;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        result.linear[r][c] = linear[(r + 1) % 3][(c + 1) % 3] * linear[(r + 2) % 3][(c + 2) % 3] -
                              linear[(r + 1) % 3][(c + 2) % 3] * linear[(r + 2) % 3][(c + 1) % 3];
      }
    }
    return result;
  }
};

template <std::size_t n>
std::array<double, n> numbers_of(const JsonPlace& place) {
  if (place.size() != n) {
    place.fail("has " + std::to_string(place.size()) + " numbers, not " + std::to_string(n));
  }
  std::array<double, n> numbers{};
  for (std::size_t i = 0; i < n; ++i) {
    numbers[i] = place.at(i).finite();
  }
  return numbers;
}

std::array<Vec3, 3> rotation_of(const std::array<double, 4>& q) {
  const double s = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const auto [x, y, z, w] = q;
  return {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
           {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
           {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

/// The node that write_mesh() puts above the mesh where up is z or the unit no metre. Left out, the
/// mesh comes back in the coordinates that it was written from.
bool is_our_frame(const JsonPlace& node) {
  if (!node.has("extras") || !node.at("extras").has("difmesh")) {
    return false;
  }
  const JsonPlace extras = node.at("extras").at("difmesh");
  return extras.has("frame") && extras.at("frame").value() == true;
}

Affine transform_of(const JsonPlace& node) {
  Affine result;
  if (is_our_frame(node)) {
    return result;
  }
  if (node.has("matrix")) {
    const auto m = numbers_of<16>(node.at("matrix"));
    for (std::size_t r = 0; r < 3; ++r) {
      result.linear[r] = {m[r], m[4 + r], m[8 + r]};
      result.shift[r] = m[12 + r];
    }
    return result;
  }
  if (node.has("rotation")) {
    const auto q = numbers_of<4>(node.at("rotation"));
    if (!(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 0.0)) {
      node.at("rotation").fail("is 0");
    }
    result.linear = rotation_of(q);
  }
  if (node.has("scale")) {
    const auto scale = numbers_of<3>(node.at("scale"));
    for (Vec3& row : result.linear) {
      row = {row[0] * scale[0], row[1] * scale[1], row[2] * scale[2]};
    }
  }
  if (node.has("translation")) {
    result.shift = numbers_of<3>(node.at("translation"));
  }
  return result;
}

void move(MeshFile& content, const Affine& transform, const JsonPlace& node) {
  for (Vec3& position : content.mesh.positions) {
    position = transform(position);
    if (!std::isfinite(position[0] + position[1] + position[2])) {
      node.fail("moves vertices to infinity");
    }
  }
  const Affine cofactors = transform.cofactors();
  const double determinant = transform.linear[0][0] * cofactors.linear[0][0] +
                             transform.linear[0][1] * cofactors.linear[0][1] +
                             transform.linear[0][2] * cofactors.linear[0][2];
  const double sense = determinant < 0.0 ? -1.0 : 1.0;
  for (Vec3& normal : content.mesh.normals) {
    const Vec3 turned = cofactors.turned(normal);
    const double length = std::hypot(turned[0], turned[1], turned[2]);
    if (length > 0.0 && std::isfinite(length)) {
      normal = {sense * turned[0] / length, sense * turned[1] / length, sense * turned[2] / length};
    }
  }
  // A mirror image is seen from the other side.
  for (Triangle& t : content.mesh.triangles) {
    t = determinant < 0.0 ? Triangle{t[0], t[2], t[1]} : t;
  }
}

bool is_hidden(const JsonPlace& node) {
  if (!node.has("extensions") || !node.at("extensions").has("KHR_node_visibility")) {
    return false;
  }
  const JsonPlace visibility = node.at("extensions").at("KHR_node_visibility");
  return visibility.has("visible") && visibility.at("visible").value() == false;
}

/// The node's weights come before the mesh's.
bool is_morphed(const JsonPlace& node, const JsonPlace& mesh) {
  const JsonPlace& holder = node.has("weights") ? node : mesh;
  if (!holder.has("weights")) {
    return false;
  }
  bool is_zero = true;
  const JsonPlace weights = holder.at("weights");
  for (std::size_t w = 0; w < weights.size(); ++w) {
    is_zero = is_zero && weights.at(w).value() == 0;
  }
  const JsonPlace primitives = mesh.at("primitives");
  bool with_targets = false;
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    with_targets = with_targets || primitives.at(p).has("targets");
  }
  return !is_zero && with_targets;
}

/// The last row should be 0, 0, 0, 1; viewers leave it out as we do.
bool is_affine(const JsonPlace& node) {
  if (!node.has("matrix") || is_our_frame(node)) {
    return true;
  }
  constexpr double kRounding = 1e-6;
  const auto m = numbers_of<16>(node.at("matrix"));
  return std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1.0) <= kRounding;
}

bool is_identity(const Affine& transform) {
  const Affine none;
  return transform.linear == none.linear && transform.shift == none.shift;
}

/// Walks the nodes of the scene, parents first, in their order.
class SceneReader {
 public:
  explicit SceneReader(GltfSource& source)
      : source_(source),
        budget_(source),
        seen_(source.count("nodes"), false),
        carries_mesh_(seen_),
        parents_(seen_.size(), kNone) {}

  MeshFile read() {
    check_extensions();
    push_roots();
    while (!stack_.empty()) {
      const Pending next = std::move(stack_.back());
      stack_.pop_back();
      visit(next);
    }
    if (!with_mesh_ && source_.count("meshes") > 0) {
      source_.root().at("meshes").fail(
          "hang on no node of the scene; meshes without a place are not supported");
    }
    note_unseen();
    note_animations();
    whole_.content.warnings = source_.warnings();
    return std::move(whole_.content);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Pending {
    JsonPlace index;
    Affine above;
    std::size_t parent = kNone;
  };

  void check_extensions() {
    for (std::size_t i = 0; i < source_.count("extensionsRequired"); ++i) {
      const JsonPlace required = source_.root().at("extensionsRequired").at(i);
      if (!can_be_required(required.text())) {
        required.fail("is " + required.text() + ", which is not supported");
      }
    }
    for (std::size_t i = 0; i < source_.count("extensionsUsed"); ++i) {
      const std::string& used = source_.root().at("extensionsUsed").at(i).text();
      if (kind_of_extension(used) == ExtensionKind::unknown) {
        source_.omissions().note("the extension " + in_quotes(used),
                                 "is not known here, and what it changes was left out");
      }
    }
  }

  /// What viewers show otherwise than it is read.
  void note_omissions(const JsonPlace& node, const JsonPlace& mesh) {
    Omissions& omissions = source_.omissions();
    if (node.has("skin")) {
      omissions.note(node.place(), "has a skin, and its mesh was read as it is without bones");
    }
    if (node.has("extensions") && node.at("extensions").has("EXT_mesh_gpu_instancing")) {
      omissions.note(node.place(),
                     "has copies of its mesh by EXT_mesh_gpu_instancing, and one was read");
    }
    if (is_morphed(node, mesh)) {
      omissions.note(node.has("weights") ? node.place() : mesh.place(),
                     "has morph weights other than 0, and was read without its morph targets");
    }
  }

  /// Nodes of other scenes or of none, and meshes that no node has.
  void note_unseen() {
    std::vector<bool> placed(source_.count("meshes"), false);
    for (std::size_t n = 0; n < seen_.size(); ++n) {
      const JsonPlace node = source_.root().at("nodes").at(n);
      if (!node.has("mesh")) {
        continue;
      }
      const std::uint64_t mesh = node.at("mesh").whole();
      if (mesh < placed.size()) {
        placed[static_cast<std::size_t>(mesh)] = true;
      }
      if (!seen_[n]) {
        source_.omissions().note(
            node.place(), "has a mesh, but is not in the scene that was read, and was left out");
      }
    }
    for (std::size_t m = 0; m < placed.size(); ++m) {
      if (!placed[m]) {
        source_.omissions().note(source_.root().at("meshes").at(m).place(),
                                 "hangs on no node, and was left out");
      }
    }
  }

  /// Those that move, turn, scale or morph a mesh that was read.
  void note_animations() {
    for (std::size_t a = 0; a < source_.count("animations"); ++a) {
      const JsonPlace animation = source_.root().at("animations").at(a);
      bool moves = false;
      for (std::size_t c = 0; animation.has("channels") && c < animation.at("channels").size();
           ++c) {
        const JsonPlace channel = animation.at("channels").at(c);
        moves = moves || (channel.has("target") && is_of_a_mesh(channel.at("target")));
      }
      if (moves) {
        source_.omissions().note(animation.place(),
                                 "moves meshes, which were read as they are without it");
      }
    }
  }

  /// Whether a channel's target is a node above a mesh, or what KHR_animation_pointer may name.
  [[nodiscard]] bool is_of_a_mesh(const JsonPlace& target) const {
    if (target.has("node")) {
      (void)source_.element("nodes", target.at("node"));
      return carries_mesh_[static_cast<std::size_t>(target.at("node").whole())];
    }
    if (!target.has("extensions") || !target.at("extensions").has("KHR_animation_pointer")) {
      return false;
    }
    const JsonPlace extension = target.at("extensions").at("KHR_animation_pointer");
    const std::string pointer = extension.has("pointer") ? extension.at("pointer").text() : "";
    return pointer.starts_with("/nodes/") || pointer.starts_with("/meshes/");
  }

  void push_roots() {
    const JsonPlace root = source_.root();
    if (source_.count("scenes") > 0) {
      const JsonPlace scene = root.has("scene") ? source_.element("scenes", root.at("scene"))
                                                : root.at("scenes").at(std::size_t{0});
      if (scene.has("nodes")) {
        push(scene.at("nodes"), {});
      }
      return;
    }
    // Without scenes: every node that is nobody's child.
    std::vector<bool> is_child(seen_.size(), false);
    for (std::size_t n = 0; n < seen_.size(); ++n) {
      const JsonPlace node = root.at("nodes").at(n);
      for (std::size_t c = 0; node.has("children") && c < node.at("children").size(); ++c) {
        const JsonPlace child = node.at("children").at(c);
        (void)source_.element("nodes", child);
        is_child[static_cast<std::size_t>(child.whole())] = true;
      }
    }
    for (std::size_t n = seen_.size(); n-- > 0;) {
      if (!is_child[n]) {
        indices_.emplace_back(n);
        stack_.push_back({{source_.path(), indices_.back(), "nodes"}, {}, kNone});
      }
    }
  }

  void push(const JsonPlace& nodes, const Affine& above, std::size_t parent = kNone) {
    for (std::size_t n = nodes.size(); n-- > 0;) {
      stack_.push_back({nodes.at(n), above, parent});
    }
  }

  void visit(const Pending& pending) {
    const JsonPlace node = source_.element("nodes", pending.index);
    const auto number = static_cast<std::size_t>(pending.index.whole());
    if (seen_[number]) {
      pending.index.fail("is node " + std::to_string(number) +
                         " again; nodes have one parent and no cycles");
    }
    seen_[number] = true;
    parents_[number] = pending.parent;
    if (!is_affine(node)) {
      source_.omissions().note(
          node.place(), "has a matrix whose last row is not 0, 0, 0, 1, and that row was left out");
    }
    if (is_hidden(node)) {
      source_.omissions().note(node.place(),
                               "is hidden by KHR_node_visibility, and was read all the same");
    }
    const Affine transform = pending.above.after(transform_of(node));
    if (node.has("mesh")) {
      add_mesh(node, transform);
      for (std::size_t n = number; n != kNone && !carries_mesh_[n]; n = parents_[n]) {
        carries_mesh_[n] = true;
      }
    }
    if (node.has("children")) {
      push(node.at("children"), transform, number);
    }
  }

  void add_mesh(const JsonPlace& node, const Affine& transform) {
    const JsonPlace mesh = source_.element("meshes", node.at("mesh"));
    with_mesh_ = true;
    note_omissions(node, mesh);
    GltfSurface surface = read_gltf_mesh(source_, mesh, budget_);
    budget_.take(node, surface.bytes());
    if (!is_identity(transform)) {
      move(surface.content, transform, node);
    }
    append(whole_, std::move(surface), source_.path());
  }

  GltfSource& source_;
  Budget budget_;
  std::vector<bool> seen_;
  std::vector<bool> carries_mesh_;    ///< at the node or below it
  std::vector<std::size_t> parents_;  ///< of the nodes seen
  std::vector<Pending> stack_;
  std::deque<nlohmann::json> indices_;  ///< of roots that no scene names
  GltfSurface whole_;
  bool with_mesh_ = false;
};

MeshFile read_scene(GltfSource& source) {
  return SceneReader(source).read();
}

}  // namespace

MeshFile decode_gltf(const std::filesystem::path& path, Array<char> bytes) {
  GltfSource source(path, std::move(bytes), OtherFiles::none);
  return read_scene(source);
}

MeshFile read_gltf(const std::filesystem::path& path, const ReadMeshOptions& options) {
  Array<char> bytes;
  {
    const InputFile file(path);
    bytes = file.read_text(0, file.size());
  }
  GltfSource source(path, std::move(bytes),
                    options.outside_files ? OtherFiles::anywhere : OtherFiles::in_folder);
  return read_scene(source);
}

}  // namespace difmesh::detail
