#include "core/device/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "backends/asked/blending.h"
#include "backends/asked/features.h"
#include "backends/asked/question.h"
#include "backends/asked/rounding.h"
#include "core/base/alloc.h"
#include "core/base/doing.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/device/limits.h"
#include "core/device/packing.h"
#include "core/device/shared.h"

// Asks a backend for its devices, and warns of a driver that fails while others work.
static int list(const struct rg_backend *backend, struct rg_device_info *infos, int max,
                char why[RG_LIST_WHY_SIZE])
{
    *why = 0;
    const int count = backend->list(infos, max, why, RG_LIST_WHY_SIZE);
    if (count > 0 && *why)
        rg_warning("%s: a driver is left out: %s; mend it, or remove it", backend->name, why);
    return count;
}

void rg_device_list_add(struct rg_device_list *devices, const struct rg_backend *backend)
{
    char why[RG_LIST_WHY_SIZE];
    int found =
        list(backend, devices->infos + devices->count, RG_MAX_DEVICES - devices->count, why);
    for (int i = 0; i < found; i++) {
        devices->backends[devices->count] = backend;
        devices->backend_index[devices->count++] = i;
    }
    if (found > 0)
        return;
    struct rg_missing *missing = &devices->missing[devices->missing_count++];
    *missing = (struct rg_missing){.backend = backend,
                                   .outcome = found == RG_LIST_BROKEN   ? RG_SETUP
                                              : found == RG_LIST_FAILED ? RG_ERROR
                                                                        : RG_UNSUPPORTED};
    snprintf(missing->why, sizeof(missing->why), "%s: %s", backend->name, why);
}

void rg_device_list_all(struct rg_device_list *devices)
{
    memset(devices, 0, sizeof(*devices));
    for (int b = 0; rg_backends[b]; b++)
        rg_device_list_add(devices, rg_backends[b]);
}

const struct rg_backend *rg_backend_of(const char *name)
{
    const size_t length = strcspn(name, ":@");
    for (int b = 0; rg_backends[b]; b++)
        if (strlen(rg_backends[b]->name) == length && !memcmp(rg_backends[b]->name, name, length))
            return rg_backends[b];
    return NULL;
}

static bool contains(const char *text, const char *part)
{
    for (; *text; text++)
        if (!strncasecmp(text, part, strlen(part)))
            return true;
    return false;
}

// The index of the device that `choice` picks: NULL the first, else an index, a whole name, or a
// part of the driver's name for it. -1: none.
static int choose(const struct rg_device_info *infos, int count, const char *name,
                  const char *choice)
{
    if (!choice)
        return 0;
    for (int i = 0; i < count; i++)
        if (!strcmp(infos[i].name, name))
            return i;
    char *end;
    long index = strtol(choice, &end, 10);
    if (end != choice && !*end)
        return index >= 0 && index < count ? (int)index : -1;
    for (int i = 0; i < count; i++)
        if (*choice && contains(infos[i].device, choice))
            return i;
    return -1;
}

// Lists each file that holds some of the driver's functions, once.
static bool find_libraries(struct rg_device *device)
{
    enum { MOST_FUNCTIONS = 16 };
    const void *functions[MOST_FUNCTIONS] = {(const void *)rg_rounding_settle};
    int count = 1, found = 0;
    if (device->backend->functions)
        count = device->backend->functions(device, functions, MOST_FUNCTIONS);
    struct rg_library *all = device->info.libraries;
    for (int i = 0; i < count && found < RG_DRIVER_LIBRARIES; i++) {
        int same = 0;
        rg_library_at(functions[i], &all[found]);
        while (same < found && !rg_library_is_same(&all[same], &all[found]))
            same++;
        found += same == found && *all[found].path;
    }
    if (found < RG_DRIVER_LIBRARIES)
        all[found] = (struct rg_library){.path = ""};
    return count >= 0;
}

// The length of a name without ":native" at its end.
static size_t length_without_native(const char *name)
{
    static const char native[] = ":native";
    const size_t length = strlen(name), last = sizeof(native) - 1;
    return length > last && !strcmp(name + length - last, native) ? length - last : length;
}

// The index of a named device in its backend's list; -1, and one logged line, on failure. `plain`
// is the name without ":native".
static int find(const struct rg_backend *backend, const char *name, const char *plain,
                struct rg_device_info infos[RG_MAX_DEVICES])
{
    const char *colon = strchr(plain, ':');
    char why[RG_LIST_WHY_SIZE];
    const int count = list(backend, infos, RG_MAX_DEVICES, why);
    if (count < 0) {
        (count == RG_LIST_BROKEN ? rg_setup_error : rg_driver_error)("device '%s': %s", name, why);
        return -1;
    }
    if (count == 0) {
        rg_unsupported("device '%s': %s", name, why);
        return -1;
    }
    const int index = choose(infos, count, plain, colon ? colon + 1 : NULL);
    if (index < 0)
        rg_error("device '%s': %s has no such device; `raingauge list devices` prints the names",
                 name, backend->name);
    return index;
}

static struct rg_device *create(const struct rg_backend *backend, int index, bool native,
                                unsigned features)
{
    struct rg_device *device = backend->create(index);
    if (device && !rg_limits_are_sound(&device->info)) {
        backend->destroy(device);
        device = NULL;
    }
    if (!device)
        return NULL;
    device->info.native = native;
    device->info.features = features;
    return device;
}

static void tell_native(struct rg_device *device)
{
    struct rg_device_info *info = &device->info;
    const size_t length = strlen(info->name);
    snprintf(info->name + length, sizeof(info->name) - length, ":native");
    rg_question_note(device, info->features == RG_FEATURE_ALL ? "native" : "native in part");
    info->tier = RG_T2;
}

struct rg_device *rg_device_open(const char *name)
{
    const struct rg_backend *backend = rg_backend_of(name);
    require_or_null(backend, "device '%s': unknown; `raingauge list devices` prints the names",
                    name);
    char plain[RG_DEVICE_NAME_SIZE];
    const size_t length = length_without_native(name);
    const bool native = name[length];
    require_or_null(length < sizeof(plain), "device '%.60s...': a name has at most %d characters",
                    name, RG_DEVICE_NAME_SIZE - 1);
    snprintf(plain, sizeof(plain), "%.*s", (int)length, name);
    struct rg_device_info infos[RG_MAX_DEVICES];
    const int index = find(backend, name, plain, infos);
    if (index < 0)
        return NULL;
    unsigned features = 0;
    if (native && !(rg_features_read(&features) && rg_limits_allow_native(name, &infos[index])))
        return NULL;
    rg_doing_begin("opening device", name);
    struct rg_work *work = rg_alloc(1, sizeof(*work), name);
    struct rg_device *device = work ? create(backend, index, native, features) : NULL;
    if (!device) {
        free(work);
        return NULL;
    }
    device->backend = backend;
    device->work = work;
    if (!find_libraries(device) || !rg_rounding_settle(device) ||
        (!native && !rg_blending_settle(device))) {
        rg_device_close(device);
        return NULL;
    }
    if (native) {
        rg_features_settle(device);
        tell_native(device);
    }
    memcpy(device->info.full, device->info.name, RG_DEVICE_NAME_SIZE);
    return device;
}

bool rg_device_close(struct rg_device *device)
{
    if (!device)
        return true;
    const bool shared_clean = rg_shared_close(device);
    rg_packing_destroy(device);
    rg_work_settle(device);
    const struct rg_work *w = device->work;
    const bool is_empty = !w->live_buffers && !w->live_images && !w->live_passes;
    const bool clean = is_empty && !w->has_failed;
    if (!is_empty)
        rg_error("device '%s': closed with %lld buffers, %lld images and %lld passes not destroyed",
                 device->info.name, (long long)w->live_buffers, (long long)w->live_images,
                 (long long)w->live_passes);
    free(device->work);
    return device->backend->destroy(device) && clean && shared_clean;
}

const struct rg_work *rg_device_work(const struct rg_device *device)
{
    return device->work;
}

bool rg_device_sync(struct rg_device *device)
{
    rg_doing_begin("waiting for the device", "");
    bool ok = !device->work->has_failed ||
              rg_driver_error("device '%s': failed while something on it was destroyed",
                              device->info.name);
    rg_work_settle(device);
    rg_doing_waited();
    ok = ok && !device->work->has_failed;
    device->work->has_failed = false;
    return ok;
}

bool rg_device_time(struct rg_device *device, int64_t *time_ns)
{
    return rg_limits_allow_time(&device->info) && device->backend->time(device, time_ns);
}

bool rg_device_fixed_draw(struct rg_device *device, const char *feature,
                          const struct rg_fixed_state *state, struct rg_fixed_picture *picture)
{
    if (!rg_limits_allow_fixed(&device->info))
        return false;
    rg_doing_begin("drawing feature", feature);
    const bool ok = device->backend->fixed_draw(device, feature, state, picture);
    rg_doing_waited();
    return ok;
}

// More memory than this is counted before it is taken: taking it costs seconds, and counting costs
// little.
#define MOST_UNCOUNTED_BYTES ((int64_t)1 << 30)

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

void rg_room_begin(struct rg_device *device, enum rg_room room)
{
    struct rg_work *work = device->work;
    work->most_bytes = work->before_bytes = work->live_bytes;
    work->watch_bytes = smaller(rg_memory_left() / 4, MOST_UNCOUNTED_BYTES);
    work->room = RG_ROOM_WATCHED;
    if (room == RG_ROOM_COUNTED)
        rg_room_count(device);
}

// The packing buffers were only counted, not made; drop them so that the next draw makes real ones.
int64_t rg_room_end(struct rg_device *device, bool *is_taken)
{
    struct rg_work *work = device->work;
    *is_taken = work->room != RG_ROOM_COUNTED;
    if (!*is_taken) {
        rg_packing_destroy(device);
        rg_log_hold(false);
    }
    work->room = RG_ROOM_TAKEN;
    return work->most_bytes - work->before_bytes;
}

void rg_device_watch(struct rg_device *device, const struct rg_watch *watch)
{
    rg_packing_destroy(device);
    device->work->watch = watch;
}

enum rg_tier rg_tier_owed(const struct rg_device_info *a, const struct rg_device_info *b)
{
    return a->tier > b->tier ? a->tier : b->tier;
}
