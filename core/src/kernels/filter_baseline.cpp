#define GRAZE_KERNEL_SET baseline
#define GRAZE_KERNEL_BYTES 16
#include "filter_kernels.inc"
#include "position_passes.inc"
