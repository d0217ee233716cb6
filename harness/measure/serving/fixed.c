#include "harness/measure/serving/fixed.h"

#include <stdio.h>
#include <stdlib.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "harness/devices/workers/device.h"
#include "harness/measure/serving/services.h"

const struct rg_field rg_fixed_fields[] = {
    RG_FIELD_TEXT(struct rg_fixed_told, lacks),
    RG_FIELD_BYTES(struct rg_fixed_told, digest),
    RG_FIELD_BYTES(struct rg_fixed_told, neighbour),
    RG_FIELD_FLAG(struct rg_fixed_told, is_constant),
    RG_FIELDS_END,
};

static bool digest(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture,
                   uint64_t *hash)
{
    picture->size = 0;
    picture->is_constant = false;
    if (!rg_device_fixed_draw(device, feature, state, picture))
        return false;
    *hash = XXH3_64bits(picture->bytes, picture->size);
    return true;
}

static bool take(struct rg_device *device, const struct rg_fixed_draw *draw,
                 struct rg_fixed_picture *picture, struct rg_fixed_told *told)
{
    const struct rg_fixed_state neighbour = rg_fixed_neighbour(draw);
    if (!digest(device, draw->feature, &draw->state, picture, &told->digest))
        return false;
    told->is_constant = !picture->size || picture->is_constant;
    if (!picture->lacks[0] && !digest(device, draw->feature, &neighbour, picture, &told->neighbour))
        return false;
    snprintf(told->lacks, sizeof(told->lacks), "%s", picture->lacks);
    return true;
}

bool rg_fixed_take(struct rg_device *device, int row, struct rg_fixed_told *told)
{
    struct rg_fixed_picture picture = {.bytes = rg_alloc(1, RG_FIXED_PICTURE_BYTES, "picture"),
                                       .room = RG_FIXED_PICTURE_BYTES};
    const bool ok = picture.bytes && take(device, &rg_fixed_draws[row], &picture, told);
    free(picture.bytes);
    return ok;
}

bool rg_serve_fixed(struct rg_message *request, struct rg_message *reply)
{
    struct rg_fixed_told told = {0};
    struct rg_device *device = rg_served_device(rg_take_text(request));
    const int row = rg_take_index(request, rg_fixed_count());
    if (!device || request->failed || !rg_fixed_take(device, row, &told))
        return false;
    rg_put_fields(reply, rg_fixed_fields, &told);
    return true;
}

bool rg_fixed_ask(struct rg_device *device, int row, struct rg_fixed_told *told)
{
    struct rg_worker *worker = rg_remote_worker(device);
    struct rg_message request = {0};
    *told = (struct rg_fixed_told){0};
    if (!worker)
        return rg_fixed_take(device, row, told);
    rg_put_text(&request, device->info.full);
    rg_put_int(&request, row);
    const bool ok = rg_worker_fetch(worker, RG_CALL_FIXED, &request, rg_fixed_fields, told);
    rg_message_free(&request);
    return ok;
}
