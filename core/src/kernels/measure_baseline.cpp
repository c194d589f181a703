#define GRAZE_KERNEL_SET baseline
#include "measure_kernels.inc"
