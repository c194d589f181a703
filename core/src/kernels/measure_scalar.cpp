#define GRAZE_KERNEL_SET scalar
#include "kernels/measure_kernels.inc"
