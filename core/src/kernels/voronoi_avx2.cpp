#define GRAZE_KERNEL_SET avx2
#include "kernels/voronoi_kernels.inc"
