#define GRAZE_KERNEL_SET scalar
#define GRAZE_KERNEL_BYTES 8
#include "kernels/filter_kernels.inc"
#include "kernels/position_passes.inc"
