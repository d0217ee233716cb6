#include "harness/compare/diff/accepts.h"

#include <stdio.h>

#include "core/device/device.h"
#include "harness/console/progress.h"
#include "harness/devices/devices.h"

static bool draw_mutants(struct rg_accepts *accepts, const struct rg_technique *technique,
                         enum rg_tier tier)
{
    struct rg_progress progress;
    struct rg_verify verify = {.technique = technique, .progress = &progress};
    if (accepts->is_known[tier])
        return true;
    verify.mutant_device = rg_devices_open_one("cpu");
    if (!verify.mutant_device)
        return false;
    rg_progress_start(&progress, rg_verify_mutant_work(&verify));
    accepts->is_known[tier] = rg_verify_mutants_at(&verify, tier, &accepts->of[tier]);
    rg_progress_end(&progress);
    return rg_device_close(verify.mutant_device) && accepts->is_known[tier];
}

static void print_line(const struct rg_tiers *tiers, const struct rg_mutants_told *told)
{
    char alive[2000], holds[RG_TIERS_TEXT];
    rg_tiers_text(tiers, holds);
    printf("  %s", holds);
    if (told) {
        rg_mutants_text(told, alive, sizeof(alive));
        printf("; of %d mutants it accepts %s%s", told->run, told->alive_count ? "" : "none",
               alive);
    }
    printf("\n");
}

static json_t *json_of(const char *tier, const struct rg_mutants_told *told)
{
    json_t *json = json_pack("{s:s}", "tier", tier);
    json_t *alive = told ? json_array() : NULL;
    for (int i = 0; told && i < told->alive_count; i++)
        json_array_append_new(alive, json_string(told->alive[i]));
    if (told) {
        json_object_set_new(json, "mutants", json_integer(told->run));
        json_object_set_new(json, "accepted", alive);
    }
    return json;
}

json_t *rg_accepts_tell(struct rg_accepts *accepts, const struct rg_technique *technique,
                        const struct rg_tiers *tiers, bool wanted, bool as_json)
{
    const int tier = rg_tiers_strictest(tiers);
    const bool is_any = tier < RG_TIER_COUNT;
    if (is_any && wanted && !draw_mutants(accepts, technique, (enum rg_tier)tier))
        return NULL;
    const struct rg_mutants_told *told = is_any && wanted ? &accepts->of[tier] : NULL;
    if (as_json)
        return json_of(is_any ? rg_tier_name((enum rg_tier)tier) : "none", told);
    print_line(tiers, told);
    return NULL;
}
