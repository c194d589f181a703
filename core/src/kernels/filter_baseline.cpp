#define GRAZE_KERNEL_SET baseline
#include "filter_kernels.inc"
