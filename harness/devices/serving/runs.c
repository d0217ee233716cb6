// Calls about runs whose stages are looked at (harness/frames/remote.c makes them).
#include <stdlib.h>

#include "core/base/log.h"
#include "core/device/pass.h"
#include "harness/frames/digests.h"
#include "harness/frames/messages.h"
#include "harness/devices/serving/services.h"

// Takes what calls about a run are asked with; the caller frees the subject's settings.
static struct rg_device *take_run(struct rg_message *request, struct rg_digest_run *run, int *row)
{
    struct rg_device *device = rg_served_device(rg_take_text(request));
    *run = (struct rg_digest_run){0};
    if (!device || !rg_take_subject(request, &run->subject))
        return NULL;
    run->frames = rg_take_index(request, INT32_MAX);
    *row = rg_take_index(request, INT32_MAX);
    return device;
}

bool rg_serve_bytes(struct rg_message *reply, struct rg_told_bytes *told)
{
    const bool ok = told->bytes;
    if (ok)
        rg_put_fields(reply, rg_told_bytes_fields, told);
    free(told->bytes);
    return ok;
}

bool rg_serve_digests(struct rg_message *request, struct rg_message *reply)
{
    struct rg_digest_run run;
    struct rg_digests digests = {0};
    int row;
    struct rg_device *device = take_run(request, &run, &row);
    const bool ok = device && rg_digests_take(&run, device, &digests);
    if (ok)
        rg_put_fields(reply, rg_told_digests_fields, &digests);
    rg_digests_free(&digests);
    free((void *)run.subject.settings);
    return ok;
}

bool rg_serve_contents(struct rg_message *request, struct rg_message *reply)
{
    struct rg_digest_run run;
    struct rg_told_contents told = {.contents = {.size = 0}};
    int row;
    struct rg_device *device = take_run(request, &run, &row);
    const bool ok = device && rg_digests_contents(&run, device, row, &told.contents, &told.state);
    if (ok)
        rg_put_fields(reply, rg_told_contents_fields, &told);
    rg_contents_free(&told.contents);
    free((void *)run.subject.settings);
    return ok;
}

bool rg_serve_dispatches(struct rg_message *request, struct rg_message *reply)
{
    struct rg_digest_run run;
    struct rg_dispatches all = {0};
    int stages_run;
    struct rg_device *device = take_run(request, &run, &stages_run);
    const bool ok = device && rg_digests_dispatches(&run, device, stages_run, &all);
    rg_put_int(reply, all.count);
    for (int i = 0; ok && i < all.count; i++) {
        rg_put_dispatched(reply, &all.rows[i]);
        rg_put_dispatched_after(reply, &all.rows[i]);
    }
    rg_dispatches_free(&all);
    free((void *)run.subject.settings);
    return ok;
}

bool rg_serve_dispatch(struct rg_message *request, struct rg_message *reply)
{
    struct rg_dispatched dispatched = {0};
    struct rg_device *device = rg_served_device(rg_take_text(request));
    const bool ok = device && rg_take_dispatched(request, &dispatched) &&
                    rg_digests_dispatch(&dispatched, device);
    if (ok)
        rg_put_dispatched_after(reply, &dispatched);
    rg_dispatched_free(&dispatched);
    return ok;
}

bool rg_serve_kernel_code(struct rg_message *request, struct rg_message *reply)
{
    struct rg_device *device = rg_served_device(rg_take_text(request));
    const struct rg_kernel *kernel = rg_kernel_find(rg_take_text(request));
    const enum rg_code_kind kind = (enum rg_code_kind)rg_take_index(request, RG_CODE_COUNT);
    struct rg_told_bytes told = {0};
    if (!kernel)
        return rg_error("a message between processes names no kernel");
    if (device && !request->failed)
        told.bytes = rg_digests_code(device, kernel, kind, &told.size);
    return rg_serve_bytes(reply, &told);
}

bool rg_serve_compile(struct rg_message *request, struct rg_message *reply)
{
    struct rg_device *device = rg_served_device(rg_take_text(request));
    const char *kernel = rg_take_text(request);
    struct rg_pass *pass = device && !request->failed ? rg_pass_create(device, kernel) : NULL;
    (void)reply;
    rg_pass_destroy(pass);
    return pass;
}
