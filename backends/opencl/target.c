#include "backends/opencl/opencl.h"

cl_int opencl_set_target(cl_kernel kernel, cl_uint *next, const struct rg_image *image,
                         const struct rg_draw *draw)
{
    const struct opencl_image *target = (const struct opencl_image *)image;
    const cl_int word = image ? opencl_image_word(image, draw->layer, draw->level) : 0;
    cl_int code =
        clSetKernelArg(kernel, (*next)++, sizeof(cl_mem), image ? &target->memory.mem : NULL);
    return code ? code : clSetKernelArg(kernel, (*next)++, sizeof(word), &word);
}
