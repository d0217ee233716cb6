#include "harness/devices/devices.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/text/limits.h"
#include "harness/console/exit.h"
#include "harness/devices/drivers/apart.h"
#include "harness/devices/drivers/choice.h"
#include "harness/devices/drivers/side.h"
#include "harness/devices/names.h"
#include "harness/devices/workers/device.h"

// --- listing ---

static void note_failure(struct rg_device_list *list, const struct rg_backend *backend,
                         enum rg_outcome outcome, const char *why)
{
    struct rg_missing *missing = &list->missing[list->missing_count++];
    *missing = (struct rg_missing){.backend = backend, .outcome = outcome};
    snprintf(missing->why, sizeof(missing->why), "%s: %s", backend->name, why);
}

static void add_told(const struct rg_told_list *told, int backend, struct rg_device_list *list)
{
    for (int i = 0; i < told->count && list->count < RG_MAX_DEVICES; i++, list->count++) {
        list->backends[list->count] = rg_backends[backend];
        list->backend_index[list->count] = i;
        list->infos[list->count] = told->infos[i];
    }
    if (told->count)
        return;
    struct rg_missing *missing = &list->missing[list->missing_count++];
    char limits[RG_LIMITS_TEXT];
    const bool is_limited = rg_limits_low(limits);
    *missing = (struct rg_missing){.backend = rg_backends[backend],
                                   .outcome = is_limited ? RG_LACKING : told->outcome};
    if (is_limited)
        snprintf(missing->why, sizeof(missing->why),
                 "%s: its driver gives no device %s; allow more", rg_backends[backend]->name,
                 limits);
    else
        snprintf(missing->why, sizeof(missing->why), "%s", told->why);
}

// Asks a worker for the devices of a backend. A damaged list is not used.
static void list_remote(struct rg_worker *worker, int backend, struct rg_device_list *list)
{
    static struct rg_told_list told;
    struct rg_message request = {0}, reply;
    char why[RG_LIST_WHY_SIZE];
    told = (struct rg_told_list){.count = 0};
    rg_put_int(&request, backend);
    const enum rg_outcome outcome =
        rg_worker_try(worker, RG_CALL_LIST, &request, &reply, why, sizeof(why));
    const bool ok = outcome == RG_OK && rg_take_fields(&reply, rg_told_list_fields, &told);
    if (rg_worker_finish(&reply, ok))
        add_told(&told, backend, list);
    else
        note_failure(list, rg_backends[backend], outcome == RG_OK ? RG_ERROR : outcome,
                     *why ? why : rg_last_error());
    rg_message_free(&request);
}

// Keeps each backend's worker in `workers`, by backend, to be reused for its first opened device.
static void list_all(struct rg_device_list *list, struct rg_worker *workers[RG_MAX_BACKENDS])
{
    memset(list, 0, sizeof(*list));
    if (!rg_workers.program) {
        rg_device_list_all(list);
        return;
    }
    for (int b = 0; rg_backends[b]; b++) {
        workers[b] = rg_worker_create(rg_backends[b]->name, NULL);
        if (workers[b])
            list_remote(workers[b], b, list);
        else
            note_failure(list, rg_backends[b], RG_LACKING, "no memory for its worker");
    }
}

void rg_devices_list(struct rg_device_list *list)
{
    struct rg_worker *workers[RG_MAX_BACKENDS] = {0};
    list_all(list, workers);
    for (int b = 0; b < RG_MAX_BACKENDS; b++)
        rg_worker_destroy(workers[b]);
}

// Logs why no device could be opened, and returns false.
static bool tell_missing(enum rg_outcome outcome, const char *require, const char *why)
{
    bool (*const tell)(const char *format, ...) = outcome == RG_LACKING ? rg_harness_error
                                                  : outcome == RG_SETUP ? rg_setup_error
                                                                        : rg_driver_error;
    return require ? tell("--require %s: %s", require, why) : tell("%s", why);
}

int rg_devices_complain(const struct rg_device_list *list)
{
    int exit = list->count ? RG_EXIT_PASS : RG_EXIT_UNSUPPORTED;
    for (int i = 0; i < list->missing_count; i++) {
        const struct rg_missing *missing = &list->missing[i];
        if (missing->outcome == RG_UNSUPPORTED) {
            rg_warning("unsupported here: %s", missing->why);
            continue;
        }
        tell_missing(missing->outcome, NULL, missing->why);
        exit = rg_exit_worse(exit, rg_exit_of(missing->outcome));
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
    snprintf(absent->why, sizeof(absent->why), "%.700s", why);
}

// Leaves out a device with the failure that was just met.
static enum rg_outcome leave_out_failed(struct rg_devices *devices, const char *name)
{
    const struct rg_failure failure = rg_failure_take();
    leave_out(devices, name, failure.outcome, failure.line);
    return failure.outcome;
}

static struct rg_device *open_device(const struct rg_device_name *name)
{
    const struct rg_asked asked = {name->name, name->full, name->environment};
    return rg_workers.program ? rg_side_open(&asked) : rg_device_open(name->full);
}

struct rg_device *rg_devices_open_one(const char *name)
{
    struct rg_device_name parsed;
    if (!rg_device_name_read(&name, &parsed) || (*name && !rg_error("--device: one is wanted")))
        return NULL;
    return open_device(&parsed);
}

static void open_listed(struct rg_devices *devices, const struct rg_device_list *list,
                        struct rg_worker *workers[RG_MAX_BACKENDS])
{
    for (int i = 0; i < list->missing_count; i++)
        leave_out(devices, list->missing[i].backend->name, list->missing[i].outcome,
                  list->missing[i].why);
    for (int i = 0; i < list->count; i++) {
        struct rg_worker **worker = workers;
        while (rg_backends[worker - workers] != list->backends[i])
            worker++;
        const char *name = list->infos[i].name;
        struct rg_device *device =
            rg_workers.program ? rg_remote_open(*worker, name, name, NULL) : rg_device_open(name);
        *worker = NULL; // the device owns it now
        if (device)
            devices->devices[devices->count++] = device;
        else
            leave_out_failed(devices, list->infos[i].name);
    }
}

static int open_all(struct rg_devices *devices)
{
    struct rg_worker *workers[RG_MAX_BACKENDS] = {0};
    struct rg_device_list *list = rg_alloc(1, sizeof(*list), "list of devices");
    if (!list)
        return rg_exit_of_error();
    list_all(list, workers);
    rg_devices_complain(list);
    open_listed(devices, list, workers);
    for (int b = 0; b < RG_MAX_BACKENDS; b++)
        rg_worker_destroy(workers[b]);
    free(list);
    return devices->count ? RG_EXIT_PASS
                          : rg_exit_worse(RG_EXIT_UNSUPPORTED, rg_devices_exit(devices));
}

bool rg_devices_are_apart(const struct rg_device_info *a, const struct rg_device_info *b)
{
    struct rg_device_name of_a, of_b;
    const char *full_a = a->full, *full_b = b->full;
    return rg_device_name_read(&full_a, &of_a) && rg_device_name_read(&full_b, &of_b) &&
           rg_drivers_are_apart(a, of_a.environment, b, of_b.environment);
}

static struct rg_device_name read_name(const char *name)
{
    struct rg_device_name read = {0};
    rg_device_name_read(&name, &read);
    return read;
}

bool rg_devices_choose_drivers(const char *a, const char *b)
{
    const struct rg_device_name of_a = read_name(a), of_b = read_name(b);
    return rg_drivers_are_chosen_apart(of_a.full, of_a.environment, of_b.full, of_b.environment);
}

void rg_devices_settings(const char *now, const char *then, char *text, size_t size)
{
    const struct rg_device_name is = read_name(now), was = read_name(then);
    rg_drivers_settings(is.environment, was.environment, text, size);
}

// Short names must be unique, and two devices with different drivers in their names must run
// different ones.
static bool are_apart(const struct rg_devices *devices)
{
    bool ok = true;
    for (int i = 0; ok && i < devices->count; i++)
        for (int j = 0; ok && j < i; j++) {
            const struct rg_device_info *a = &devices->devices[j]->info;
            const struct rg_device_info *b = &devices->devices[i]->info;
            if (!strcmp(a->name, b->name) && strcmp(b->name, b->full) != 0)
                ok = rg_error("--device: '%s' stands there twice; name it once", b->name);
            ok = ok && rg_devices_are_apart(a, b);
        }
    return ok;
}

// Notes a device that is unsupported and opens the others all the same, because required ones may
// be among them.
static int open_named(const char *names, struct rg_devices *devices)
{
    struct rg_device_name name;
    const char *rest = names;
    do {
        if (devices->count + devices->absent_count == RG_MAX_DEVICES) {
            rg_error("--device: more than %d names", RG_MAX_DEVICES);
            return rg_exit_of_error();
        }
        if (!rg_device_name_read(&rest, &name))
            return rg_exit_of_error();
        struct rg_device *device = open_device(&name);
        if (device)
            devices->devices[devices->count++] = device;
        else if (leave_out_failed(devices, name.name) != RG_UNSUPPORTED)
            return rg_exit_of_error();
    } while (*rest);
    if (!are_apart(devices))
        return rg_exit_of_error();
    return devices->absent_count ? RG_EXIT_UNSUPPORTED : RG_EXIT_PASS;
}

bool rg_device_is_of(const char *device, const char *name)
{
    const char *full = rg_device_name_full(device);
    const size_t length = strcspn(full, ":@");
    return !strcmp(device, name) || (strlen(name) == length && !strncmp(full, name, length));
}

static bool is_there(const struct rg_devices *devices, const char *name)
{
    const char *why = "it is not among --device";
    for (int i = 0; i < devices->count; i++)
        if (rg_device_is_of(devices->devices[i]->info.name, name))
            return true;
    enum rg_outcome outcome = RG_UNSUPPORTED;
    for (int i = 0; i < devices->absent_count; i++)
        if (rg_device_is_of(devices->absent[i].name, name)) {
            why = devices->absent[i].why;
            outcome = devices->absent[i].outcome;
        }
    return tell_missing(outcome, name, why);
}

bool rg_devices_have(const struct rg_devices *devices, const char *require)
{
    struct rg_device_name name;
    bool all = true;
    while (require && *require)
        all = rg_device_name_read(&require, &name) && is_there(devices, name.name) && all;
    return all;
}

static int open_required(const char *names, const char *require, struct rg_devices *devices)
{
    *devices = (struct rg_devices){0};
    int exit = !strcmp(names, "all") ? open_all(devices) : open_named(names, devices);
    const bool all_were_tried = exit == RG_EXIT_PASS || exit == RG_EXIT_UNSUPPORTED;
    if (all_were_tried && !rg_devices_have(devices, require))
        exit = rg_exit_of_error();
    if (exit != RG_EXIT_PASS)
        rg_devices_close(devices);
    return exit;
}

int rg_devices_open(const char *names, struct rg_devices *devices)
{
    return open_required(names, NULL, devices);
}

int rg_devices_open_asked(const struct rg_devices_asked *asked, struct rg_devices *devices)
{
    rg_workers.timeout_s = asked->timeout_s;
    return open_required(asked->names, asked->require, devices);
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

int rg_devices_end(struct rg_devices *devices, int exit)
{
    return rg_devices_close(devices) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}
