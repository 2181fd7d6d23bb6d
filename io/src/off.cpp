#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "polygons.hpp"
#include "scanner.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

/// The kind of an OFF file, from its first word.
struct OffKind {
  bool normals = false;
  bool colors = false;
  bool textures = false;
};

/// By the small letters before off; nothing where they are none of OFF's.
std::optional<OffKind> kind_of(std::string_view prefix) {
  OffKind kind;
  const auto take = [&prefix](std::string_view letters, bool& there) {
    const bool is_next = prefix.starts_with(letters) && !there;
    prefix.remove_prefix(is_next ? letters.size() : 0);
    there = there || is_next;
    return is_next;
  };
  while (take("st", kind.textures) || take("c", kind.colors) || take("n", kind.normals)) {
  }
  return prefix.empty() ? std::optional<OffKind>(kind) : std::nullopt;
}

/// Passes over the keyword, which may touch the first count or be missing.
OffKind read_kind(Scanner& lines) {
  const std::string_view line = lines.rest();
  const std::vector<std::string_view> words = words_of(line.substr(0, 100));
  const std::string_view word = words.empty() ? line.substr(0, 100) : words[0];
  if (to_integer(word)) {
    return {};
  }
  const std::size_t at = lower_case(word).find("off");
  const std::string_view after = at == std::string_view::npos ? word : word.substr(at + 3);
  if (at == std::string_view::npos || (!after.empty() && !to_integer(after))) {
    lines.fail("no OFF file: it starts with " + in_quotes(word));
  }
  // A small n before OFF in capitals announces points of any dimension, not normals.
  const std::optional<OffKind> kind =
      word.starts_with("nOFF") ? std::nullopt : kind_of(lower_case(word.substr(0, at)));
  if (!kind) {
    lines.fail("OFF of kind " + in_quotes(word.substr(0, at)) +
               "; points must have three coordinates");
  }
  lines.drop(static_cast<std::size_t>(word.data() - line.data()) + at + 3);
  return *kind;
}

/// Where triangles end up once all vertices are known.
MeshFile finished(const std::filesystem::path& path, Mesh&& mesh, const Polygons& polygons,
                  const std::vector<VertexLine>& not_finite) {
  MeshFile surface{std::move(mesh), {}};
  cut_polygons(path, polygons, surface);
  leave_out_not_finite(path, surface, [&](std::size_t v) { return place_of(not_finite, v); });
  return surface;
}

/// How the words of a file make up vertices and faces.
struct OffLayout {
  bool across_lines;   ///< a vertex or face may go on in the next line
  bool vertex_extras;  ///< what follows a vertex in its line is skipped
  bool face_extras;    ///< what follows a face in its line is skipped: its colour
  bool whole;          ///< nothing may follow the last face
};

/// What Geomview reads, and more than it does where that is in use. A word can be a colour in one
/// and a coordinate in another, so all of the file must fit; the last two are for files with
/// something behind the faces, which across lines must be more faces.
constexpr std::array<OffLayout, 5> kLayouts{{{false, true, true, true},
                                             {true, false, true, true},
                                             {true, false, false, true},
                                             {false, true, true, false},
                                             {true, false, false, false}}};

/// Reads Geomview's OFF as text: a keyword, which may be missing, three counts, vertices and faces.
class OffReader {
 public:
  OffReader(const std::filesystem::path& path, std::string_view text, const OffLayout& layout)
      : path_(path), text_(text), layout_(layout), lines_(path, text, {.comment = '#'}) {}

  MeshFile read() {
    if (!lines_.next_line()) {
      fail_format(path_, "an empty file");
    }
    kind_ = read_kind(lines_);
    const std::int64_t vertices = count("the number of vertices");
    const std::int64_t faces = count("the number of faces");
    skip_edges();
    check_counts(vertices, faces);
    wanted_ = vertices + faces;
    read_vertices(vertices);
    read_faces(faces);
    return finish(faces);
  }

  /// How well the layout suits a file that read() has refused, compared with other layouts: by how
  /// much was read of it. Lines decide where there are enough of them for all items; where half of
  /// them is there, the file has more likely been cut off than been written across lines.
  [[nodiscard]] std::size_t suitability() const {
    if (!layout_.across_lines && !lacks_lines_) {
      return text_.size() + 1;
    }
    if (lacks_lines_) {
      return !layout_.across_lines && 2 * items_ >= wanted_ ? text_.size() - 1 : 0;
    }
    const std::size_t reached = lines_.offset() - lines_.rest().size();
    return trimmed(text_.substr(reached)).empty() ? text_.size() : reached;
  }

 private:
  /// The counts may stand beside the keyword or below it.
  std::int64_t count(const char* what) {
    if (trimmed(lines_.rest()).empty() && !lines_.next_line()) {
      lines_.fail(std::string("truncated: ") + what + " is missing");
    }
    const std::int64_t value = lines_.integer(what);
    if (value < 0) {
      lines_.fail(std::string(what) + " is " + std::to_string(value));
    }
    return value;
  }

  /// The number of edges may be missing and is never right.
  void skip_edges() {
    if (!layout_.across_lines) {
      lines_.drop_rest();
    } else if (!trimmed(lines_.rest()).empty()) {
      (void)lines_.word();
    } else if (lines_.next_line() && words_of(lines_.rest()).size() == 1) {
      (void)lines_.word();
    }
  }

  /// A vertex takes 6 characters at least, a face 2: no count can ask for more memory than that.
  void check_counts(std::int64_t vertices, std::int64_t faces) const {
    if (vertices > kMostVertices) {
      throw Error(ErrorCode::too_large, quoted(path_) + ": " + std::to_string(vertices) +
                                            " vertices are more than 32-bit indices can name");
    }
    const auto size = static_cast<std::int64_t>(text_.size());
    if (vertices > size / 6 || faces > size / 2) {
      fail_format(path_, "truncated: " + std::to_string(vertices) + " vertices and " +
                             std::to_string(faces) + " faces wanted in " + std::to_string(size) +
                             " bytes");
    }
  }

  /// To where an item starts: where the last one ended, or in a line of its own.
  void begin_item(const char* what, std::int64_t n, std::int64_t wanted) {
    const bool goes_on = layout_.across_lines && !trimmed(lines_.rest()).empty();
    if (!goes_on && !lines_.next_line()) {
      lacks_lines_ = layout_.face_extras;
      fail_format(path_, std::string("truncated: ") + std::to_string(wanted) + " " + what +
                             " wanted, " + std::to_string(n) + " found");
    }
    ++items_;
  }

  void end_item(bool with_extras) {
    if (with_extras) {
      lines_.drop_rest();
    }
  }

  /// To the next word, in the next line if that may be.
  void seek(const char* what) {
    if (layout_.across_lines && trimmed(lines_.rest()).empty() && !lines_.next_line()) {
      lines_.fail(std::string("truncated: ") + what + " is missing");
    }
  }

  double number(const char* what) {
    seek(what);
    return lines_.any_number(what);
  }

  std::int64_t integer(const char* what) {
    seek(what);
    return lines_.integer(what);
  }

  void read_vertices(std::int64_t wanted) {
    mesh_.positions.resize(static_cast<std::size_t>(wanted));
    mesh_.normals.resize(kind_.normals ? mesh_.positions.size() : 0);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      begin_item("vertices", static_cast<std::int64_t>(v), wanted);
      bool is_finite = true;
      for (double& coordinate : mesh_.positions[v]) {
        coordinate = number("a coordinate");
        is_finite = is_finite && std::isfinite(coordinate);
      }
      if (!is_finite) {
        not_finite_.push_back({v, lines_.line_number()});
      }
      for (std::size_t axis = 0; kind_.normals && axis < 3; ++axis) {
        mesh_.normals[v][axis] = number("a component of a normal");
      }
      const int more = (kind_.colors ? 4 : 0) + (kind_.textures ? 2 : 0);
      for (int n = 0; !layout_.vertex_extras && n < more; ++n) {
        (void)number("a component of a color or texture coordinate");
      }
      end_item(layout_.vertex_extras);
    }
  }

  void read_faces(std::int64_t wanted) {
    mesh_.triangles.reserve(static_cast<std::size_t>(wanted));
    for (std::int64_t n = 0; n < wanted; ++n) {
      begin_item("faces", n, wanted);
      read_face(n);
      polygons_.add(mesh_.triangles, corners_);
      end_item(layout_.face_extras);
    }
  }

  void read_face(std::int64_t n) {
    const std::int64_t valence = lines_.integer("the number of corners");
    if (valence < 3) {
      lines_.fail("a face with " + std::to_string(valence) + " corners");
    }
    corners_.clear();
    for (std::int64_t c = 0; c < valence; ++c) {
      const std::int64_t v = integer("a corner of the face");
      if (v < 0 || v >= static_cast<std::int64_t>(mesh_.positions.size())) {
        lines_.fail("face " + std::to_string(n) + " refers to vertex " + std::to_string(v) +
                    " of " + std::to_string(mesh_.positions.size()));
      }
      corners_.push_back(static_cast<std::uint32_t>(v));
    }
  }

  bool has_more() { return !trimmed(lines_.rest()).empty() || lines_.next_line(); }

  MeshFile finish(std::int64_t faces) {
    const bool is_followed = has_more();
    const std::int64_t line = lines_.line_number();
    if (layout_.whole && is_followed) {
      lines_.fail("more than the faces");
    }
    while (layout_.across_lines && has_more()) {
      read_face(++faces);
    }
    MeshFile surface = finished(path_, std::move(mesh_), polygons_, not_finite_);
    if (is_followed) {
      add_warning(surface.warnings, path_,
                  "skipped what follows the last face, from line " + std::to_string(line) + " on");
    }
    return surface;
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  const OffLayout& layout_;
  Scanner lines_;
  OffKind kind_;
  std::int64_t wanted_ = 0;  ///< vertices and faces
  std::int64_t items_ = 0;   ///< of them begun
  bool lacks_lines_ = false;
  Mesh mesh_;
  std::vector<std::uint32_t> corners_;  ///< of the latest face
  Polygons polygons_;
  std::vector<VertexLine> not_finite_;
};

/// Reads binary OFF: numbers of 32 bits, the highest byte first.
class BinaryOffReader {
 public:
  BinaryOffReader(const std::filesystem::path& path, std::string_view bytes, const OffKind& kind)
      : path_(path), bytes_(bytes), kind_(kind) {}

  MeshFile read() {
    const std::uint64_t vertices = count();
    const std::uint64_t faces = count();
    (void)word();  // the number of edges
    const std::size_t extras = (kind_.colors ? 4U : 0U) + (kind_.textures ? 2U : 0U);
    const std::size_t numbers = 3 + (kind_.normals ? 3U : 0U) + extras;
    // A face has its number of corners, three of them at least, and the number of its colours.
    need(vertices * numbers + faces * 5);
    mesh_.positions.resize(vertices);
    mesh_.normals.resize(kind_.normals ? vertices : 0);
    for (std::size_t v = 0; v < vertices; ++v) {
      read_vector(mesh_.positions[v]);
      if (kind_.normals) {
        read_vector(mesh_.normals[v]);
      }
      at_ += 4 * extras;
    }
    mesh_.triangles.reserve(faces);
    for (std::uint64_t n = 0; n < faces; ++n) {
      read_face(n);
    }
    return finished(path_, std::move(mesh_), polygons_, {});
  }

 private:
  void need(std::uint64_t words) const {
    if (words > (bytes_.size() - at_) / 4) {
      fail_format(path_, "truncated: " + std::to_string(4 * words) + " bytes or more wanted, " +
                             std::to_string(bytes_.size() - at_) + " found");
    }
  }

  std::uint32_t word() {
    need(1);
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      value = (value << 8U) | static_cast<unsigned char>(bytes_[at_++]);
    }
    return value;
  }

  std::uint64_t count() {
    const std::uint32_t value = word();
    if (value > 0x7FFFFFFF) {
      fail_format(path_, "a count is negative");
    }
    return value;
  }

  void read_vector(Vec3& vector) {
    for (double& component : vector) {
      component = static_cast<double>(std::bit_cast<float>(word()));
    }
  }

  void read_face(std::uint64_t n) {
    const std::uint64_t valence = count();
    if (valence < 3) {
      fail_format(path_,
                  "face " + std::to_string(n) + " has " + std::to_string(valence) + " corners");
    }
    need(valence);
    corners_.clear();
    for (std::uint64_t c = 0; c < valence; ++c) {
      corners_.push_back(word());
      if (corners_.back() >= mesh_.positions.size()) {
        fail_format(path_, "face " + std::to_string(n) + " refers to vertex " +
                               std::to_string(corners_.back()) + " of " +
                               std::to_string(mesh_.positions.size()));
      }
    }
    polygons_.add(mesh_.triangles, corners_);
    const std::uint64_t colors = count();
    need(colors);
    at_ += 4 * colors;
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  OffKind kind_;
  std::size_t at_ = 0;
  Mesh mesh_;
  Polygons polygons_;
  std::vector<std::uint32_t> corners_;
};

/// By the first layout that fits; the message of a refusal is that of the layout that suits best.
MeshFile read_text(const std::filesystem::path& path, std::string_view text) {
  std::optional<Error> refusal;
  std::size_t best = 0;
  for (const OffLayout& layout : kLayouts) {
    OffReader reader(path, text, layout);
    try {
      return reader.read();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::file_format) {
        throw;
      }
      if (!refusal || reader.suitability() >= best) {
        refusal = error;
        best = reader.suitability();
      }
    }
  }
  throw Error(*refusal);
}

MeshFile read_off(const InputFile& file) {
  const Array<char> bytes = file.read_text(0, file.size());
  const std::string_view text = plain_text(file.path(), {bytes.data(), bytes.size()});
  Scanner header(file.path(), text, {.comment = '#'});
  if (header.next_line()) {
    const OffKind kind = read_kind(header);
    if (lower_case(trimmed(header.rest()).substr(0, 6)) == "binary") {
      return BinaryOffReader(file.path(), text.substr(header.offset()), kind).read();
    }
  }
  return read_text(file.path(), text);
}

class OffEncoder : public MeshEncoder {
 public:
  explicit OffEncoder(const EncoderRequest& request) : normals_(request.contents.normals) {}

  [[nodiscard]] std::size_t vertex_sections() const override { return 1; }

  void header(ByteOutput& output, const MeshCounts& counts) override {
    output.write((normals_ ? "NOFF\n" : "OFF\n") + std::to_string(counts.vertices) + " " +
                 std::to_string(counts.triangles) + " 0\n");
  }

  void vertices(ByteOutput& output, std::size_t /*section*/, const MeshPortion& portion) override {
    for (std::size_t v = 0; v < portion.positions.size(); ++v) {
      output.write_vector(portion.positions[v]);
      if (normals_) {
        output.write(" ");
        output.write_vector(portion.normals[v]);
      }
      output.write("\n");
    }
  }

  void triangles(ByteOutput& output, const MeshPortion& portion) override {
    for (const Triangle& t : portion.triangles) {
      output.write("3");
      for (const std::uint32_t v : t) {
        output.write(" ");
        output.write_number(std::uint64_t{v});
      }
      output.write("\n");
    }
  }

 private:
  bool normals_;
};

}  // namespace

constinit const FormatPart off_format{
    .facts = {.extension = ".off", .name = "OFF", .exact = true, .normals = true},
    .read = read_open<read_off>,
    .encoder = make_encoder<OffEncoder>,
};

}  // namespace difmesh::detail
