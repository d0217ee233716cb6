#include "backends/asked/question.h"

#include <stdio.h>
#include <string.h>

bool rg_question_pass(struct rg_question *q, const char *kernel)
{
    const struct rg_kernel *found = rg_kernel_find(kernel);
    if (!(q->pass = q->device->backend->pass_create(q->device, found)))
        return false;
    q->pass->device = q->device;
    q->pass->kernel = found;
    return true;
}

bool rg_question_buf(struct rg_question *q, int i, const void *words, size_t size, const char *name)
{
    const struct rg_backend *backend = q->device->backend;
    struct rg_buf *buf = q->bufs[i] = backend->buf_create(q->device, size, name);
    if (!buf)
        return false;
    buf->device = q->device;
    buf->size = size;
    buf->name = name;
    return !words || backend->buf_write(buf, 0, words, size);
}

void rg_question_end(struct rg_question *q)
{
    const struct rg_backend *backend = q->device->backend;
    backend->sync(q->device);
    if (q->pass)
        backend->pass_destroy(q->pass);
    for (int i = 0; i < RG_QUESTION_BUFS; i++)
        if (q->bufs[i])
            backend->buf_destroy(q->bufs[i]);
}

void rg_question_note(struct rg_device *device, const char *own)
{
    char *api = device->info.api;
    const size_t length = strlen(api);
    snprintf(api + length, sizeof(device->info.api) - length, ", %s", own);
}
