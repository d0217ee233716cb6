#include "harness/devices/measure/serving/serving.h"

#include "core/base/log.h"
#include "harness/devices/measure/serving/services.h"
#include "harness/devices/workers/fields.h"
#include "harness/devices/workers/worker.h"

bool rg_serve_close(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_served_sessions_close();
    const bool is_clean = rg_served_device_close() || rg_failure_take().outcome == RG_LACKING;
    rg_put_fields(reply, rg_closed_fields, &is_clean);
    return true;
}

#define ROW(name, service, doing) [RG_CALL_##name] = rg_serve_##service,
rg_service *const rg_services[RG_CALL_COUNT_OF_CALLS] = {RG_CALLS(ROW)};

int rg_serving(const char *argument)
{
    return rg_serve(argument, rg_services);
}
