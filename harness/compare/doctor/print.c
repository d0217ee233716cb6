// Prints the report for people: aligned columns of plain text, at most 100 wide.
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "backends/asked/features.h"
#include "core/base/text/add.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"

enum { WIDTH = 100, LABEL = 14, COLUMN = 14, COLUMNS = (WIDTH - LABEL) / COLUMN };

static void print_label(const char *label)
{
    printf("  %-*s", LABEL - 2, label);
}

// Prints a label, and text next to it, broken at spaces.
static void print_field(const char *label, const char *text)
{
    const int room = WIDTH - LABEL;
    print_label(label);
    for (;;) {
        text += strspn(text, " ");
        int length = (int)strlen(text), cut = length;
        if (length > room)
            for (cut = room; cut > 0 && text[cut] != ' ';)
                cut--;
        if (cut == 0)
            cut = (int)strcspn(text, " "); // a single word wider than the page
        printf("%.*s\n", cut, text);
        text += cut;
        if (!*text)
            return;
        print_label("");
    }
}

// --- machine ---

static const char *string_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text && *text ? text : "unknown";
}

static void join(const json_t *words, char *text, size_t size)
{
    size_t i, used = 0;
    json_t *word;
    *text = 0;
    json_array_foreach(words, i, word) if (used < size) used +=
        (size_t)snprintf(text + used, size - used, "%s%s", i ? " " : "", json_string_value(word));
}

static void print_machine(const json_t *machine)
{
    char text[1024], quota[64] = "no quota";
    const json_t *limit = json_object_get(machine, "quota_cpus");
    print_field("cpu", string_of(machine, "cpu"));
    join(json_object_get(machine, "features"), text, sizeof(text));
    print_field("features", *text ? text : "none of interest");
    if (json_is_real(limit))
        snprintf(quota, sizeof(quota), "quota of %.4g CPUs", json_real_value(limit));
    snprintf(text, sizeof(text), "%lld online, %lld allowed (%s), %s; memory %.1f GiB",
             (long long)json_integer_value(json_object_get(machine, "cores_online")),
             (long long)json_integer_value(json_object_get(machine, "cores_allowed")),
             string_of(machine, "cores_list"), quota,
             (double)json_integer_value(json_object_get(machine, "memory_bytes")) / (1 << 30));
    print_field("cores", text);
    print_field("clocks", string_of(machine, "clocks"));
    snprintf(text, sizeof(text), "%s, %s", string_of(machine, "kernel"),
             string_of(machine, "distribution"));
    print_field("system", text);
}

static void print_passport(json_t *passport)
{
    char text[1024];
    const json_t *build = json_object_get(passport, "raingauge");
    printf("machine\n");
    print_machine(json_object_get(passport, "machine"));
    json_t *environment = json_object_get(passport, "environment"), *value;
    const char *variable, *label = "variables";
    json_object_foreach(environment, variable, value)
    {
        snprintf(text, sizeof(text), "%s=%s", variable, json_string_value(value));
        print_field(label, text);
        label = "";
    }
    if (json_object_size(environment) == 0)
        print_field(label, "none is set that matters (docs/environment.md)");
    snprintf(text, sizeof(text), "%s, commit %s, %s, %s", string_of(build, "version"),
             string_of(build, "commit"), string_of(build, "compiler"), string_of(build, "type"));
    print_field("raingauge", text);
}

// --- devices ---

static void print_limits(const struct rg_limits *limits)
{
    char text[200], groups[100];
    if (limits->max_groups[0] == INT_MAX && limits->max_groups[1] == INT_MAX)
        snprintf(groups, sizeof(groups), "any number of items");
    else
        snprintf(groups, sizeof(groups), "%dx%dx%d groups of %d items", limits->max_groups[0],
                 limits->max_groups[1], limits->max_groups[2], limits->group_items);
    snprintf(text, sizeof(text), "buffers of %lld MiB, images of %d px and %d layers, %s",
             (long long)(limits->max_buffer_bytes >> 20), limits->max_image_px,
             limits->max_image_layers, groups);
    print_field("limits", text);
}

static void print_timer(const struct rg_timer_audit *timer)
{
    char text[200];
    if (timer->has_timer)
        snprintf(text, sizeof(text), "%s: %.2f ms by the API, %.2f ms by wall clock (ratio %.3f)",
                 timer->trusted ? "trusted" : "UNTRUSTED", timer->api_ms, timer->wall_ms,
                 timer->ratio);
    else
        snprintf(text, sizeof(text), "none; wall clock says %.2f ms", timer->wall_ms);
    print_field("timer", text);
    snprintf(text, sizeof(text), "sync %.1f us, dispatch %.1f us, dispatch and sync %.1f us",
             timer->sync_us, timer->dispatch_us, timer->round_trip_us);
    print_field("costs", text);
}

static void print_ceilings(const struct rg_ceilings *ceilings)
{
    char text[200];
    snprintf(text, sizeof(text), "copies %.1f GB/s in memory, %.1f GB/s in cache; %.1f Gop/s",
             ceilings->memory_gb_s, ceilings->cache_gb_s, ceilings->arithmetic_gop_s);
    print_field("ceilings", text);
}

static void print_arithmetic(const struct rg_examination *e)
{
    char text[200];
    const int failures = rg_examination_failures(e);
    if (failures == 0) {
        snprintf(text, sizeof(text), "all %d operations that kernels use give the same bits as C",
                 RG_PROBE_OP_COUNT);
        print_field("arithmetic", text);
        return;
    }
    for (int i = 0; i < RG_PROBE_COUNT; i++) {
        const struct rg_probe_result *r = &e->probe[i];
        if (r->builtin || r->different == 0)
            continue;
        snprintf(text, sizeof(text),
                 "FAIL %s: %d of %d results differ from C, the largest by %u ulp", r->name,
                 r->different, r->compared, r->largest_ulps);
        print_field("arithmetic", text);
    }
}

static void print_drawing(const struct rg_examination *e)
{
    char text[200], names[100] = "";
    const struct rg_drawing *d = &e->drawing;
    int well = 0;
    for (int i = 0; i < d->count; i++) {
        const struct rg_drawn *drawn = &d->formats[i];
        const char *name = rg_format_name(drawn->format);
        if (rg_drawn_is_well(drawn, e->info.tier)) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof(names) - used, "%s%s", well++ ? ", " : "", name);
            continue;
        }
        snprintf(text, sizeof(text), "FAIL %s: %d of %d pixels are not what cpu:reference draws",
                 name, drawn->differing, RG_DRAWING_PIXELS);
        print_field("drawing", text);
    }
    if (well)
        snprintf(text, sizeof(text),
                 "%s, with depth and blending: what cpu:reference draws, in %.1f ms", names, d->ms);
    else
        snprintf(text, sizeof(text), "none: it %s", e->info.limits.no_draws);
    if (well || !d->count)
        print_field("drawing", text);
}

// Prints the parts that times on the device depend on.
static void print_key(const json_t *passport, const struct rg_device_info *info)
{
    char key[RG_KEY_SIZE], of[RG_KEY_TEXT], text[RG_KEY_SIZE + RG_KEY_TEXT + 8];
    json_t *device = rg_passport_device(info), *parts = rg_key_parts(passport, device);
    rg_key_hash(parts, key);
    rg_key_text(parts, of);
    snprintf(text, sizeof(text), "%s of %s", key, of);
    print_field("key", text);
    json_decref(parts);
    json_decref(device);
}

// Names what a native device leaves to its driver: all programs, and what samples; or features.
static void print_native(const struct rg_device_info *info)
{
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    int programs = 0;
    char samples[1024] = "", text[1200], words[RG_FEATURES_TEXT];
    for (int i = 0; i < count; i++) {
        programs += all[i]->draw != NULL;
        if (rg_kernel_samples(all[i]))
            rg_text_add(samples, sizeof(samples), ", ", "%s", all[i]->name);
    }
    snprintf(text, sizeof(text), "draws the items of %d programs by its driver; samples in %s",
             programs, samples);
    rg_features_write(info->features, words);
    print_field("native", info->features == RG_FEATURE_ALL ? text : words);
}

static void print_device(const struct rg_examination *e, const json_t *passport)
{
    char text[700];
    printf("\n%s\n", e->info.name);
    if (e->opened) {
        snprintf(text, sizeof(text), "%s, %s", e->info.api, e->info.software ? "software" : "GPU");
        print_field("api", text);
        print_field("device", e->info.device);
        print_field("driver", e->info.driver);
        if (e->info.native)
            print_native(&e->info);
        print_limits(&e->info.limits);
        print_key(passport, &e->info);
    }
    if (e->probed)
        print_arithmetic(e);
    if (e->drawn)
        print_drawing(e);
    if (e->audited)
        print_timer(&e->timer);
    if (e->measured)
        print_ceilings(&e->ceilings);
    if (*e->why) {
        snprintf(text, sizeof(text), "%s: %s", rg_outcome_name(e->status), e->why);
        print_field("PROBLEM", text);
    }
}

// --- builtins ---

static void print_cell(const struct rg_probe_result *result)
{
    char percent[16], ulps[16], text[40] = "=";
    const double share = 100.0 * result->different / result->compared;
    snprintf(percent, sizeof(percent), share < 0.01 ? "<0.01%%" : "%.3g%%", share);
    snprintf(ulps, sizeof(ulps), result->largest_ulps > 9999 ? ">9999" : "%u",
             result->largest_ulps);
    if (result->different)
        snprintf(text, sizeof(text), "%s %s", percent, ulps);
    printf("%*s", COLUMN, text);
}

static void print_builtins(const struct rg_examination *const *probed, int count)
{
    printf("\n%-*s", LABEL, "builtin");
    for (int d = 0; d < count; d++)
        printf("%*.*s", COLUMN, COLUMN - 1, probed[d]->info.name);
    printf("\n");
    for (int i = RG_PROBE_OP_COUNT; i < RG_PROBE_COUNT; i++) {
        printf("%-*s", LABEL, probed[0]->probe[i].name);
        for (int d = 0; d < count; d++)
            print_cell(&probed[d]->probe[i]);
        printf("\n");
    }
}

// Prints the probed devices, as many side by side as fit.
static void print_builtin_table(const struct rg_doctor_report *report)
{
    const struct rg_examination *probed[RG_MAX_DEVICES];
    int count = 0;
    for (int i = 0; i < report->count; i++)
        if (report->examinations[i].probed)
            probed[count++] = &report->examinations[i];
    if (!count)
        return;
    printf(
        "\nThe drivers' own functions, which kernels never use: how many of %d results differ from "
        "C's,\nand the largest distance in ulp. For information; \"=\": none differs.\n",
        RG_PROBE_INPUTS);
    for (int first = 0; first < count; first += COLUMNS)
        print_builtins(probed + first, count - first < COLUMNS ? count - first : COLUMNS);
}

// --- the report ---

static void print_verdict(const struct rg_doctor_report *report)
{
    int good = 0;
    for (int i = 0; i < report->count; i++)
        good += report->examinations[i].status == RG_OK;
    printf("\n%d of %d devices are well: they work, and compute what C computes\n", good,
           report->count);
}

void rg_doctor_print_text(const struct rg_doctor_report *report)
{
    size_t i;
    json_t *warning;
    print_passport(report->passport);
    for (int d = 0; d < report->count; d++)
        print_device(&report->examinations[d], report->passport);
    print_builtin_table(report);
    if (report->list.missing_count)
        printf("\nmissing\n");
    for (int m = 0; m < report->list.missing_count; m++)
        print_field(m ? "" : "drivers", report->list.missing[m].why);
    if (json_array_size(report->warnings))
        printf("\nwarnings\n");
    json_array_foreach(report->warnings, i, warning) print_field("-", json_string_value(warning));
    print_verdict(report);
}
