#define GRAZE_KERNEL_SET scalar
#define GRAZE_KERNEL_BYTES 8
#include "filter_kernels.inc"
#include "position_passes.inc"
