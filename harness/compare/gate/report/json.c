// The JSON forms: Bencher's, and our own.
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/report.h"
#include "harness/record/named.h"

static bool dump(json_t *json, const char *form, FILE *out)
{
    const bool is_made =
        json && !json_dumpf(json, out, JSON_INDENT(1) | JSON_REAL_PRECISION(RG_NUMBER_DIGITS));
    json_decref(json);
    fputc('\n', out);
    return is_made ||
           rg_harness_error("%s: cannot be written; see that there is memory and disk", form);
}

// --- Bencher's ---

// Adds a measure. An unknown bound is left out, since jansson makes no number of NaN or infinity,
// and sets none then.
static void set_measure(json_t *measures, const char *name, struct rg_bounded number, double unit)
{
    if (!isfinite(number.value))
        return;
    json_t *measure = json_object();
    json_object_set_new(measure, "value", json_real(number.value * unit));
    json_object_set_new(measure, "lower_value", json_real(number.low * unit));
    json_object_set_new(measure, "upper_value", json_real(number.high * unit));
    json_object_set_new(measures, name, measure);
}

bool rg_report_bmf(const struct rg_report *report, FILE *out)
{
    const double ns_a_ms = 1e6;
    json_t *json = json_object();
    for (int i = 0; i < report->case_count; i++) {
        const struct rg_report_case *told = &report->cases[i];
        json_t *measures = json_object();
        set_measure(measures, "latency", told->time_ms, ns_a_ms);
        set_measure(measures, "ratio", told->ratio, 1);
        if (json_object_size(measures))
            json_object_set(json, told->name, measures);
        json_decref(measures);
    }
    return dump(json, "BMF", out);
}

// --- ours ---

static json_t *texts_json(const char *const *texts, int count)
{
    json_t *json = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(json, rg_json_text(texts[i]));
    return json;
}

static json_t *bounded_json(struct rg_bounded number)
{
    return json_pack("{sososo}", "value", rg_number_json(number.value), "low",
                     rg_number_json(number.low), "high", rg_number_json(number.high));
}

static json_t *case_json(const struct rg_report_case *told)
{
    return json_pack(
        "{ss ss so so ss ss ss so so so so so}", "name", told->name, "technique", told->technique,
        "devices", texts_json(told->devices, told->device_count), "seconds",
        rg_number_json(told->seconds), "ending", rg_ending_name(told->ending), "message",
        told->message, "details", told->details, "attachments",
        texts_json(told->attachments, told->attachment_count), "ratio", bounded_json(told->ratio),
        "smallest_visible", rg_number_json(told->smallest_visible), "time_ms",
        bounded_json(told->time_ms), "baseline_ms", rg_number_json(told->baseline_ms));
}

bool rg_report_json(const struct rg_report *report, FILE *out)
{
    json_t *cases = json_array(), *endings = json_object();
    for (int i = 0; i < RG_ENDING_COUNT; i++)
        json_object_set_new(endings, rg_ending_name((enum rg_ending)i),
                            json_integer(rg_report_count(report, (enum rg_ending)i)));
    bool is_whole = true;
    for (int i = 0; i < report->case_count; i++)
        is_whole &= !json_array_append_new(cases, case_json(&report->cases[i]));
    json_t *json =
        json_pack("{si ss so so}", "format", 1, "passport_text",
                  report->passport ? report->passport : "", "endings", endings, "gated", cases);
    if (!is_whole) {
        json_decref(json);
        json = NULL;
    }
    return dump(json, "JSON", out);
}
