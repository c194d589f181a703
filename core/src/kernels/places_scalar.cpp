#define GRAZE_KERNEL_SET scalar
#include "kernels/places_kernels.inc"
