#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
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

/// First words of lines, beside v, vn and f: what a triangle mesh has no place for.
constexpr std::array<std::string_view, 29> kSkipped{
    "vt",     "vp",     "g",     "o",          "s",        "mg",     "usemtl",   "mtllib",
    "usemap", "maplib", "deg",   "bmat",       "step",     "cstype", "parm",     "trim",
    "hole",   "scrv",   "sp",    "end",        "con",      "bevel",  "c_interp", "d_interp",
    "lod",    "ctech",  "stech", "shadow_obj", "trace_obj"};

/// First words of lines that hold geometry, which is left out with a warning.
struct LeftOut {
  std::string_view word;
  std::string_view what;
};
constexpr std::string_view kFreeForm = "curves or surfaces that are no polygons";
constexpr std::string_view kCalls = "calls of other files or programs";
constexpr std::array<LeftOut, 10> kLeftOut{{{"l", "lines between points"},
                                            {"p", "points"},
                                            {"curv", kFreeForm},
                                            {"curv2", kFreeForm},
                                            {"surf", kFreeForm},
                                            {"bsp", kFreeForm},
                                            {"bzp", kFreeForm},
                                            {"cdc", kFreeForm},
                                            {"call", kCalls},
                                            {"csh", kCalls}}};

/// Lines left out, of one kind.
struct LinesLeftOut {
  std::string_view what;
  std::uint64_t count = 0;
};

/// Reads the v, vn and f lines of Wavefront's OBJ.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), lines_(path, text, {.comment = '#', .continued = true}) {}

  MeshFile read() {
    while (lines_.next_line()) {
      const std::string_view keyword = lines_.word();
      if (keyword == "v") {
        vertex();
      } else if (keyword == "vn") {
        mesh_.normals.push_back(vector("a component of a normal"));
      } else if (keyword == "f" || keyword == "fo") {
        face();
      } else {
        skip(keyword);
      }
    }
    check_words();
    check_corners();
    return finish();
  }

 private:
  /// Numbers need not be finite here, as the surface may do without them.
  Vec3 vector(const char* what) {
    const double x = lines_.any_number(what);
    const double y = lines_.any_number(what);
    return {x, y, lines_.any_number(what)};
  }

  /// A weight, which counts for curves only, or a colour may follow.
  void vertex() {
    const Vec3 position = vector("a coordinate");
    if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2])) {
      not_finite_.push_back({mesh_.positions.size(), lines_.line_number()});
    }
    mesh_.positions.push_back(position);
  }

  /// An index as OBJ counts: from 1 up, or from -1 down for the latest.
  std::uint32_t index(std::string_view word, std::size_t count) const {
    const std::optional<std::int64_t> number = to_integer(word);
    const std::int64_t from_zero = !number       ? -1
                                   : *number < 0 ? *number + static_cast<std::int64_t>(count)
                                                 : *number - 1;
    if (from_zero < 0 || from_zero >= kMostVertices) {
      lines_.fail("a face refers to " + in_quotes(word) + " of " + std::to_string(count) +
                  " vertices or normals so far");
    }
    return static_cast<std::uint32_t>(from_zero);
  }

  /// v, v/vt, v//vn or v/vt/vn, where vt and vn may be empty.
  void corner(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    corners_.push_back(index(word.substr(0, slash), mesh_.positions.size()));
    if (corners_.back() >= beyond_) {
      // Vertices may come after the faces that use them: judged at the end.
      beyond_ = corners_.back() + std::size_t{1};
      beyond_line_ = lines_.line_number();
    }
    const std::size_t second = word.find('/', slash + (slash < word.size() ? 1 : 0));
    const std::string_view normal =
        second == std::string_view::npos ? std::string_view() : word.substr(second + 1);
    normals_fit_ =
        normals_fit_ && !normal.empty() && index(normal, mesh_.normals.size()) == corners_.back();
  }

  void face() {
    corners_.clear();
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
      corner(word);
    }
    if (corners_.size() < 3) {
      lines_.fail("a face with " + std::to_string(corners_.size()) + " corners");
    }
    polygons_.add(mesh_.triangles, corners_);
  }

  void skip(std::string_view keyword) {
    const auto* const known = std::ranges::find(kLeftOut, keyword, &LeftOut::word);
    if (known != kLeftOut.end()) {
      has_words_ = true;
      const auto kind = std::ranges::find(left_out_, known->what, &LinesLeftOut::what);
      ++(kind != left_out_.end() ? *kind : left_out_.emplace_back(LinesLeftOut{known->what})).count;
    } else if (std::ranges::find(kSkipped, keyword) != kSkipped.end()) {
      has_words_ = true;
    } else if (unknown_++ == 0) {
      unknown_word_ = keyword;
      unknown_line_ = lines_.line_number();
    }
  }

  /// A page of the Web, a letter or nothing at all is no empty mesh.
  void check_words() const {
    if (!mesh_.positions.empty()) {
      return;
    }
    if (unknown_ > 0) {
      fail_format(path_, "no OBJ file: line " + std::to_string(unknown_line_) + " starts with " +
                             in_quotes(unknown_word_) + ", and no line holds a vertex");
    }
    if (!has_words_ && mesh_.triangles.empty() && text_.find('#') == std::string_view::npos) {
      fail_format(path_, "an empty file");
    }
  }

  void check_corners() const {
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
  }

  MeshFile finish() {
    if (!normals_fit_ || mesh_.normals.size() != mesh_.positions.size()) {
      mesh_.normals.clear();
    }
    MeshFile surface{std::move(mesh_), {}};
    cut_polygons(path_, polygons_, surface);
    leave_out_not_finite(path_, surface,
                         [this](std::size_t v) { return place_of(not_finite_, v); });
    for (const LinesLeftOut& kind : left_out_) {
      add_warning(surface.warnings, path_,
                  "skipped " + count_of(kind.count, "line") + " of " + std::string(kind.what));
    }
    if (unknown_ > 0) {
      add_warning(surface.warnings, path_,
                  "skipped " + count_of(static_cast<std::uint64_t>(unknown_), "line") +
                      " unknown to OBJ, the first of them line " + std::to_string(unknown_line_) +
                      ", which starts with " + in_quotes(unknown_word_));
    }
    return surface;
  }

  const std::filesystem::path& path_;
  std::string_view text_;
  Scanner lines_;
  Mesh mesh_;
  Polygons polygons_;
  std::vector<std::uint32_t> corners_;
  std::vector<VertexLine> not_finite_;
  std::size_t beyond_ = 0;  ///< one above the largest index of a vertex so far
  std::int64_t beyond_line_ = 0;
  bool normals_fit_ = true;
  bool has_words_ = false;  ///< of OBJ, beside v, vn and f
  std::vector<LinesLeftOut> left_out_;
  std::int64_t unknown_ = 0;  ///< lines that are none of OBJ's
  std::string_view unknown_word_;
  std::int64_t unknown_line_ = 0;
};

MeshFile read_obj(const InputFile& file) {
  const Array<char> text = file.read_text(0, file.size());
  return ObjReader(file.path(), plain_text(file.path(), {text.data(), text.size()})).read();
}

void write_lines(ByteOutput& output, std::string_view keyword, std::span<const Vec3> vectors) {
  for (const Vec3& vector : vectors) {
    output.write(keyword);
    output.write_vector(vector);
    output.write("\n");
  }
}

class ObjEncoder : public MeshEncoder {
 public:
  explicit ObjEncoder(const EncoderRequest& request) : normals_(request.contents.normals) {}

  [[nodiscard]] std::size_t vertex_sections() const override { return normals_ ? 2 : 1; }

  void header(ByteOutput& output, const MeshCounts& counts) override {
    output.write("# " + std::to_string(counts.vertices) + " vertices, " +
                 std::to_string(counts.triangles) + " triangles\n");
  }

  void vertices(ByteOutput& output, std::size_t section, const MeshPortion& portion) override {
    section == 0 ? write_lines(output, "v ", portion.positions)
                 : write_lines(output, "vn ", portion.normals);
  }

  void triangles(ByteOutput& output, const MeshPortion& portion) override {
    for (const Triangle& t : portion.triangles) {
      output.write("f");
      for (const std::uint32_t v : t) {
        output.write(" ");
        output.write_number(std::uint64_t{v} + 1);
        if (normals_) {
          output.write("//");
          output.write_number(std::uint64_t{v} + 1);
        }
      }
      output.write("\n");
    }
  }

 private:
  bool normals_;
};

}  // namespace

constinit const FormatPart obj_format{
    .facts = {.extension = ".obj", .name = "OBJ", .exact = true, .normals = true},
    .read = read_open<read_obj>,
    .encoder = make_encoder<ObjEncoder>,
};

}  // namespace difmesh::detail
