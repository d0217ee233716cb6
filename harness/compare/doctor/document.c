// Prints the report as JSON; "doctor" in docs/records.schema.json.
#include <limits.h>
#include <stdio.h>

#include "harness/compare/doctor/doctor.h"
#include "harness/record/named.h"
#include "harness/record/passport/passport.h"

static json_t *limit(int64_t value)
{
    return value == INT_MAX ? json_null() : json_integer((json_int_t)value);
}

static json_t *limits(const struct rg_limits *l)
{
    return json_pack("{sIsisis[ooo]si}", "max_buffer_bytes", (json_int_t)l->max_buffer_bytes,
                     "max_image_px", l->max_image_px, "max_image_layers", l->max_image_layers,
                     "max_groups", limit(l->max_groups[0]), limit(l->max_groups[1]),
                     limit(l->max_groups[2]), "group_items", l->group_items);
}

static json_t *probe(const struct rg_probe_result *results, bool builtin)
{
    json_t *rows = json_array();
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        if (results[i].builtin == builtin)
            json_array_append_new(rows,
                                  json_pack("{sssisisI}", "name", results[i].name, "compared",
                                            results[i].compared, "different", results[i].different,
                                            "largest_ulps", (json_int_t)results[i].largest_ulps));
    return rows;
}

static json_t *timer(const struct rg_timer_audit *t)
{
    return json_pack("{sisfsososbsfsfsf}", "passes", t->passes, "wall_ms", t->wall_ms, "api_ms",
                     t->has_timer ? json_real(t->api_ms) : json_null(), "ratio",
                     t->has_timer ? json_real(t->ratio) : json_null(), "trusted", t->trusted,
                     "sync_us", t->sync_us, "dispatch_us", t->dispatch_us, "round_trip_us",
                     t->round_trip_us);
}

static json_t *drawing(const struct rg_drawing *d)
{
    json_t *formats = json_array();
    for (int i = 0; i < d->count; i++)
        json_array_append_new(
            formats, json_pack("{sssisi}", "name", rg_format_name(d->formats[i].format), "compared",
                               RG_DRAWING_PIXELS, "different", d->formats[i].differing));
    return json_pack("{sosf}", "formats", formats, "ms", d->ms);
}

static json_t *device(const struct rg_examination *e)
{
    json_t *row = e->opened ? rg_passport_device(&e->info)
                            : json_pack("{so}", "name", rg_json_text(e->info.name));
    rg_outcome_set(row, e->status);
    json_object_set_new(row, "why", rg_json_text(e->why));
    if (e->opened)
        json_object_set_new(row, "limits", limits(&e->info.limits));
    if (e->probed) {
        json_object_set_new(row, "operations", probe(e->probe, false));
        json_object_set_new(row, "builtins", probe(e->probe, true));
    }
    if (e->drawn)
        json_object_set_new(row, "drawing", drawing(&e->drawing));
    if (e->audited)
        json_object_set_new(row, "timer", timer(&e->timer));
    if (e->measured)
        json_object_set_new(row, "ceilings",
                            json_pack("{sfsfsf}", "memory_gb_s", e->ceilings.memory_gb_s,
                                      "cache_gb_s", e->ceilings.cache_gb_s, "arithmetic_gop_s",
                                      e->ceilings.arithmetic_gop_s));
    return row;
}

void rg_doctor_print_json(const struct rg_doctor_report *report)
{
    json_t *devices = json_array(), *missing = json_array();
    for (int i = 0; i < report->count; i++)
        json_array_append_new(devices, device(&report->examinations[i]));
    for (int i = 0; i < report->list.missing_count; i++)
        json_array_append_new(missing, rg_json_text(report->list.missing[i].why));
    json_t *root = json_pack("{sisOsososO}", "format", 1, "passport", report->passport, "devices",
                             devices, "missing", missing, "warnings", report->warnings);
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    printf("\n");
    json_decref(root);
}
