#include "backends/opencl/opencl.h"

cl_int opencl_set_slots(cl_kernel kernel, cl_uint next, const struct rg_kernel *info,
                        const struct rg_run *run)
{
    cl_int failed = CL_SUCCESS;
#define SET(size, value)                                                                           \
    failed = failed ? failed : clSetKernelArg(kernel, next++, (size_t)(size), value)
    for (int i = 0; i < info->slot_count; i++) {
        const struct rg_slot_info *slot = &info->slots[i];
        const struct opencl_buf *buf = (struct opencl_buf *)run->slots[slot->slot].buf;
        const struct opencl_image *image = (struct opencl_image *)run->slots[slot->slot].image;
        const cl_int count =
            buf ? (cl_int)(buf->pub.size / (size_t)slot->element_size) : image->words;
        SET(sizeof(cl_mem), buf ? &buf->memory.mem : &image->memory.mem);
        SET(sizeof(count), &count);
        if (image)
            SET(sizeof(image->shape), &image->shape);
    }
#undef SET
    return failed;
}
