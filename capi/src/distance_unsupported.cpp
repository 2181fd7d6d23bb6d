// In place of distance.cpp in a build without the part `metrics`.

#include "boundary.hpp"

namespace capi = difmesh::capi;

namespace {

dif_status unsupported() {
  return capi::guarded([] {
    throw capi::Failure(DIF_ERROR_UNSUPPORTED, "this build of the library measures no distances");
  });
}

}  // namespace

dif_status dif_distance_to_shape(const dif_mesh* /*mesh*/, const dif_shape* /*shape*/,
                                 const dif_distance_options* /*options*/,
                                 dif_distance* /*distance*/) {
  return unsupported();
}

dif_status dif_distance_to_function(const dif_mesh* /*mesh*/, dif_function /*function*/,
                                    void* /*user*/, const dif_distance_options* /*options*/,
                                    dif_distance* /*distance*/) {
  return unsupported();
}

dif_status dif_distance_to_mesh(const dif_mesh* /*mesh*/, const dif_mesh* /*reference*/,
                                const dif_distance_options* /*options*/, dif_distance* /*distance*/,
                                dif_distance* /*back*/) {
  return unsupported();
}
