// What text files of other programs have in common, whatever their format.

#include <string>
#include <vector>

#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/printable.hpp"
#include "io/files.hpp"
#include "text.hpp"

namespace {

using difmesh::ErrorCode;
using test::TempFolder;

struct Sample {
  std::string name;
  std::string text;
};

/// A tetrahedron of volume 1/6 in every text format of meshes.
std::vector<Sample> tetrahedra() {
  const std::vector<std::string> points{"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  const std::vector<std::string> faces{"0 2 1", "0 1 3", "1 2 3", "2 0 3"};
  std::string obj;
  std::string off = "OFF\n4 4 0\n";
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  std::string stl = "solid\n";
  for (const std::string& point : points) {
    obj += "v " + point + "\n";
    off += point + "\n";
    ply += point + "\n";
  }
  for (const std::string& face : faces) {
    const auto corner = [&](std::size_t c) { return static_cast<std::size_t>(face[2 * c] - '0'); };
    obj += "f";
    stl += "facet normal 0 0 0\nouter loop\n";
    for (std::size_t c = 0; c < 3; ++c) {
      obj += " " + std::to_string(corner(c) + 1);
      stl += "vertex " + points[corner(c)] + "\n";
    }
    obj += "\n";
    stl += "endloop\nendfacet\n";
    off += "3 " + face + "\n";
    ply += "3 " + face + "\n";
  }
  stl += "endsolid\n";
  return {{"m.obj", obj}, {"m.off", off}, {"m.ply", ply}, {"m.stl", stl}};
}

std::string with_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) {
    result += c == '\n' ? end : std::string(1, c);
  }
  return result;
}

void check_tetrahedron(const Sample& sample) {
  const TempFolder folder;
  CAPTURE(sample.name);
  const difmesh::Measure m =
      difmesh::measure(difmesh::read_mesh(folder.file(sample.name, sample.text)));
  CHECK(m.triangles == 4);
  CHECK(m.vertices == 4);
  CHECK(m.closed);
  CHECK(m.volume == doctest::Approx(1.0 / 6.0));
}

std::string field_header(const std::string& encoding) {
  return "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 2\nencoding: " + encoding + "\n\n";
}

}  // namespace

TEST_CASE("a byte order mark before text is skipped") {
  for (Sample sample : tetrahedra()) {
    sample.text = "\xEF\xBB\xBF" + sample.text;
    check_tetrahedron(sample);
  }
  const TempFolder folder;
  const auto path = folder.file("f.nrrd", "\xEF\xBB\xBF" + field_header("raw") + "\x07\x09");
  const difmesh::FieldFile field = difmesh::read_field(path);
  CHECK(test::element(field.view(), 0, 0, 0) == 7);
  CHECK(test::element(field.view(), 0, 0, 1) == 9);
}

TEST_CASE("lines end with a line feed or a carriage return or both") {
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    for (Sample sample : tetrahedra()) {
      CAPTURE(end);
      sample.text = with_ends(sample.text, end);
      if (sample.name != "m.ply" || end != "\r") {
        check_tetrahedron(sample);
      }
    }
  }
}

TEST_CASE("lines are cut at any of three ends") {
  difmesh::detail::Lines lines("a\r\nb\rc\n\n\r\rd");
  const std::vector<std::string> wanted{"a", "b", "c", "", "", "", "d"};
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    const auto line = lines.next();
    REQUIRE(line);
    CHECK(*line == wanted[n]);
    CHECK(lines.number() == static_cast<std::int64_t>(n + 1));
  }
  CHECK_FALSE(lines.next());
  CHECK(lines.offset() == 11);
  difmesh::detail::Lines last("x\r");
  CHECK(last.next() == "x");
  CHECK_FALSE(last.next());
  CHECK_FALSE(difmesh::detail::Lines("").next());
}

TEST_CASE("text of UTF-16 is named as such") {
  const TempFolder folder;
  for (const Sample& sample : tetrahedra()) {
    if (sample.name == "m.stl") {
      continue;  // taken for a binary file
    }
    for (const bool big : {false, true}) {
      for (const bool mark : {false, true}) {
        std::string text = mark ? (big ? "\xFE\xFF" : "\xFF\xFE") : "";
        for (const char c : sample.text) {
          text += big ? std::string{'\0', c} : std::string{c, '\0'};
        }
        const auto path = folder.file(sample.name, text);
        test::check_error([&] { (void)difmesh::read_mesh(path); }, ErrorCode::file_format,
                          {sample.name, "UTF-16"});
      }
    }
  }
}

TEST_CASE("pointers of Git LFS and git-annex are named as such and nothing stays open") {
  const TempFolder folder;
  const std::string lfs =
      "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, '0') +
      "\nsize 12345\n";
  const std::string annex = "/annex/objects/SHA256E-s12345--" + std::string(64, '0') + ".ply\n";
  const auto open_files = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                         std::filesystem::directory_iterator{});
  };
  const auto before = open_files();
  for (const std::string name :
       {"m.ply", "m.obj", "m.off", "m.stl", "m.glb", "m.gltf", "m.drc", "f.npy", "f.nrrd"}) {
    const bool is_field = name.starts_with("f.");
    const auto read = [&](const std::string& bytes) {
      const auto path = folder.file(name, bytes);
      if (is_field) {
        (void)difmesh::read_field(path);
      } else {
        (void)difmesh::read_mesh(path);
      }
    };
    test::check_error([&] { read(lfs); }, ErrorCode::file_format, {name, "a pointer of Git LFS"});
    test::check_error([&] { read(annex); }, ErrorCode::file_format, {"a pointer of git-annex"});
  }
  const difmesh::RawLayout layout{.dims = {1, 1, static_cast<std::int64_t>(lfs.size())},
                                  .type = difmesh::ValueType::uint8};
  test::check_error([&] { (void)difmesh::read_field(folder.file("f.raw", lfs), layout); },
                    ErrorCode::file_format, {"f.raw", "a pointer of Git LFS"});
  test::check_error(
      [&] {
        (void)folder.file("data.raw", lfs);
        (void)difmesh::read_field(folder.file("f.nhdr", field_header("raw\ndata file: data.raw")));
      },
      ErrorCode::file_format, {"data.raw", "a pointer of Git LFS"});
  CHECK(open_files() == before);
}

TEST_CASE("messages are printable") {
  using difmesh::printable;
  const std::string good = "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8D\xA9 \\ ' ~";
  CHECK(printable(good) == good);
  CHECK(printable("a\nb\rc\td") == "a\\nb\\rc\\td");
  CHECK(printable(std::string("\0\x1b[31m\x7f", 7)) == "\\x00\\x1b[31m\\x7f");
  // No UTF-8: a lone lead, a lone continuation, too long a form, a surrogate, beyond the last.
  CHECK(printable("\xC3") == "\\xc3");
  CHECK(printable("\x80x") == "\\x80x");
  CHECK(printable("\xC0\xAF") == "\\xc0\\xaf");
  CHECK(printable("\xE0\x80\x80") == "\\xe0\\x80\\x80");
  CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");
  CHECK(printable("\xF4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
  CHECK(printable("\xE2\x82") == "\\xe2\\x82");
  // Controls beyond ASCII, the mark that turns text to the left, the byte order mark.
  CHECK(printable("\xC2\x85") == "\\xc2\\x85");
  CHECK(printable("\xE2\x80\xAE") == "\\xe2\\x80\\xae");
  CHECK(printable("\xEF\xBB\xBF") == "\\xef\\xbb\\xbf");
  CHECK(printable("\xEF\xBB\xBE") == "\xEF\xBB\xBE");
  CHECK(printable(printable("\x01\n")) == printable("\x01\n"));
}

TEST_CASE("quotes from files are printable and short and names of files are whole") {
  using difmesh::printable;
  using difmesh::detail::in_quotes;
  CHECK(in_quotes("a\x01") == "'a\\x01'");
  CHECK(in_quotes(std::string(80, 'x')) == "'" + std::string(80, 'x') + "'");
  CHECK(in_quotes(std::string(81, 'x')) == "'" + std::string(80, 'x') + "...'");
  CHECK(in_quotes(std::string(79, 'x') + "\xC3\xA9") == "'" + std::string(79, 'x') + "...'");
  CHECK(difmesh::detail::quoted("a\nb\x1b") == "'a\\nb\\x1b'");
  CHECK(difmesh::detail::quoted(std::string(300, 'x')) == "'" + std::string(300, 'x') + "'");
  const TempFolder folder;
  const std::string junk = "\x1b[2J\x07\xFF" + std::string(1000, 'y');
  for (const std::string text : {"f 1 2 ", "v 0 0 ", "OFF\n1 0 0\n0 0 ", "ply\nformat ",
                                 "ply\nformat ascii 1.0\nelement x 1\nproperty ", "solid\n"}) {
    const std::string name = text.starts_with("O")   ? "a\nb.off"
                             : text.starts_with("p") ? "a\nb.ply"
                             : text.starts_with("s") ? "a\nb.stl"
                                                     : "a\nb.obj";
    const auto path = folder.file(name, text + junk + "\n");
    try {
      (void)difmesh::read_mesh(path);
      FAIL("no error was thrown");
    } catch (const difmesh::Error& error) {
      const std::string message = error.what();
      CAPTURE(message);
      CHECK(message == printable(message));
      CHECK(message.find("a\\nb.") != std::string::npos);
      CHECK(message.size() < 400);
    }
  }
}

TEST_CASE("messages about files are short whatever the files hold") {
  const TempFolder folder;
  const std::string junk(100000, 'y');
  for (const std::string& text :
       {"NRRD0004\n" + junk + ": 1\n\n", "NRRD0004\ntype: " + junk + "\n\n",
        "NRRD0004\ntype: uchar\ndimension: 3\nencoding: raw\nsizes: 1 1 " + junk + "\n\n"}) {
    const auto path = folder.file("f.nrrd", text);
    try {
      (void)difmesh::read_field(path);
      FAIL("no error was thrown");
    } catch (const difmesh::Error& error) {
      const std::string message = error.what();
      CAPTURE(message);
      CHECK(message.size() < 1200);
      CHECK(message.find("yyy...") != std::string::npos);
    }
  }
}
