// Finds the driver's code that serves a device.
#include "backends/opencl/opencl.h"

// The ICD loader exports only its own functions. But each object of a driver begins with a pointer
// to the driver's function table (the extension cl_khr_icd). In version 2 of that extension, the
// table's first entry may be a mark instead.
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
