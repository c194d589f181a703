#define GRAZE_KERNEL_SET avx2
#include "filter_kernels.inc"
