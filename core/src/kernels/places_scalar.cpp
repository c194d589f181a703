#define GRAZE_KERNEL_SET scalar
#include "places_kernels.inc"
