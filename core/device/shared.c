#include "core/device/shared.h"

#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

struct rg_shared {
    struct rg_shared *next;
    const struct rg_shared_kind *kind;
    void *thing;
    int holders;
    char key[];
};

static struct rg_shared *entry_make(struct rg_device *device, const char *key,
                                    const struct rg_shared_kind *kind, const void *arg)
{
    const size_t key_size = strlen(key) + 1;
    struct rg_shared *entry = rg_alloc(1, sizeof(*entry) + key_size, kind->name);
    if (!entry)
        return NULL;
    entry->kind = kind;
    memcpy(entry->key, key, key_size);
    entry->thing = kind->make(device, arg);
    if (!entry->thing) {
        free(entry);
        return NULL;
    }
    // A thing enters the list after the things that its `make` has asked for.
    entry->next = device->shared;
    device->shared = entry;
    return entry;
}

void *rg_shared_get(struct rg_device *device, const char *key, const struct rg_shared_kind *kind,
                    const void *arg)
{
    struct rg_shared *entry = device->shared;
    while (entry && (entry->kind != kind || strcmp(entry->key, key) != 0))
        entry = entry->next;
    if (!entry)
        entry = entry_make(device, key, kind, arg);
    if (!entry)
        return NULL;
    entry->holders++;
    return entry->thing;
}

// Removes it from the list before destroying it, because destroying puts back the things that it
// holds, which changes the list.
static void entry_destroy(struct rg_shared **at)
{
    struct rg_shared *entry = *at;
    *at = entry->next;
    entry->kind->destroy(entry->thing);
    free(entry);
}

void rg_shared_put(struct rg_device *device, void *thing)
{
    struct rg_shared **at = &device->shared;
    if (!thing)
        return;
    while (*at && (*at)->thing != thing)
        at = &(*at)->next;
    if (!*at)
        rg_error("device '%s': what was put back is none of its shared things", device->info.name);
    else if (--(*at)->holders == 0)
        entry_destroy(at);
}

bool rg_shared_close(struct rg_device *device)
{
    const bool clean = !device->shared;
    // The latest goes first, since it may hold earlier ones.
    while (device->shared) {
        const struct rg_shared *entry = device->shared;
        rg_error("device '%s': closed with %s '%.80s' not put back by %d", device->info.name,
                 entry->kind->name, entry->key, entry->holders);
        entry_destroy(&device->shared);
    }
    return clean;
}
