#define GRAZE_KERNEL_SET avx2
#define GRAZE_KERNEL_BYTES 32
#include "filter_kernels.inc"
#include "position_passes.inc"
