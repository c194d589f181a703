#define GRAZE_KERNEL_SET scalar
#include "measure_kernels.inc"
