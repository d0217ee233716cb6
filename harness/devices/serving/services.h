// The services of a worker, by subject. Only files of this folder may include this.
#ifndef RG_HARNESS_DEVICES_SERVING_SERVICES_H
#define RG_HARNESS_DEVICES_SERVING_SERVICES_H

#include "core/device/device.h"
#include "harness/devices/workers/serve.h"

// The worker's device, which is opened where it is not yet; `name` may have an environment behind
// it. NULL, and one logged line, on failure.
struct rg_device *rg_served_device(const char *name);
bool rg_served_device_close(void);
// Closes every session.
void rg_served_sessions_close(void);

rg_service rg_serve_hello, rg_serve_list, rg_serve_open, rg_serve_probe, rg_serve_audit,
    rg_serve_ceilings;
rg_service rg_serve_session_open, rg_serve_session_close, rg_serve_step, rg_serve_draw,
    rg_serve_sync, rg_serve_frames, rg_serve_count, rg_serve_stages, rg_serve_time, rg_serve_code,
    rg_serve_read, rg_serve_tell, rg_serve_read_state, rg_serve_obeys, rg_serve_texture,
    rg_serve_digests, rg_serve_contents, rg_serve_dispatches, rg_serve_dispatch,
    rg_serve_kernel_code;

#endif
