#define GRAZE_KERNEL_SET avx2
#include "measure_kernels.inc"
