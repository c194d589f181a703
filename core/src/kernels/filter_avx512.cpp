#define GRAZE_KERNEL_SET avx512
#define GRAZE_KERNEL_BYTES 64
#include "filter_kernels.inc"
#include "position_passes.inc"
