#define GRAZE_KERNEL_SET avx512
#include "kernels/voronoi_kernels.inc"
