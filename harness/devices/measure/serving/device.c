// Serves calls about the device (made by harness/devices/workers/device.c, harness/devices/ and
// harness/compare/doctor/).
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/serving/messages.h"
#include "harness/devices/measure/serving/services.h"
#include "harness/devices/measure/timer_audit.h"
#include "harness/devices/workers/device.h"
#include "core/device/probe.h"

static struct rg_device *device;

struct rg_device *rg_served_device(const char *name)
{
    char plain[RG_DEVICE_NAME_SIZE];
    snprintf(plain, sizeof(plain), "%.*s", (int)strcspn(name, "@"), name);
    if (!device)
        device = rg_device_open(plain);
    return device;
}

bool rg_served_device_close(void)
{
    const bool clean = rg_device_close(device);
    device = NULL;
    return clean;
}

// The only pointer in a list of one backend is that to the backend.
bool rg_serve_list(struct rg_message *request, struct rg_message *reply)
{
    static struct rg_device_list list;
    memset(&list, 0, sizeof(list));
    const int backend = rg_take_index(request, RG_MAX_BACKENDS);
    rg_device_list_add(&list, rg_backends[backend]);
    static struct rg_told_list told;
    told.count = list.count;
    memcpy(told.infos, list.infos, sizeof(told.infos));
    told.outcome = list.missing[0].outcome;
    snprintf(told.why, sizeof(told.why), "%s", list.missing[0].why);
    rg_put_fields(reply, rg_told_list_fields, &told);
    return true;
}

// Loaded libraries stay, so that the API's loader gets the same ones.
bool rg_serve_load(struct rg_message *request, struct rg_message *reply)
{
    char why[512] = "";
    bool any = false;
    for (int64_t i = rg_take_int(request); i > 0 && !any && !request->failed; i--) {
        const char *library = rg_take_text(request);
        any = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
        if (!any && !*why)
            snprintf(why, sizeof(why), "%s", dlerror());
    }
    rg_put_text(reply, any ? "" : why);
    return true;
}

static int index_of(const struct rg_backend *backend)
{
    int index = 0;
    while (rg_backends[index] != backend)
        index++;
    return index;
}

bool rg_serve_open(struct rg_message *request, struct rg_message *reply)
{
    const struct rg_device *opened = rg_served_device(rg_take_text(request));
    if (!opened)
        return false;
    const struct rg_told_device told = {opened->info, index_of(opened->backend)};
    rg_put_fields(reply, rg_told_device_fields, &told);
    return true;
}

// A restarted process has not opened the device.
static bool is_open(void)
{
    return device || rg_driver_error("its device has gone with its process");
}

bool rg_serve_probe(struct rg_message *request, struct rg_message *reply)
{
    struct rg_probe_result results[RG_PROBE_COUNT];
    (void)request;
    if (!is_open() || !rg_probe_run(device, results))
        return false;
    rg_put_fields(reply, rg_probe_fields, results);
    return true;
}

bool rg_serve_drawing(struct rg_message *request, struct rg_message *reply)
{
    struct rg_drawing drawing;
    (void)request;
    if (!rg_drawing_check(device, &drawing))
        return false;
    rg_put_fields(reply, rg_drawing_fields, &drawing);
    return true;
}

bool rg_serve_audit(struct rg_message *request, struct rg_message *reply)
{
    struct rg_timer_audit audit;
    (void)request;
    if (!is_open() || !rg_timer_audit(device, &audit))
        return false;
    rg_put_fields(reply, rg_audit_fields, &audit);
    return true;
}

bool rg_serve_ceilings(struct rg_message *request, struct rg_message *reply)
{
    struct rg_ceilings ceilings;
    (void)request;
    if (!is_open() || !rg_ceilings_measure(device, &ceilings))
        return false;
    rg_put_fields(reply, rg_ceilings_fields, &ceilings);
    return true;
}
