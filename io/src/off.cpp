#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_formats.hpp"
#include "scanner.hpp"
#include "text.hpp"

namespace difmesh::detail {
namespace {

/// Reads Geomview's OFF: a keyword, three counts, a line per vertex and a line per face.
class OffReader {
 public:
  OffReader(const std::filesystem::path& path, std::string_view text)
      : text_size_(static_cast<std::int64_t>(text.size())),
        path_(path),
        lines_(path, text, {.comment = '#'}) {}

  Mesh read() {
    keyword();
    const std::int64_t vertices = count("the number of vertices");
    const std::int64_t faces = count("the number of faces");
    // The number of edges may be missing and is never right.
    check_counts(vertices, faces);
    read_vertices(vertices);
    read_faces(faces);
    return std::move(mesh_);
  }

 private:
  void keyword() {
    if (!lines_.next_line()) {
      fail_format(path_, "an empty file");
    }
    std::string_view word = lines_.word();
    if (!word.ends_with("OFF")) {
      lines_.fail("no OFF file: it starts with '" + std::string(word.substr(0, 20)) + "'");
    }
    word.remove_suffix(3);
    for (const std::string_view prefix : {"ST", "C", "N"}) {
      if (word.starts_with(prefix)) {
        word.remove_prefix(prefix.size());
        normals_ = normals_ || prefix == "N";
      }
    }
    if (!word.empty()) {
      lines_.fail("OFF of kind '" + std::string(word.substr(0, 20)) +
                  "'; points must have three coordinates");
    }
  }

  /// The counts may stand beside the keyword or below it.
  std::int64_t count(const char* what) {
    if (trimmed(lines_.rest()).empty() && !lines_.next_line()) {
      lines_.fail(std::string("truncated: ") + what + " is missing");
    }
    if (lines_.rest().find("BINARY") != std::string_view::npos) {
      lines_.fail("binary OFF; only text can be read");
    }
    const std::int64_t value = lines_.integer(what);
    if (value < 0) {
      lines_.fail(std::string(what) + " is " + std::to_string(value));
    }
    return value;
  }

  /// A vertex takes 6 characters at least, a face 2: no count can ask for more memory than that.
  void check_counts(std::int64_t vertices, std::int64_t faces) const {
    if (vertices > kMostVertices) {
      throw Error(ErrorCode::too_large, quoted(path_) + ": " + std::to_string(vertices) +
                                            " vertices are more than 32-bit indices can name");
    }
    if (vertices > text_size_ / 6 || faces > text_size_ / 2) {
      fail_format(path_, "truncated: " + std::to_string(vertices) + " vertices and " +
                             std::to_string(faces) + " faces wanted in " +
                             std::to_string(text_size_) + " bytes");
    }
  }

  void line_of(const char* what, std::int64_t n, std::int64_t wanted) {
    if (!lines_.next_line()) {
      fail_format(path_, std::string("truncated: ") + std::to_string(wanted) + " " + what +
                             " wanted, " + std::to_string(n) + " found");
    }
  }

  void read_vertices(std::int64_t wanted) {
    mesh_.positions.resize(static_cast<std::size_t>(wanted));
    mesh_.normals.resize(normals_ ? mesh_.positions.size() : 0);
    for (std::int64_t n = 0; n < wanted; ++n) {
      line_of("vertices", n, wanted);
      for (double& coordinate : mesh_.positions[static_cast<std::size_t>(n)]) {
        coordinate = lines_.number("a coordinate");
      }
      if (normals_) {
        for (double& component : mesh_.normals[static_cast<std::size_t>(n)]) {
          component = lines_.number("a component of a normal");
        }
      }
    }
  }

  void read_faces(std::int64_t wanted) {
    mesh_.triangles.reserve(static_cast<std::size_t>(wanted));
    std::vector<std::uint32_t> corners;
    for (std::int64_t n = 0; n < wanted; ++n) {
      line_of("faces", n, wanted);
      const std::int64_t valence = lines_.integer("the number of corners");
      if (valence < 3) {
        lines_.fail("a face with " + std::to_string(valence) + " corners");
      }
      corners.clear();
      for (std::int64_t c = 0; c < valence; ++c) {
        const std::int64_t v = lines_.integer("a corner of the face");
        if (v < 0 || v >= static_cast<std::int64_t>(mesh_.positions.size())) {
          lines_.fail("face " + std::to_string(n) + " refers to vertex " + std::to_string(v) +
                      " of " + std::to_string(mesh_.positions.size()));
        }
        corners.push_back(static_cast<std::uint32_t>(v));
      }
      append_fan(mesh_.triangles, corners);
    }
  }

  std::int64_t text_size_;
  const std::filesystem::path& path_;
  Scanner lines_;
  bool normals_ = false;
  Mesh mesh_;
};

}  // namespace

ScalarMesh read_off(const InputFile& file) {
  const Array<char> text = file.read_text(0, file.size());
  return {OffReader(file.path(), plain_text(file.path(), {text.data(), text.size()})).read(), {}};
}

void write_off(AtomicFile& file, const Mesh& mesh, bool normals) {
  file.write(normals ? "NOFF\n" : "OFF\n");
  file.write(std::to_string(mesh.positions.size()) + " " + std::to_string(mesh.triangles.size()) +
             " 0\n");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    write_vector(file, mesh.positions[v]);
    if (normals) {
      file.write(" ");
      write_vector(file, mesh.normals[v]);
    }
    file.write("\n");
  }
  for (const Triangle& t : mesh.triangles) {
    file.write("3");
    for (const std::uint32_t v : t) {
      file.write(" ");
      file.write_number(std::uint64_t{v});
    }
    file.write("\n");
  }
}

}  // namespace difmesh::detail
