#define GRAZE_KERNEL_SET avx2
#include "places_kernels.inc"
