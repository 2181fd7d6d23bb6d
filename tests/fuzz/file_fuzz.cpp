// A reader of files on any bytes, under the name DIFMESH_FUZZ_NAME: an error, or a field that can
// be reconstructed, or a mesh that can be measured. The input is the file.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "difmesh/error.hpp"
#include "difmesh/io/field_file.hpp"
#include "difmesh/io/mesh_file.hpp"
#include "difmesh/measure.hpp"
#include "difmesh/reconstruct.hpp"

namespace {

// Larger fields are read only.
constexpr std::int64_t kMostCells = 1000;

// In memory where the system has a place for that.
std::string make_folder() {
  std::string name =
      ::access("/dev/shm", W_OK) == 0 ? "/dev/shm/difmesh_fuzz_XXXXXX" : "/tmp/difmesh_fuzz_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    std::abort();
  }
  return name;
}

// One folder for the life of the process, which a fuzzer may end at any time.
struct Place {
  std::string folder = make_folder();
  std::string path = folder + "/" DIFMESH_FUZZ_NAME;
  ~Place() {
    ::unlink(path.c_str());
    ::rmdir(folder.c_str());
  }
};

void write(const std::string& path, const std::uint8_t* data, std::size_t size) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr || std::fwrite(data, 1, size, file) != size || std::fclose(file) != 0) {
    std::abort();
  }
}

void reconstruct_read(const std::string& path, const difmesh::ReadFieldOptions& how) {
  const difmesh::FieldFile file = difmesh::read_field(path, how);
  const difmesh::Grid grid = file.grid();
  difmesh::Options options;
  options.threads = 1;
  if (grid.dims[0] * grid.dims[1] * grid.dims[2] < kMostCells) {
    static_cast<void>(difmesh::reconstruct(file.view(), grid, options));
  }
}

// With the file's word for all, and with the caller's for the grid and the values.
[[maybe_unused]] void read_field_through(const std::string& path) {
  try {
    reconstruct_read(path, {.origin = difmesh::Vec3{0, 0, 0},
                            .spacing = difmesh::Vec3{1, 2, 3},
                            .labels = {0, 1, -3}});
  } catch (const difmesh::Error&) {
    // Likewise to be expected.
  }
  reconstruct_read(path, {});
}

[[maybe_unused]] void read_mesh_through(const std::string& path) {
  const difmesh::Mesh mesh = difmesh::read_mesh(path);
  static_cast<void>(difmesh::measure(mesh));
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  write(place.path, data, size);
  try {
    DIFMESH_FUZZ_READ(place.path);
  } catch (const difmesh::Error&) {
    // The expected end.
  } catch (const std::bad_alloc&) {
    // Of a size that the file does justify.
  }
  return 0;
}
