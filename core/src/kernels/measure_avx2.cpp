#define GRAZE_KERNEL_SET avx2
#include "kernels/measure_kernels.inc"
