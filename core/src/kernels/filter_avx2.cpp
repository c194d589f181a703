#define GRAZE_KERNEL_SET avx2
#define GRAZE_KERNEL_BYTES 32
#include "kernels/filter_kernels.inc"
#include "kernels/position_passes.inc"
