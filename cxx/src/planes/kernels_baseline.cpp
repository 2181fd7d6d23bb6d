#include "planes/kernels_impl.hpp"
