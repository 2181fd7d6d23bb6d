// In place of files.cpp in a build without the part `io`.

#include "boundary.hpp"

namespace capi = difmesh::capi;

namespace {

dif_status unsupported() {
  return capi::guarded(
      [] { throw capi::Failure(DIF_ERROR_UNSUPPORTED, "this build of the library has no files"); });
}

}  // namespace

dif_status dif_mesh_write(const dif_mesh* /*mesh*/, const char* /*path*/,
                          const dif_mesh_write_options* /*options*/,
                          dif_mesh_write_report* /*report*/) {
  return unsupported();
}

dif_status dif_mesh_read(const char* /*path*/, dif_mesh** mesh) {
  if (mesh != nullptr) {
    *mesh = nullptr;
  }
  return unsupported();
}

dif_status dif_mesh_read_with(const char* /*path*/, const dif_mesh_read_options* /*options*/,
                              dif_mesh** mesh) {
  return dif_mesh_read(nullptr, mesh);
}

dif_status dif_field_read(const char* /*path*/, const dif_raw_layout* /*layout*/,
                          dif_field_file** file) {
  if (file != nullptr) {
    *file = nullptr;
  }
  return unsupported();
}

dif_status dif_field_read_with(const char* /*path*/, const dif_raw_layout* /*layout*/,
                               const dif_field_read_options* /*options*/, dif_field_file** file) {
  return dif_field_read(nullptr, nullptr, file);
}

dif_status dif_field_file_warning(const dif_field_file* /*file*/, int64_t /*index*/,
                                  const char** /*text*/) {
  return unsupported();
}

dif_status dif_field_file_type(const dif_field_file* /*file*/, int32_t* /*type*/) {
  return unsupported();
}

void dif_field_file_free(dif_field_file* /*file*/) {}

dif_status dif_field_file_field(const dif_field_file* /*file*/, dif_field* /*field*/) {
  return unsupported();
}

dif_status dif_field_write(const dif_field* /*field*/, const char* /*path*/,
                           const dif_field_write_options* /*options*/) {
  return unsupported();
}
