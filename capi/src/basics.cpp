#include "boundary.hpp"
#include "difmesh/version.hpp"

const char* dif_status_name(dif_status status) {
  switch (status) {
    case DIF_OK:
      return "DIF_OK";
    case DIF_ERROR_INVALID_ARGUMENT:
      return "DIF_ERROR_INVALID_ARGUMENT";
    case DIF_ERROR_INVALID_GRID:
      return "DIF_ERROR_INVALID_GRID";
    case DIF_ERROR_INVALID_VALUE:
      return "DIF_ERROR_INVALID_VALUE";
    case DIF_ERROR_STRUCT:
      return "DIF_ERROR_STRUCT";
    case DIF_ERROR_TOO_LARGE:
      return "DIF_ERROR_TOO_LARGE";
    case DIF_ERROR_OUT_OF_MEMORY:
      return "DIF_ERROR_OUT_OF_MEMORY";
    case DIF_ERROR_CANCELLED:
      return "DIF_ERROR_CANCELLED";
    case DIF_ERROR_FILE_MISSING:
      return "DIF_ERROR_FILE_MISSING";
    case DIF_ERROR_FILE_FORMAT:
      return "DIF_ERROR_FILE_FORMAT";
    case DIF_ERROR_FILE_WRITE:
      return "DIF_ERROR_FILE_WRITE";
    case DIF_ERROR_UNSUPPORTED:
      return "DIF_ERROR_UNSUPPORTED";
    case DIF_ERROR_INTERNAL:
      return "DIF_ERROR_INTERNAL";
    default:
      return "unknown status";
  }
}
