#include "harness/devices/devices.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/child.h"

enum { LIST_TIMEOUT_S = 60 };

// --- listing ---

struct listing {
    const struct rg_backend *backend;
    struct rg_device_list list;
};

static void list_one(void *answer)
{
    struct listing *listing = answer;
    rg_device_list_add(&listing->list, listing->backend);
}

static void note_failure(struct rg_device_list *list, const struct rg_backend *backend,
                         enum rg_outcome outcome, const char *why)
{
    struct rg_missing *missing = &list->missing[list->missing_count++];
    *missing = (struct rg_missing){.backend = backend, .outcome = outcome};
    snprintf(missing->why, sizeof(missing->why), "%s: %.140s%s%s", backend->name, why,
             backend->package ? "; reinstall the Debian package " : "",
             backend->package ? backend->package : "");
}

void rg_devices_list(struct rg_device_list *list)
{
    memset(list, 0, sizeof(*list));
    struct listing *listing = rg_child_answer_create(sizeof(*listing));
    for (int b = 0; listing && rg_backends[b]; b++) {
        char why[256];
        *listing = (struct listing){rg_backends[b], *list};
        const enum rg_outcome end =
            rg_child_run(list_one, listing, LIST_TIMEOUT_S, why, sizeof(why));
        if (end == RG_OK)
            *list = listing->list;
        else
            note_failure(list, rg_backends[b], end, why);
    }
    rg_child_answer_destroy(listing, sizeof(*listing));
}

int rg_devices_complain(const struct rg_device_list *list)
{
    int exit = RG_EXIT_PASS;
    for (int i = 0; i < list->missing_count; i++) {
        const struct rg_missing *missing = &list->missing[i];
        if (missing->outcome == RG_UNSUPPORTED) {
            rg_warning("unsupported here: %s", missing->why);
            continue;
        }
        rg_driver_error("%s", missing->why);
        exit = RG_EXIT_FAIL;
    }
    return exit;
}

// --- opening ---

static void leave_out(struct rg_devices *devices, const char *name, enum rg_outcome outcome,
                      const char *why)
{
    struct rg_absent_device *absent = &devices->absent[devices->absent_count++];
    absent->outcome = outcome;
    snprintf(absent->name, sizeof(absent->name), "%s", name);
    snprintf(absent->why, sizeof(absent->why), "%.255s", why);
}

static void open_listed(struct rg_devices *devices, const struct rg_device_list *list)
{
    for (int i = 0; i < list->missing_count; i++)
        leave_out(devices, list->missing[i].backend->name, list->missing[i].outcome,
                  list->missing[i].why);
    for (int i = 0; i < list->count; i++) {
        struct rg_device *device = rg_device_open(list->infos[i].name);
        if (device)
            devices->devices[devices->count++] = device;
        else
            leave_out(devices, list->infos[i].name, rg_outcome_of_error(), rg_last_error());
    }
}

static int open_all(struct rg_devices *devices)
{
    struct rg_device_list *list = rg_alloc(1, sizeof(*list), "list of devices");
    if (!list)
        return RG_EXIT_FAIL;
    rg_devices_list(list);
    rg_devices_complain(list);
    open_listed(devices, list);
    free(list);
    return devices->count ? RG_EXIT_PASS
                          : rg_exit_worse(RG_EXIT_UNSUPPORTED, rg_devices_exit(devices));
}

static int open_named(const char *names, struct rg_devices *devices)
{
    char *copy = strdup(names), *rest = NULL;
    int exit = copy ? RG_EXIT_PASS : RG_EXIT_FAIL;
    if (!copy)
        rg_error("--device: no memory for its names");
    for (char *name = !copy ? NULL : strtok_r(copy, ",", &rest); name && exit == RG_EXIT_PASS;
         name = strtok_r(NULL, ",", &rest)) {
        struct rg_device *device = NULL;
        if (devices->count == RG_MAX_DEVICES)
            rg_error("--device: more than %d names", RG_MAX_DEVICES);
        else
            device = rg_device_open(name);
        if (device)
            devices->devices[devices->count++] = device;
        else
            exit = rg_exit_of_error();
    }
    free(copy);
    if (exit == RG_EXIT_PASS && !devices->count) {
        rg_error("--device '%s': names no device", names);
        exit = RG_EXIT_USAGE;
    }
    return exit;
}

int rg_devices_open(const char *names, struct rg_devices *devices)
{
    *devices = (struct rg_devices){0};
    int exit = !strcmp(names, "all") ? open_all(devices) : open_named(names, devices);
    if (exit != RG_EXIT_PASS)
        rg_devices_close(devices);
    return exit;
}

int rg_devices_exit(const struct rg_devices *devices)
{
    int exit = RG_EXIT_PASS;
    for (int i = 0; i < devices->absent_count; i++)
        if (devices->absent[i].outcome != RG_UNSUPPORTED)
            exit = rg_exit_worse(exit, rg_exit_of(devices->absent[i].outcome));
    return exit;
}

bool rg_devices_close(struct rg_devices *devices)
{
    bool clean = true;
    for (int i = 0; i < devices->count; i++)
        clean = rg_device_close(devices->devices[i]) && clean;
    devices->count = 0;
    return clean;
}
