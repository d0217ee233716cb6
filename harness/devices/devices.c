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

void rg_devices_list(struct rg_device_list *list)
{
    memset(list, 0, sizeof(*list));
    struct listing *listing = rg_child_answer_create(sizeof(*listing));
    for (int b = 0; listing && rg_backends[b]; b++) {
        char why[256];
        *listing = (struct listing){rg_backends[b], *list};
        if (rg_child_run(list_one, listing, LIST_TIMEOUT_S, why, sizeof(why)) == RG_OK) {
            *list = listing->list;
            continue;
        }
        int missing = 0;
        while (list->missing[missing][0])
            missing++;
        snprintf(list->missing[missing], sizeof(list->missing[0]), "%s: %.140s%s%s",
                 rg_backends[b]->name, why,
                 rg_backends[b]->package ? "; reinstall the Debian package " : "",
                 rg_backends[b]->package ? rg_backends[b]->package : "");
    }
    rg_child_answer_destroy(listing, sizeof(*listing));
}

// --- opening ---

static void note_broken(struct rg_devices *devices, const char *name)
{
    struct rg_broken_device *broken = &devices->broken[devices->broken_count++];
    snprintf(broken->name, sizeof(broken->name), "%s", name);
    snprintf(broken->why, sizeof(broken->why), "%.255s", rg_last_error());
}

static int open_all(struct rg_devices *devices)
{
    struct rg_device_list *list = rg_alloc(1, sizeof(*list), "list of devices");
    if (!list)
        return RG_EXIT_FAIL;
    rg_devices_list(list);
    memcpy(devices->missing, list->missing, sizeof(devices->missing));
    for (int i = 0; list->missing[i][0]; i++)
        rg_warning("unsupported here: %s", list->missing[i]);
    for (int i = 0; i < list->count; i++) {
        struct rg_device *device = rg_device_open(list->infos[i].name);
        if (device)
            devices->devices[devices->count++] = device;
        else
            note_broken(devices, list->infos[i].name);
    }
    free(list);
    return devices->count ? RG_EXIT_PASS : RG_EXIT_UNSUPPORTED;
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

bool rg_devices_close(struct rg_devices *devices)
{
    bool clean = true;
    for (int i = 0; i < devices->count; i++)
        clean = rg_device_close(devices->devices[i]) && clean;
    devices->count = 0;
    return clean;
}
