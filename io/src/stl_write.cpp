#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/IO/writer/STLWriter.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <cmath>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <vector>

#include "difmesh/error.hpp"
#include "mesh_formats.hpp"

namespace difmesh::detail {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::Vec3f;
using OpenMesh::VertexHandle;
using EmptyMesh = OpenMesh::TriMesh_ArrayKernelT<>;

Vec3f to_float(const Vec3& vector) {
  return {static_cast<float>(vector[0]), static_cast<float>(vector[1]),
          static_cast<float>(vector[2])};
}

/// Shows our arrays to OpenMesh's writer. There is no half-edge mesh in between: it would refuse
/// triangles on non-manifold edges and take five times the memory. What STL does not ask for is
/// answered by an empty mesh.
class SoupExporter : public OpenMesh::IO::ExporterT<EmptyMesh> {
 public:
  SoupExporter(const Mesh& mesh, const EmptyMesh& rest)
      : OpenMesh::IO::ExporterT<EmptyMesh>(rest), mesh_(mesh) {}

  using ExporterT::normal;
  Vec3f point(VertexHandle vertex) const override { return to_float(position(vertex.idx())); }

  unsigned int get_vhandles(FaceHandle face, std::vector<VertexHandle>& corners) const override {
    const Triangle& t = triangle(face);
    corners.assign({VertexHandle(static_cast<int>(t[0])), VertexHandle(static_cast<int>(t[1])),
                    VertexHandle(static_cast<int>(t[2]))});
    return 3;
  }

  /// In float64, and 0 without area, where the writer's own would be NaN.
  Vec3f normal(FaceHandle face) const override {
    const Triangle& t = triangle(face);
    const Vec3& a = mesh_.positions[t[0]];
    const Vec3& b = mesh_.positions[t[1]];
    const Vec3& c = mesh_.positions[t[2]];
    const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vec3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    Vec3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& component : n) {
      component = length > 0.0 ? component / length : 0.0;
    }
    return to_float(n);
  }

  bool has_face_normals() const override { return true; }
  size_t n_vertices() const override { return mesh_.positions.size(); }
  size_t n_faces() const override { return mesh_.triangles.size(); }

 private:
  [[nodiscard]] const Vec3& position(int index) const {
    // Handles are int; the cast back undoes the wrap of indices above 2^31 - 1.
    return mesh_.positions[static_cast<std::uint32_t>(index)];
  }
  [[nodiscard]] const Triangle& triangle(FaceHandle face) const {
    return mesh_.triangles[static_cast<std::size_t>(face.idx())];
  }
  const Mesh& mesh_;
};

/// A stream into an AtomicFile. Its errors pass through OpenMesh unchanged.
class FileStreambuf : public std::streambuf {
 public:
  explicit FileStreambuf(AtomicFile& file) : file_(file) {}

 protected:
  int_type overflow(int_type c) override {
    const char byte = traits_type::to_char_type(c);
    file_.write(&byte, 1);
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    file_.write(bytes, static_cast<std::size_t>(count));
    return count;
  }

 private:
  AtomicFile& file_;
};

/// OpenMesh reports "write binary file" to the standard log, through one stream for the whole
/// program: off while we write, one writer at a time.
class QuietLog {
 public:
  QuietLog() : lock_(mutex()), was_on_(omlog().is_enabled()) { omlog().disable(); }
  ~QuietLog() {
    if (was_on_) {
      omlog().enable();
    }
  }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
  bool was_on_;
};

}  // namespace

void write_stl(AtomicFile& file, const Mesh& mesh) {
  const QuietLog quiet;
  const EmptyMesh rest;
  SoupExporter exporter(mesh, rest);
  FileStreambuf buffer(file);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit);
  if (!OpenMesh::IO::STLWriter().write(stream, exporter, OpenMesh::IO::Options::Binary)) {
    throw Error(ErrorCode::file_write, "OpenMesh refused to write the mesh as STL");
  }
}

}  // namespace difmesh::detail
