#include "kernels_impl.hpp"
