#include "backends/opencl/opencl.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

bool opencl_memory_create(struct opencl_memory *memory, size_t size)
{
    cl_int code;
    memory->mem = clCreateBuffer(memory->device->context, CL_MEM_READ_WRITE, size, NULL, &code);
    return opencl_check(code, "clCreateBuffer", memory->kind, memory->name);
}

// Larger writes are not copied; the call waits for the device instead.
enum { MAX_STAGED_BYTES = 64 << 20 };

// Copies the caller's data, so that the device may read it after the call; NULL: wait instead.
static void *stage(struct opencl_device *device, const void *data, size_t size)
{
    if (size > MAX_STAGED_BYTES - device->staged_bytes)
        return NULL;
    struct opencl_staged *staged = malloc(sizeof(*staged) + size);
    if (!staged)
        return NULL;
    memcpy(staged->data, data, size);
    staged->next = device->staged;
    device->staged = staged;
    device->staged_bytes += size;
    return staged->data;
}

bool opencl_memory_write(const struct opencl_memory *memory, size_t offset, const void *data,
                         size_t size)
{
    struct opencl_device *device = memory->device;
    const void *staged = device->queued ? stage(device, data, size) : NULL;
    if (staged && !opencl_will_queue(device))
        return false;
    cl_int code = clEnqueueWriteBuffer(device->queue, memory->mem, staged ? CL_FALSE : CL_TRUE,
                                       offset, size, staged ? staged : data, 0, NULL, NULL);
    if (!opencl_check(code, "clEnqueueWriteBuffer", memory->kind, memory->name))
        return false;
    if (!staged)
        opencl_ended(device);
    return true;
}

bool opencl_memory_read(const struct opencl_memory *memory, size_t offset, void *data, size_t size)
{
    struct opencl_device *device = memory->device;
    cl_int code =
        clEnqueueReadBuffer(device->queue, memory->mem, CL_TRUE, offset, size, data, 0, NULL, NULL);
    if (!opencl_check(code, "clEnqueueReadBuffer", memory->kind, memory->name))
        return false;
    opencl_ended(device);
    return true;
}

struct rg_buf *opencl_buf_create(struct rg_device *device, size_t size, const char *name)
{
    struct opencl_buf *buf = rg_alloc(1, sizeof(*buf), name);
    if (!buf)
        return NULL;
    buf->memory = (struct opencl_memory){NULL, (struct opencl_device *)device, "buffer", name};
    if (opencl_memory_create(&buf->memory, size))
        return &buf->pub;
    free(buf);
    return NULL;
}

void opencl_buf_destroy(struct rg_buf *buf)
{
    clReleaseMemObject(((struct opencl_buf *)buf)->memory.mem);
    free(buf);
}

bool opencl_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size)
{
    return opencl_memory_write(&((struct opencl_buf *)buf)->memory, offset, data, size);
}

bool opencl_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size)
{
    return opencl_memory_read(&((struct opencl_buf *)buf)->memory, offset, data, size);
}
