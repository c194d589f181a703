#define GRAZE_KERNEL_SET baseline
#include "kernels/measure_kernels.inc"
