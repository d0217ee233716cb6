#include "harness/devices/drivers/side.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "harness/devices/drivers/caches.h"
#include "harness/devices/drivers/choice.h"
#include "harness/devices/workers/device.h"

static bool are_all_sides;

void rg_sides_begin(void)
{
    are_all_sides = true;
}

// Whether variables are set that change a driver's code but are not in every driver's cache key.
static bool changes_code(void)
{
    static const char *const variables[] = {"GALLIVM_DEBUG", "GALLIVM_PERF",
                                            "LP_NATIVE_VECTOR_WIDTH", "LP_PERF", NULL};
    bool any = false;
    for (int i = 0; !any && variables[i]; i++)
        any = getenv(variables[i]);
    // A user who also chooses the cache folder is left to decide.
    return any && !getenv("MESA_SHADER_CACHE_DIR");
}

// A cpu device has no driver, and caches no code.
static bool is_side(const struct rg_asked *asked)
{
    return strncmp(asked->full, "cpu", 3) != 0 &&
           (*asked->environment || are_all_sides || changes_code());
}

static uint64_t hash_driver(const struct rg_device_info *info)
{
    uint64_t hash = XXH3_64bits(info->driver, strlen(info->driver));
    for (int i = 0; i < RG_DRIVER_LIBRARIES; i++)
        hash =
            XXH3_64bits_withSeed(info->libraries[i].build, strlen(info->libraries[i].build), hash);
    return hash;
}

// Whether the worker can load one of the named libraries; if not, this finds the reason, about
// which the APIs' loaders are silent.
static bool can_be_loaded(struct rg_worker *worker, const struct rg_choice *choice)
{
    const char *libraries[RG_CHOICE_MANIFESTS];
    const int count = rg_choice_libraries(choice, libraries, RG_CHOICE_MANIFESTS);
    struct rg_message request = {0}, reply;
    if (!count)
        return true;
    rg_put_int(&request, count);
    for (int i = 0; i < count; i++)
        rg_put_text(&request, libraries[i]);
    const bool ok = rg_worker_call(worker, RG_CALL_LOAD, &request, &reply);
    char why[RG_LIST_WHY_SIZE];
    snprintf(why, sizeof(why), "%s", ok ? rg_take_text(&reply) : "");
    rg_message_free(&request);
    return rg_worker_finish(&reply, ok) && (!*why || rg_choice_refuse(choice, why));
}

// Opens the device with its folder's caches, if a folder is given.
static struct rg_device *open_in(const struct rg_asked *asked, const struct rg_choice *choice,
                                 const struct rg_side_folder *folder)
{
    struct rg_worker_variables variables = {.text = NULL};
    char manifests[PATH_MAX] = "";
    struct rg_device *device = NULL;
    const bool ok = (!folder || rg_side_folder_in(folder, "manifests", manifests)) &&
                    rg_choice_set(choice, manifests, &variables) &&
                    (!folder || rg_side_caches_set(folder, &variables));
    struct rg_worker *worker = ok ? rg_worker_create(asked->name, variables.text) : NULL;
    if (worker && can_be_loaded(worker, choice))
        device = rg_remote_open(worker, asked->name, asked->full, variables.text);
    else
        rg_worker_destroy(worker);
    rg_variables_free(&variables);
    return device;
}

// A driver is known only after loading, but reads its cache folder while loading. So the folder is
// that of the last driver; if another one is found, the device is reopened.
static struct rg_device *open_side(const struct rg_asked *asked, const struct rg_choice *choice)
{
    struct rg_side_folder folder;
    struct rg_device *device = rg_side_folder_find(choice->api, choice->environment, &folder)
                                   ? open_in(asked, choice, &folder)
                                   : NULL;
    if (!device || !rg_side_folder_move(&folder, hash_driver(&device->info)))
        return device;
    rg_device_close(device);
    return open_in(asked, choice, &folder);
}

struct rg_device *rg_side_open(const struct rg_asked *asked)
{
    struct rg_choice *choice = rg_choice_read(asked);
    struct rg_device *device = !choice          ? NULL
                               : is_side(asked) ? open_side(asked, choice)
                                                : open_in(asked, choice, NULL);
    if (device && !rg_choice_is_met(choice, &device->info)) {
        rg_device_close(device);
        device = NULL;
    }
    rg_choice_free(choice);
    return device;
}
