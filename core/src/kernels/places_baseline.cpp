#define GRAZE_KERNEL_SET baseline
#include "places_kernels.inc"
