#include "harness/devices/workers/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/devices/workers/held.h"

struct remote {
    struct rg_device pub;
    struct rg_backend
        backend; // the worker's, of which the name alone is used, and how it is closed
    struct rg_worker *worker;
};

static bool sync_remote(struct rg_device *device)
{
    (void)device; // nothing is asked of it but through sessions, and their calls have been answered
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

static void end_text(char *text, size_t size)
{
    text[size - 1] = 0;
}

// A byte that is neither 0 nor 1 is no bool, and must not be read as one.
static bool is_bool(const bool *value)
{
    unsigned char byte;
    memcpy(&byte, value, sizeof(byte));
    return byte <= 1;
}

static bool are_slots(const struct rg_slot_limits *slots)
{
    return slots->buffers >= 0 && slots->images >= 0 && slots->out_images >= 0;
}

static bool are_limits(const struct rg_limits *l)
{
    bool ok = is_bool(&l->has_clock) && is_bool(&l->has_queries) && l->max_objects >= 0 &&
              l->max_buffer_bytes >= 0 && l->max_image_px >= 0 && l->max_image_layers >= 0 &&
              l->group_items >= 0 && are_slots(&l->slot_count) && are_slots(&l->slot_end);
    for (int i = 0; i < 3; i++)
        ok = ok && l->max_groups[i] >= 0;
    for (int i = 0; i < RG_FORMAT_COUNT; i++) {
        const struct rg_format_limits *format = &l->formats[i];
        ok = ok && format->max_px >= 0 && format->max_layers >= 0 && format->max_levels >= 0 &&
             format->max_bytes >= 0;
    }
    return ok;
}

bool rg_take_device_info(struct rg_message *message, struct rg_device_info *info)
{
    if (!RG_TAKE(message, *info))
        return false;
    end_text(info->name, sizeof(info->name));
    end_text(info->device, sizeof(info->device));
    end_text(info->driver, sizeof(info->driver));
    end_text(info->api, sizeof(info->api));
    end_text(info->limits.no_draws, sizeof(info->limits.no_draws));
    return ((unsigned)info->tier < RG_TIER_COUNT && is_bool(&info->software) &&
            are_limits(&info->limits)) ||
           rg_message_fail(message);
}

// Asks for the device. Its name is as the driver's list has it, before an environment.
static bool ask_for(struct remote *remote, const char *name, const char *environment)
{
    struct rg_message request = {0}, reply;
    const size_t plain = strcspn(name, "@");
    char own[RG_DEVICE_NAME_SIZE];
    snprintf(own, sizeof(own), "%.*s", (int)plain, name);
    rg_put_text(&request, own);
    bool ok = rg_worker_call(remote->worker, RG_CALL_OPEN, &request, &reply) &&
              rg_take_device_info(&reply, &remote->pub.info);
    const int backend = ok ? rg_take_index(&reply, RG_MAX_BACKENDS) : 0;
    ok = ok && !reply.failed && (rg_backends[backend] || rg_message_fail(&reply));
    rg_message_free(&request);
    rg_message_free(&reply);
    if (!ok)
        return false;
    remote->pub.backend = &remote->backend;
    remote->backend = (struct rg_backend){.name = rg_backends[backend]->name,
                                          .package = rg_backends[backend]->package,
                                          .sync = sync_remote,
                                          .destroy = destroy_remote};
    char *told = remote->pub.info.name;
    if (environment && *environment)
        snprintf(told + strlen(told), RG_DEVICE_NAME_SIZE - strlen(told), "%s", name + plain);
    return true;
}

struct rg_device *rg_remote_open(struct rg_worker *worker, const char *name,
                                 const char *environment)
{
    struct remote *remote = rg_alloc(1, sizeof(*remote), name);
    struct rg_work *work = remote ? rg_alloc(1, sizeof(*work), name) : NULL;
    if (work)
        remote->worker = worker ? worker : rg_worker_create(name, environment);
    else
        rg_worker_destroy(worker);
    if (work && remote->worker && ask_for(remote, name, environment)) {
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
