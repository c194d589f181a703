#define GRAZE_KERNEL_SET avx512
#include "kernels/measure_kernels.inc"
