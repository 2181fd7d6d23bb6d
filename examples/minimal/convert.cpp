#include <difmesh/difmesh.hpp>
#include <difmesh/io/field_file.hpp>
#include <difmesh/io/mesh_file.hpp>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "use: convert FIELD.npy MESH.ply (or .nrrd; .obj, .off, .stl)\n";
    return 2;
  }
  const difmesh::FieldFile file = difmesh::read_field(argv[1]);
  difmesh::write_mesh(argv[2], difmesh::reconstruct(file.view(), file.grid()).mesh);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
