#define GRAZE_KERNEL_SET scalar
#include "kernels/voronoi_kernels.inc"
