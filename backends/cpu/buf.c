#include "backends/cpu/cpu.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

struct rg_buf *cpu_buf_create(struct rg_device *device, size_t size, const char *name)
{
    struct cpu_buf *buf = rg_alloc(1, sizeof(*buf), name);
    if (!buf)
        return NULL;
    buf->data = rg_alloc_lines(size);
    if (!buf->data) {
        free(buf);
        return rg_harness_error_null("buffer '%s': %s has no %zu bytes of memory left", name,
                                     device->info.name, size);
    }
    return &buf->pub;
}

void cpu_buf_destroy(struct rg_buf *buf)
{
    struct cpu_buf *cpu = (struct cpu_buf *)buf;
    free(cpu->data);
    free(cpu);
}

bool cpu_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size)
{
    memcpy((char *)((struct cpu_buf *)buf)->data + offset, data, size);
    return true;
}

bool cpu_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size)
{
    memcpy(data, (const char *)((struct cpu_buf *)buf)->data + offset, size);
    return true;
}
