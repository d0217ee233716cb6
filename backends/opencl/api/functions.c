// Where the driver's code lies that serves a device.
#include "backends/opencl/opencl.h"

// Each object of a driver that the ICD loader finds begins with a pointer to the table of the
// driver's own functions (the extension cl_khr_icd). The loader hands out its own, whose addresses
// tell nothing. The first function of the table may be a mark instead, in version 2 of that
// extension.
int opencl_functions(struct rg_device *device, const void **functions, int max)
{
    const cl_device_id id = ((struct opencl_device *)device)->id;
    const void *const *table = *(const void *const *const *)id;
    int count = 0;
    for (int i = 1; table && i <= 4 && count < max; i++)
        if (table[i])
            functions[count++] = table[i];
    return count;
}
