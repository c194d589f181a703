#define GRAZE_KERNEL_SET avx512
#include "measure_kernels.inc"
