#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "difmesh/error.hpp"
#include "format_part.hpp"
#include "mesh_check.hpp"
#include "scanner.hpp"
#include "text.hpp"
#include "warnings.hpp"

namespace difmesh::detail {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of anything and the number of triangles
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes of anything

/// Gives equal positions equal indices, in the order of their first appearance. A hash table with
/// open addresses, at most half full.
class Welder {
 public:
  explicit Welder(const std::filesystem::path& path) : path_(path), slots_(1024, kFree) {}

  std::uint32_t index_of(Vec3 position) {
    for (double& coordinate : position) {
      coordinate += 0.0;  // -0 equals 0 but has other bits
    }
    std::size_t slot = hash(position) & (slots_.size() - 1);
    while (slots_[slot] != kFree) {
      if (positions_[slots_[slot]] == position) {
        return slots_[slot];
      }
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (positions_.size() >= static_cast<std::size_t>(kMostVertices)) {
      throw Error(ErrorCode::too_large,
                  quoted(path_) + ": more vertices than 32-bit indices can name");
    }
    slots_[slot] = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(position);
    if (2 * positions_.size() > slots_.size()) {
      grow();
    }
    return static_cast<std::uint32_t>(positions_.size() - 1);
  }

  Array<Vec3> take() { return std::move(positions_); }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFF;

  static std::size_t hash(const Vec3& position) {
    std::uint64_t bits = 0;
    for (const double coordinate : position) {
      // Multiplication and shift of 64-bit words mix the bits well enough for points in space.
      bits = (bits ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15U;
      bits ^= bits >> 29U;
    }
    return static_cast<std::size_t>(bits);
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      std::size_t slot = hash(positions_[v]) & (slots_.size() - 1);
      while (slots_[slot] != kFree) {
        slot = (slot + 1) & (slots_.size() - 1);
      }
      slots_[slot] = static_cast<std::uint32_t>(v);
    }
  }

  const std::filesystem::path& path_;
  std::vector<std::uint32_t> slots_;
  Array<Vec3> positions_;
};

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[n])} << (8 * n);
  }
  return value;
}

Mesh read_binary(const std::filesystem::path& path, std::string_view bytes, std::size_t count) {
  Mesh mesh;
  mesh.triangles.resize(count);
  Welder welder(path);
  for (std::size_t t = 0; t < count; ++t) {
    const char* const corners = bytes.data() + kHeader + t * kRecord + 12;
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 position{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        position[axis] = std::bit_cast<float>(little_endian(corners + 12 * c + 4 * axis));
        if (!std::isfinite(position[axis])) {
          fail_format(path, "triangle " + std::to_string(t) + " has a corner that is not finite");
        }
      }
      mesh.triangles[t][c] = welder.index_of(position);
    }
  }
  mesh.positions = welder.take();
  return mesh;
}

enum class Word : std::uint8_t { solid, end_solid, facet, end_facet, loop, end_loop, vertex, none };

/// Reads the words `vertex x y z`, three to each loop, in any layout of lines. Of what else stands
/// in a line (normals, names, numbers behind a vertex) nothing counts, but a line starts with a
/// word of STL. `end loop`, `endsolidname` and solids without end are as common as what they stand
/// for.
class TextReader {
 public:
  TextReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), lines_(path, text, {}), welder_(path) {}

  MeshFile read() {
    while (lines_.next_line()) {
      bool is_first = true;
      for (auto word = lines_.word(); !word.empty(); word = lines_.word()) {
        // Numbers are passed over without a second look: every facet has a normal.
        const Word known = word[0] < 'A' ? Word::none : word_of(lower_case(word));
        if (known == Word::none && is_first) {
          lines_.fail(in_quotes(word) + " is no word of STL");
        }
        take(known);
        is_first = false;
      }
    }
    finish();
    result_.mesh.positions = welder_.take();
    return std::move(result_);
  }

 private:
  Word word_of(const std::string& word) {
    if (word == "vertex") {
      return Word::vertex;
    }
    if (word == "facet") {
      return Word::facet;
    }
    if (word == "outer" || word == "loop") {
      return Word::loop;
    }
    const bool is_end = word.starts_with("end");
    const std::string what = !is_end         ? word
                             : word == "end" ? lower_case(lines_.word())
                                             : word.substr(3);
    if (what.starts_with("solid")) {
      return is_end ? Word::end_solid : Word::solid;
    }
    if (!is_end) {
      return Word::none;
    }
    return what == "loop" ? Word::end_loop : what == "facet" ? Word::end_facet : Word::none;
  }

  void take(Word word) {
    switch (word) {
      case Word::solid:
      case Word::end_solid:
        check_no_facet_is_open();
        skip_name();
        is_ended_ = word == Word::end_solid;
        return;
      case Word::facet:
        check_no_facet_is_open();
        is_facet_open_ = true;
        is_ended_ = false;
        return;
      case Word::end_facet:
        check_no_facet_is_open();
        return;
      case Word::vertex:
        vertex();
        return;
      case Word::end_loop:
        end_loop();
        return;
      case Word::loop:
      case Word::none:
        return;
    }
  }

  void vertex() {
    const double x = lines_.number("a coordinate");
    const double y = lines_.number("a coordinate");
    const double z = lines_.number("a coordinate");
    if (corners_ < 3) {
      triangle_[corners_] = welder_.index_of({x, y, z});
    }
    ++corners_;
    is_ended_ = false;
  }

  void end_loop() {
    if (corners_ != 3) {
      lines_.fail("a facet with " + std::to_string(corners_) + " corners");
    }
    result_.mesh.triangles.push_back(triangle_);
    corners_ = 0;
    is_facet_open_ = false;
  }

  void check_no_facet_is_open() const {
    if (corners_ > 0 || is_facet_open_) {
      lines_.fail("the facet before has no endloop");
    }
  }

  /// Up to the end of the line, or to the first facet where a file has no lines. A name may hold
  /// words of STL too, but not all of a facet.
  void skip_name() {
    while (!lines_.rest().empty()) {
      const std::string_view rest = trimmed(lines_.rest());
      if (lower_case(rest.substr(0, 6)) == "facet " &&
          lower_case(trimmed(rest.substr(6)).substr(0, 6)) == "normal") {
        if (!holds_vertex(rest)) {
          lines_.drop_rest();
        }
        return;
      }
      (void)lines_.word();
    }
  }

  static bool holds_vertex(std::string_view text) {
    constexpr std::string_view small = "vertex";
    constexpr std::string_view large = "VERTEX";
    for (std::size_t at = 0; at + small.size() <= text.size(); ++at) {
      std::size_t n = 0;
      while (n < small.size() && (text[at + n] == small[n] || text[at + n] == large[n])) {
        ++n;
      }
      if (n == small.size()) {
        return true;
      }
    }
    return false;
  }

  void finish() {
    if (corners_ > 0 || is_facet_open_) {
      fail_format(path_, "truncated: the last facet of the STL text does not end");
    }
    if (!is_ended_ && result_.mesh.triangles.empty()) {
      fail_format(path_, "truncated: neither facets nor endsolid in the STL text");
    }
    if (!is_ended_) {
      add_warning(result_.warnings, path_,
                  "no endsolid ends the STL text: it may have been cut off");
    }
  }

  const std::filesystem::path& path_;
  Scanner lines_;
  Welder welder_;
  MeshFile result_;
  Triangle triangle_{};         ///< the corners since the last loop
  std::size_t corners_ = 0;     ///< how many
  bool is_facet_open_ = false;  ///< its loop has not ended
  bool is_ended_ = false;       ///< by endsolid
};

/// Binary files may start with "solid" too, but have zeros in their header or number of triangles.
bool is_text(std::string_view text) {
  const std::size_t start = std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size());
  return lower_case(text.substr(start, 5)) == "solid" &&
         text.substr(0, kHeader).find('\0') == std::string_view::npos;
}

}  // namespace

MeshFile read_stl(const InputFile& file) {
  const Array<char> bytes = file.read_text(0, file.size());
  const std::string_view text(bytes.data(), bytes.size());
  const std::uint64_t count = text.size() >= kHeader ? little_endian(text.data() + 80) : 0;
  const std::uint64_t size = kHeader + kRecord * count;
  const std::string_view plain = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  // The size is surer than how a file starts.
  if (text.size() != size && is_text(plain)) {
    return TextReader(file.path(), plain).read();
  }
  if (text.size() < kHeader) {
    fail_format(file.path(), "no STL file: " + std::to_string(text.size()) +
                                 " bytes that do not start with solid");
  }
  if (text.size() < size || (count == 0 && text.size() >= size + kRecord)) {
    fail_format(file.path(), "truncated or no STL file: " + std::to_string(count) +
                                 " triangles are " + std::to_string(size) + " bytes, " +
                                 std::to_string(text.size()) + " found");
  }
  MeshFile result{read_binary(file.path(), text, count), {}};
  if (text.size() > size) {
    add_warning(result.warnings, file.path(),
                count_of(text.size() - size, "byte") + " behind the last triangle left out");
  }
  return result;
}

}  // namespace difmesh::detail
