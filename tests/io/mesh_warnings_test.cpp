// What readers of meshes tell beside the mesh.

#include <string>
#include <vector>

#include "difmesh/io/mesh_file.hpp"
#include "io/surfaces.hpp"
#include "warnings.hpp"

namespace {

using difmesh::MeshFile;
using test::TempFolder;
using Text = std::string;
using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("bytes behind a glb are left out with a warning") {
  const TempFolder folder;
  const difmesh::Mesh mesh = test::sheet(3);
  difmesh::write_mesh(folder / "m.glb", mesh);
  const std::string bytes = test::read_bytes(folder / "m.glb");
  const MeshFile whole = difmesh::read_mesh_file(folder / "m.glb");
  CHECK(whole.warnings.empty());
  for (const std::string tail : {"x", "\n\n", "glTF\2\0\0\0 and more"}) {
    const auto path = folder.file("m.glb", bytes + tail);
    const MeshFile found = difmesh::read_mesh_file(path);
    CHECK(found.mesh.positions == whole.mesh.positions);
    CHECK(found.mesh.triangles == mesh.triangles);
    CHECK(found.warnings ==
          Texts{"'" + path.string() + "': what follows the .glb file's own end at byte " +
                std::to_string(bytes.size()) + " was left out, " + std::to_string(tail.size()) +
                (tail.size() == 1 ? " byte." : " bytes.")});
    CHECK(difmesh::read_mesh(path).positions == whole.mesh.positions);
  }
}

TEST_CASE("warnings are one line of text each and come once") {
  Texts warnings;
  const auto added = [&](const std::string& path, const std::string& matter) {
    difmesh::detail::add_warning(warnings, path, matter);
    return warnings.back();
  };
  CHECK(added("a.obj", "a matter") == "'a.obj': a matter.");
  CHECK(added("a.obj", "another") == "'a.obj': another.");
  CHECK(added("a.obj", "a matter") == "'a.obj': another.");
  CHECK(warnings.size() == 2);
  CHECK(added("a\nb.obj", "\x1b[2J\xff") == R"('a\nb.obj': \x1b[2J\xff.)");
  const Text fair = Text("'gr\xc3\xb6\xc3\x9f") + "er \xe2\x82\xac.ply': yes.";
  CHECK(added(fair.substr(1, fair.find(':') - 2), "yes") == fair);
  // Cut off between characters, wherever they fall.
  for (std::size_t before = 0; before < 3; ++before) {
    Text words(before, 'x');
    for (int i = 0; i < 400; ++i) {
      words += "\xe2\x82\xac";
    }
    const Text cut = added("p", words);
    CHECK(cut.size() <= 1000);
    CHECK(cut.size() > 995);
    CHECK(cut.substr(cut.size() - 6) == "\xe2\x82\xac...");
  }
}
