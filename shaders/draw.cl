// Makes OpenCL kernels of a DRAW program.
#include RG_KERNEL_HEADER
#include "raster.h"
#include "blend.h"
