#include "harness/devices/serving/serving.h"

#include "harness/devices/serving/caches.h"
#include "harness/devices/serving/services.h"

static bool serve_close(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    rg_served_sessions_close();
    return rg_served_device_close();
}

int rg_serving(const char *argument)
{
    static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
        [RG_CALL_HELLO] = rg_serve_hello,
        [RG_CALL_LIST] = rg_serve_list,
        [RG_CALL_OPEN] = rg_serve_open,
        [RG_CALL_CLOSE] = serve_close,
        [RG_CALL_PROBE] = rg_serve_probe,
        [RG_CALL_AUDIT] = rg_serve_audit,
        [RG_CALL_CEILINGS] = rg_serve_ceilings,
        [RG_CALL_SESSION_OPEN] = rg_serve_session_open,
        [RG_CALL_SESSION_CLOSE] = rg_serve_session_close,
        [RG_CALL_STEP] = rg_serve_step,
        [RG_CALL_DRAW] = rg_serve_draw,
        [RG_CALL_SYNC] = rg_serve_sync,
        [RG_CALL_FRAMES] = rg_serve_frames,
        [RG_CALL_COUNT] = rg_serve_count,
        [RG_CALL_STAGES] = rg_serve_stages,
        [RG_CALL_TIME] = rg_serve_time,
        [RG_CALL_CODE] = rg_serve_code,
        [RG_CALL_READ] = rg_serve_read,
        [RG_CALL_TELL] = rg_serve_tell,
        [RG_CALL_READ_STATE] = rg_serve_read_state,
        [RG_CALL_OBEYS] = rg_serve_obeys,
        [RG_CALL_TEXTURE] = rg_serve_texture,
        [RG_CALL_DIGESTS] = rg_serve_digests,
        [RG_CALL_CONTENTS] = rg_serve_contents,
        [RG_CALL_DISPATCHES] = rg_serve_dispatches,
        [RG_CALL_DISPATCH] = rg_serve_dispatch,
        [RG_CALL_KERNEL_CODE] = rg_serve_kernel_code,
    };
    rg_caches_part();
    return rg_serve(argument, services);
}
