/* A program that loads the library by name, uses it, unloads it, and goes on: what plug-ins do.
 * Threads that the library left asleep wake up after a while, and must find their code. */

#define _POSIX_C_SOURCE 200809L

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "difmesh/difmesh.h"

enum { SIDE = 64 };
static double cells[SIDE][SIDE][SIDE];

/* C forbids to cast what dlsym() gives. */
#define LOOK_UP(library, function, name)           \
  do {                                             \
    void* found = dlsym(library, name);            \
    if (found == NULL) {                           \
      fprintf(stderr, "%s is missing\n", name);    \
      return 1;                                    \
    }                                              \
    memcpy(&(function), &found, sizeof(function)); \
  } while (0)

static int use_once(const char* path) {
  dif_status (*field_init)(dif_field*, uint64_t, const void*, int32_t, const int64_t*);
  dif_status (*reconstruct)(const dif_field*, const dif_options*, dif_mesh**);
  dif_status (*triangles)(const dif_mesh*, const uint32_t**, int64_t*);
  void (*mesh_free)(dif_mesh*);
  const int64_t dims[3] = {SIDE, SIDE, SIDE};
  const uint32_t* indices = NULL;
  int64_t count = 0;
  dif_field field;
  dif_mesh* mesh = NULL;
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  LOOK_UP(library, field_init, "dif_field_init");
  LOOK_UP(library, reconstruct, "dif_reconstruct");
  LOOK_UP(library, triangles, "dif_mesh_triangles");
  LOOK_UP(library, mesh_free, "dif_mesh_free");
  if (field_init(&field, sizeof field, cells, DIF_FLOAT64, dims) != DIF_OK ||
      reconstruct(&field, NULL, &mesh) != DIF_OK || triangles(mesh, &indices, &count) != DIF_OK ||
      count < 10000) {
    fprintf(stderr, "no surface: %d triangles\n", (int)count);
    return 1;
  }
  mesh_free(mesh);
  return dlclose(library);
}

int main(int argc, char** argv) {
  const struct timespec pause = {0, 300000000};
  int round;
  int i;
  int j;
  int k;
  if (argc != 2) {
    return 2;
  }
  for (k = 0; k < SIDE; ++k) {
    for (j = 0; j < SIDE; ++j) {
      for (i = 0; i < SIDE; ++i) {
        cells[k][j][i] = (i * 7 + j * 5 + k * 3) % 11 / 10.0;
      }
    }
  }
  for (round = 0; round < 4; ++round) {
    if (use_once(argv[1]) != 0) {
      return 1;
    }
    nanosleep(&pause, NULL);
  }
  puts("still there");
  return 0;
}
