#define GRAZE_KERNEL_SET avx512
#include "kernels/places_kernels.inc"
