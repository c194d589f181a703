#define GRAZE_KERNEL_SET baseline
#include "kernels/places_kernels.inc"
