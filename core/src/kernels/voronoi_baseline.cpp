#define GRAZE_KERNEL_SET baseline
#include "kernels/voronoi_kernels.inc"
