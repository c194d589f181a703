#define GRAZE_KERNEL_SET avx512
#define GRAZE_KERNEL_BYTES 64
#include "kernels/filter_kernels.inc"
#include "kernels/position_passes.inc"
