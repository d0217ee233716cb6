#include "backends/opencl/opencl.h"

bool opencl_sync(struct rg_device *device)
{
    struct opencl_device *opencl = (struct opencl_device *)device;
    if (!opencl->queued)
        return true;
    cl_int code = clFinish(opencl->queue);
    opencl_ended(opencl);
    return opencl_check(code, "clFinish", "device", device->info.name);
}

bool opencl_time(struct rg_device *device, int64_t *time_ns)
{
    struct opencl_device *opencl = (struct opencl_device *)device;
    const char *name = device->info.name;
    cl_event marker;
    cl_int code = clEnqueueMarkerWithWaitList(opencl->queue, 0, NULL, &marker);
    if (!opencl_check(code, "clEnqueueMarkerWithWaitList", "device", name))
        return false;
    cl_ulong end_ns = 0;
    code = clWaitForEvents(1, &marker);
    bool ok = opencl_check(code, "clWaitForEvents", "device", name);
    opencl_ended(opencl);
    if (ok) {
        code = clGetEventProfilingInfo(marker, CL_PROFILING_COMMAND_END, sizeof(end_ns), &end_ns,
                                       NULL);
        ok = opencl_check(code, "clGetEventProfilingInfo", "device", name);
    }
    clReleaseEvent(marker);
    *time_ns = (int64_t)end_ns;
    return ok;
}
