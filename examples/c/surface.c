/* Reads a field of volume fractions, writes its surface, and says how well their volumes agree:
 *   surface FIELD.nrrd SURFACE.ply
 */
#include <difmesh/difmesh.h>
#include <stdio.h>

static int32_t show(void* user, double share_done) {
  (void)user;
  fprintf(stderr, "\r%3.0f %%", 100.0 * share_done);
  return 0; /* anything else would cancel */
}

static dif_status run(const char* from, const char* to) {
  dif_field_file* file = NULL;
  dif_mesh* mesh = NULL;
  dif_field field;
  dif_options options;
  dif_report report;
  const double* positions;
  int64_t vertices;
  field.struct_size = sizeof field;
  dif_options_init(&options, sizeof options);
  options.progress = show;
  dif_report_init(&report, sizeof report);

  dif_status status = dif_field_read(from, NULL, &file);
  if (status == DIF_OK) {
    status = dif_field_file_field(file, &field);
  }
  if (status == DIF_OK) {
    status = dif_reconstruct(&field, &options, &mesh);
  }
  if (status == DIF_OK) {
    status = dif_mesh_report(mesh, &report);
  }
  if (status == DIF_OK) {
    status = dif_mesh_positions(mesh, &positions, &vertices);
  }
  if (status == DIF_OK) {
    printf("%lld vertices, volume %.10g, in the fractions %.10g\n", (long long)vertices,
           report.enclosed_volume, report.fraction_volume);
    status = dif_mesh_write(mesh, to, NULL, NULL);
  }
  dif_mesh_free(mesh);
  dif_field_file_free(file);
  return status;
}

int main(int argc, char** argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: %s FIELD SURFACE\n", argv[0]);
    return 2;
  }
  if (run(argv[1], argv[2]) != DIF_OK) {
    fprintf(stderr, "\n%s\n", dif_last_message());
    return 1;
  }
  return 0;
}
