#include "harness/devices/workers/device.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/devices/workers/held.h"

struct remote {
    struct rg_device pub;
    struct rg_backend backend; // the worker's backend; only its name and `destroy` are used
    struct rg_worker *worker;
};

static bool sync_remote(struct rg_device *device)
{
    (void)device; // nothing to wait for: all calls of sessions have been answered
    return true;
}

static bool destroy_remote(struct rg_device *device)
{
    struct remote *remote = (struct remote *)device;
    const bool is_closed = rg_worker_retire(remote->worker);
    const bool has_ended = rg_worker_destroy(remote->worker);
    free(remote);
    return is_closed && has_ended;
}

static const struct rg_field format_fields[] = {
    RG_FIELD_BYTES(struct rg_format_limits, uses),
    RG_FIELD_INTEGER(struct rg_format_limits, max_px, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_format_limits, max_layers, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_format_limits, max_levels, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_format_limits, max_bytes, 0, INT64_MAX),
    RG_FIELDS_END,
};

static const struct rg_field slot_fields[] = {
    RG_FIELD_INTEGER(struct rg_slot_limits, buffers, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_slot_limits, images, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_slot_limits, out_images, 0, INT_MAX),
    RG_FIELDS_END,
};

static const struct rg_field limits_fields[] = {
    RG_FIELD_INTEGER(struct rg_limits, max_objects, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_limits, max_buffer_bytes, 0, INT64_MAX),
    RG_FIELD_INTEGER(struct rg_limits, max_image_px, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_limits, max_image_layers, 0, INT_MAX),
    RG_FIELD_INTEGERS(struct rg_limits, max_groups, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_limits, group_items, 0, INT_MAX),
    RG_FIELD_STRUCTS(struct rg_limits, formats, format_fields),
    RG_FIELD_STRUCT(struct rg_limits, slot_count, slot_fields),
    RG_FIELD_STRUCT(struct rg_limits, slot_end, slot_fields),
    RG_FIELD_TEXT(struct rg_limits, no_draws),
    RG_FIELD_FLAG(struct rg_limits, has_clock),
    RG_FIELD_FLAG(struct rg_limits, has_queries),
    RG_FIELD_TEXT(struct rg_limits, no_native),
    RG_FIELDS_END,
};

static const struct rg_field library_fields[] = {
    RG_FIELD_TEXT(struct rg_library, path),
    RG_FIELD_TEXT(struct rg_library, build),
    RG_FIELD_BYTES(struct rg_library, device),
    RG_FIELD_BYTES(struct rg_library, inode),
    RG_FIELDS_END,
};

static const struct rg_field info_fields[] = {
    RG_FIELD_TEXT(struct rg_device_info, name),
    RG_FIELD_TEXT(struct rg_device_info, full),
    RG_FIELD_TEXT(struct rg_device_info, device),
    RG_FIELD_TEXT(struct rg_device_info, driver),
    RG_FIELD_TEXT(struct rg_device_info, api),
    RG_FIELD_STRUCTS(struct rg_device_info, libraries, library_fields),
    RG_FIELD_FLAG(struct rg_device_info, software),
    RG_FIELD_FLAG(struct rg_device_info, native),
    RG_FIELD_INTEGER(struct rg_device_info, features, 0, RG_FEATURE_ALL),
    RG_FIELD_INTEGER(struct rg_device_info, tier, 0, RG_TIER_COUNT - 1),
    RG_FIELD_STRUCT(struct rg_device_info, limits, limits_fields),
    RG_FIELDS_END,
};

const struct rg_field rg_told_device_fields[] = {
    RG_FIELD_STRUCT(struct rg_told_device, info, info_fields),
    RG_FIELD_INTEGER(struct rg_told_device, backend, 0, RG_MAX_BACKENDS - 1),
    RG_FIELDS_END,
};

static bool is_explained(const void *all)
{
    const struct rg_told_list *told = all;
    return told->count || told->outcome != RG_OK;
}

const struct rg_field rg_told_list_fields[] = {
    RG_FIELD_SOME(struct rg_told_list, infos, count, info_fields),
    RG_FIELD_INTEGER(struct rg_told_list, outcome, 0, RG_OUTCOME_COUNT - 1),
    RG_FIELD_TEXT(struct rg_told_list, why),
    RG_FIELD_CHECK(is_explained),
    RG_FIELDS_END,
};

// Opens the device in the worker. `name` is the name in the driver's list, without an environment.
static bool ask_for(struct remote *remote, const char *name, const char *full)
{
    struct rg_message request = {0};
    struct rg_told_device asked = {.backend = 0};
    const size_t plain = strcspn(full, "@");
    char own[RG_DEVICE_NAME_SIZE];
    snprintf(own, sizeof(own), "%.*s", (int)plain, full);
    rg_put_text(&request, own);
    const bool ok =
        rg_worker_fetch(remote->worker, RG_CALL_OPEN, &request, rg_told_device_fields, &asked);
    rg_message_free(&request);
    if (!ok)
        return false;
    const struct rg_backend *backend = rg_backends[asked.backend];
    if (!backend)
        return rg_driver_error("device '%s': its process tells of no backend", name);
    remote->pub.info = asked.info;
    remote->pub.backend = &remote->backend;
    remote->backend = (struct rg_backend){.name = backend->name,
                                          .package = backend->package,
                                          .sync = sync_remote,
                                          .destroy = destroy_remote};
    struct rg_device_info *info = &remote->pub.info;
    memcpy(info->full, info->name, sizeof(info->full));
    snprintf(info->full + strlen(info->full), RG_DEVICE_NAME_SIZE - strlen(info->full), "%s",
             full + plain);
    snprintf(info->name, RG_DEVICE_NAME_SIZE, "%s", strcmp(name, full) ? name : info->full);
    return true;
}

struct rg_device *rg_remote_open(struct rg_worker *worker, const char *name, const char *full,
                                 const char *environment)
{
    struct remote *remote = rg_alloc(1, sizeof(*remote), name);
    struct rg_work *work = remote ? rg_alloc(1, sizeof(*work), name) : NULL;
    if (work)
        remote->worker = worker ? worker : rg_worker_create(name, environment);
    else
        rg_worker_destroy(worker);
    if (work && remote->worker && ask_for(remote, name, full)) {
        remote->pub.work = work;
        return &remote->pub;
    }
    if (remote)
        rg_worker_destroy(remote->worker);
    free(work);
    free(remote);
    return NULL;
}

struct rg_worker *rg_remote_worker(const struct rg_device *device)
{
    return device->backend->destroy == destroy_remote ? ((const struct remote *)device)->worker
                                                      : NULL;
}

int64_t rg_remote_held_bytes(const struct rg_device *device)
{
    const struct rg_worker *worker = rg_remote_worker(device);
    return rg_held_bytes(worker ? rg_worker_process(worker) : getpid());
}
