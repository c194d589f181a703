#define GRAZE_KERNEL_SET avx512
#include "filter_kernels.inc"
