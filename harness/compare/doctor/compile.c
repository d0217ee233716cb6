#include "harness/compare/doctor/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/frames/digests.h"

// Slots hold zeros, enough for all that one item without parameters reads.
enum { BUFFER_ELEMENTS = 4096, IMAGE_PX = 16, IMAGE_LAYERS = 6 };

struct pair {
    struct rg_device *device, *reference;
    int compiled, ran;
    int exit;         // enum rg_exit of the failures
    json_t *failures; // {kernel, status, why} each
};

// --- choosing ---

static bool is_among(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = names; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        if (strcspn(at, ",") == length && !strncmp(at, name, length))
            return true;
    return !strcmp(names, "all");
}

bool rg_doctor_knows_kernels(const char *names)
{
    char name[120];
    for (const char *at = names; at && strcmp(names, "all") != 0;
         at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        snprintf(name, sizeof(name), "%.*s", (int)strcspn(at, ","), at);
        if (!rg_kernel_find(name))
            return rg_error("--kernels: there is no kernel '%s'; `all`, or names of kernels with "
                            "commas between them, as lines about drivers have them",
                            name);
    }
    return true;
}

// --- an item of zeros ---

static bool make_zeros(const struct rg_slot_info *slot, struct rg_contents *contents)
{
    const bool is_image = slot->format != RG_FORMAT_NONE;
    if (is_image)
        contents->desc = (struct rg_image_desc){slot->format, IMAGE_PX, IMAGE_PX, IMAGE_LAYERS, 1};
    contents->size = is_image ? rg_contents_size(&contents->desc)
                              : (size_t)BUFFER_ELEMENTS * (size_t)slot->element_size;
    contents->bytes = rg_alloc(1, contents->size, slot->name);
    return contents->bytes;
}

static bool run_zeros(const struct rg_kernel *kernel, struct rg_device *device)
{
    struct rg_dispatched d = {.kernel = kernel, .was_kept = true, .extent = {1, 1, 1}};
    bool ok = true;
    for (int i = 0; ok && i < kernel->slot_count; i++)
        ok = make_zeros(&kernel->slots[i], &d.before[kernel->slots[i].slot]);
    ok = ok && rg_digests_dispatch(&d, device);
    rg_dispatched_free(&d);
    return ok;
}

// Whether running an item is safe, tried on a device that checks every index.
static bool is_harmless(const struct rg_kernel *kernel, struct rg_device *reference)
{
    rg_log_hold(true);
    const bool ok = run_zeros(kernel, reference);
    if (!ok)
        rg_worker_renew(rg_remote_worker(reference));
    rg_log_hold(false);
    return ok;
}

// --- compiling ---

// Notes a failure, which has been logged, and renews the worker: the device may have to be opened
// anew.
static void note(struct pair *p, const struct rg_kernel *kernel)
{
    const struct rg_failure failure = rg_failure_take();
    if (failure.outcome == RG_UNSUPPORTED)
        return; // the device lacks room for the kernel, which is no fault
    p->exit = rg_exit_worse(p->exit, rg_exit_of(failure.outcome));
    json_array_append_new(p->failures,
                          json_pack("{ss ss ss}", "kernel", kernel->name, "status",
                                    rg_outcome_name(failure.outcome), "why", failure.line));
    rg_worker_renew(rg_remote_worker(p->device));
}

static void try_kernel(struct pair *p, const struct rg_kernel *kernel)
{
    bool ok = rg_digests_compile(p->device, kernel);
    p->compiled += ok;
    if (ok && !kernel->draw && is_harmless(kernel, p->reference)) {
        ok = run_zeros(kernel, p->device);
        p->ran += ok;
    }
    if (!ok)
        note(p, kernel);
}

static void print(const struct pair *p)
{
    size_t i;
    json_t *failure;
    printf("%s: %d kernels compile, an item of %d of them was run, and %zu fail\n",
           p->device->info.name, p->compiled, p->ran, json_array_size(p->failures));
    json_array_foreach(p->failures, i, failure)
        printf("  %s: %s\n", json_string_value(json_object_get(failure, "kernel")),
               json_string_value(json_object_get(failure, "status")));
}

static int try_all(struct pair *p, const char *names, json_t *report)
{
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    p->failures = json_array();
    for (int i = 0; i < count; i++)
        if (is_among(names, all[i]->name))
            try_kernel(p, all[i]);
    const int exit = json_array_size(p->failures) ? p->exit
                     : p->compiled                ? RG_EXIT_PASS
                                                  : RG_EXIT_UNSUPPORTED;
    if (report)
        json_array_append_new(report,
                              json_pack("{ss si si sO}", "device", p->device->info.name, "compiled",
                                        p->compiled, "ran", p->ran, "failed", p->failures));
    else
        print(p);
    json_decref(p->failures);
    return exit;
}

int rg_doctor_compile(const char *name, const char *names, json_t *report)
{
    struct pair p = {.device = rg_devices_open_one(name)};
    int exit = p.device ? RG_EXIT_PASS : rg_exit_of_error();
    if (p.device)
        p.reference = rg_devices_open_one("cpu:reference");
    if (p.device && !p.reference)
        exit = rg_exit_of_error();
    else if (p.device)
        exit = try_all(&p, names, report);
    if (p.reference && !rg_device_close(p.reference))
        exit = rg_exit_worse(exit, RG_EXIT_FAIL);
    if (p.device && !rg_device_close(p.device))
        exit = rg_exit_worse(exit, RG_EXIT_FAIL);
    return exit;
}
