#define GRAZE_KERNEL_SET avx512
#include "places_kernels.inc"
