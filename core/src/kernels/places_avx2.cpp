#define GRAZE_KERNEL_SET avx2
#include "kernels/places_kernels.inc"
