#define GRAZE_KERNEL_SET scalar
#include "filter_kernels.inc"
