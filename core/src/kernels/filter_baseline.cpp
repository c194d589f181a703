#define GRAZE_KERNEL_SET baseline
#define GRAZE_KERNEL_BYTES 16
#include "kernels/filter_kernels.inc"
#include "kernels/position_passes.inc"
