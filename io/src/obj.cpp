#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_formats.hpp"
#include "scanner.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Reads the v, vn and f lines of Wavefront's OBJ; any other line is none of a mesh's business.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), lines_(path, text, {.comment = '#', .continued = true}) {}

  Mesh read() {
    while (lines_.next_line()) {
      const std::string_view keyword = lines_.word();
      if (keyword == "v") {
        mesh_.positions.push_back(vector("a coordinate"));
      } else if (keyword == "vn") {
        mesh_.normals.push_back(vector("a component of a normal"));
      } else if (keyword == "f") {
        face();
      }
    }
    finish();
    return std::move(mesh_);
  }

 private:
  Vec3 vector(const char* what) {
    const double x = lines_.number(what);
    const double y = lines_.number(what);
    return {x, y, lines_.number(what)};
  }

  /// An index as OBJ counts: from 1 up, or from -1 down for the latest.
  std::uint32_t index(std::string_view word, std::size_t count) const {
    const std::optional<std::int64_t> number = to_integer(word);
    const std::int64_t from_zero = !number       ? -1
                                   : *number < 0 ? *number + static_cast<std::int64_t>(count)
                                                 : *number - 1;
    if (from_zero < 0 || from_zero >= kMostVertices) {
      lines_.fail("a face refers to '" + std::string(word.substr(0, 40)) + "' of " +
                  std::to_string(count) + " vertices or normals so far");
    }
    return static_cast<std::uint32_t>(from_zero);
  }

  void face() {
    corners_.clear();
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      corners_.push_back(index(word.substr(0, slash), mesh_.positions.size()));
      if (corners_.back() >= beyond_) {
        // Vertices may come after the faces that use them: judged at the end.
        beyond_ = corners_.back() + std::size_t{1};
        beyond_line_ = lines_.line_number();
      }
      const std::size_t second = word.find('/', slash + (slash < word.size() ? 1 : 0));
      normals_fit_ = normals_fit_ && second != std::string_view::npos &&
                     index(word.substr(second + 1), mesh_.normals.size()) == corners_.back();
    }
    if (corners_.size() < 3) {
      lines_.fail("a face with " + std::to_string(corners_.size()) + " corners");
    }
    append_fan(mesh_.triangles, corners_);
  }

  void finish() {
    if (mesh_.positions.size() > static_cast<std::size_t>(kMostVertices)) {
      throw Error(ErrorCode::too_large, quoted(path_) + ": " +
                                            std::to_string(mesh_.positions.size()) +
                                            " vertices are more than 32-bit indices can name");
    }
    if (beyond_ > mesh_.positions.size()) {
      fail_format(path_, "line " + std::to_string(beyond_line_) + ": a face refers to vertex " +
                             std::to_string(beyond_) + " of " +
                             std::to_string(mesh_.positions.size()));
    }
    if (!normals_fit_ || mesh_.normals.size() != mesh_.positions.size()) {
      mesh_.normals.clear();
    }
  }

  const std::filesystem::path& path_;
  Scanner lines_;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::size_t beyond_ = 0;  ///< one above the largest index of a vertex so far
  std::int64_t beyond_line_ = 0;
  bool normals_fit_ = true;
};

void write_line(AtomicFile& file, std::string_view keyword, const Vec3& vector) {
  file.write(keyword);
  write_vector(file, vector);
  file.write("\n");
}

}  // namespace

ScalarMesh read_obj(const InputFile& file) {
  const Array<char> text = file.read_text(0, file.size());
  return {ObjReader(file.path(), plain_text(file.path(), {text.data(), text.size()})).read(), {}};
}

void write_obj(AtomicFile& file, const Mesh& mesh, bool normals) {
  file.write("# " + std::to_string(mesh.positions.size()) + " vertices, " +
             std::to_string(mesh.triangles.size()) + " triangles\n");
  for (const Vec3& position : mesh.positions) {
    write_line(file, "v ", position);
  }
  if (normals) {
    for (const Vec3& normal : mesh.normals) {
      write_line(file, "vn ", normal);
    }
  }
  for (const Triangle& t : mesh.triangles) {
    file.write("f");
    for (const std::uint32_t v : t) {
      file.write(" ");
      file.write_number(std::uint64_t{v} + 1);
      if (normals) {
        file.write("//");
        file.write_number(std::uint64_t{v} + 1);
      }
    }
    file.write("\n");
  }
}

}  // namespace difmesh::detail
