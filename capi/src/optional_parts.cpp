// Of parts that a build may lack, what is there all the same: their structs, and whether they are.

#include "boundary.hpp"
#include "difmesh/version.hpp"

namespace capi = difmesh::capi;

int32_t dif_version(void) {
  return 1000000 * DIFMESH_VERSION_MAJOR + 1000 * DIFMESH_VERSION_MINOR + DIFMESH_VERSION_PATCH;
}

const char* dif_version_text(void) {
  return DIFMESH_VERSION;
}

int32_t dif_has(int32_t part) {
  switch (part) {
#ifdef DIFMESH_WITH_TBB
    case DIF_PART_THREADS:
      return 1;
#endif
#ifdef DIFMESH_WITH_IO
    case DIF_PART_FILES:
      return 1;
#endif
#ifdef DIFMESH_WITH_METRICS
    case DIF_PART_DISTANCE:
      return 1;
#endif
#ifdef DIFMESH_WITH_GLTF
    case DIF_PART_GLTF:
      return 1;
#endif
#ifdef DIFMESH_WITH_DRACO
    case DIF_PART_DRACO:
      return 1;
#endif
    default:
      return 0;
  }
}

dif_status dif_distance_options_init(dif_distance_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    dif_distance_options value{};
    value.with_sign = 1;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_distance_init(dif_distance* distance, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(distance, struct_size, dif_distance{}, "distance"); });
}

dif_status dif_mesh_write_options_init(dif_mesh_write_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    dif_mesh_write_options value{};
    value.normals = 1;
    value.edge_ids = 1;
    value.scalars = 1;
    value.draco_speed = 5;
    value.normal_bits = 10;
    value.generic_bits = 12;
    value.metres_per_unit = 1.0;
    value.most_vertices = 0xFFFFFFFF;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_mesh_write_report_init(dif_mesh_write_report* report, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(report, struct_size, dif_mesh_write_report{}, "report"); });
}

dif_status dif_mesh_read_options_init(dif_mesh_read_options* options, uint64_t struct_size) {
  return capi::guarded(
      [&] { capi::write_struct(options, struct_size, dif_mesh_read_options{}, "options"); });
}

dif_status dif_raw_layout_init(dif_raw_layout* layout, uint64_t struct_size) {
  return capi::guarded([&] {
    dif_raw_layout value{};
    value.type = DIF_FLOAT64;
    capi::write_struct(layout, struct_size, value, "layout");
  });
}

dif_status dif_field_read_options_init(dif_field_read_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    dif_field_read_options value{};
    std::fill_n(value.spacing, 3, 1.0);
    value.full_value = 1.0;
    capi::write_struct(options, struct_size, value, "options");
  });
}

dif_status dif_field_write_options_init(dif_field_write_options* options, uint64_t struct_size) {
  return capi::guarded([&] {
    dif_field_write_options value{};
    value.gzip = 1;
    value.gzip_level = 6;
    capi::write_struct(options, struct_size, value, "options");
  });
}
