#ifndef RG_HARNESS_PASSPORT_H
#define RG_HARNESS_PASSPORT_H
#include <jansson.h>
#include "core/device.h"
static inline json_t *rg_passport_json(const struct rg_device_info *infos, int count)
{
    (void)infos;
    (void)count;
    return json_object();
}
#endif
