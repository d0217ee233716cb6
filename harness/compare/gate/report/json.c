// The JSON forms: Bencher's, and our own, which is read again as well.
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/forms.h"
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
    return json_pack("{ss ss so so ss sb sb ss ss so so so so so}", "name", told->name, "technique",
                     told->technique, "devices", texts_json(told->devices, told->device_count),
                     "seconds", rg_number_json(told->seconds), "ending",
                     rg_ending_name(told->ending), "compared", told->is_compared, "over",
                     told->is_over, "message", told->message, "details", told->details,
                     "attachments", texts_json(told->attachments, told->attachment_count), "ratio",
                     bounded_json(told->ratio), "smallest_visible",
                     rg_number_json(told->smallest_visible), "time_ms", bounded_json(told->time_ms),
                     "baseline_ms", rg_number_json(told->baseline_ms));
}

json_t *rg_report_document(const struct rg_report *report)
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
    if (is_whole)
        return json;
    json_decref(json);
    return NULL;
}

bool rg_report_json(const struct rg_report *report, FILE *out)
{
    return dump(rg_report_document(report), "JSON", out);
}

// --- reading ---

static struct rg_bounded bounded_of(const json_t *object, const char *name)
{
    const json_t *number = json_object_get(object, name);
    return (struct rg_bounded){rg_json_number_of(number, "value"), rg_json_number_of(number, "low"),
                               rg_json_number_of(number, "high")};
}

static const char *text_of(const json_t *object, const char *name)
{
    return json_string_value(json_object_get(object, name));
}

// The texts of an array, as far as they are texts; returns their number.
static int read_texts(const json_t *object, const char *name, const char *texts[], int most)
{
    const json_t *array = json_object_get(object, name), *text;
    size_t i;
    int count = 0;
    json_array_foreach(array, i, text)
    {
        if (json_is_string(text) && count < most)
            texts[count++] = json_string_value(text);
    }
    return count;
}

bool rg_report_read(struct rg_report *report, const json_t *json)
{
    enum { MOST = 16 };
    const char *devices[MOST], *attachments[MOST], *ending = text_of(json, "ending");
    struct rg_report_case found = {.name = text_of(json, "name"),
                                   .technique = text_of(json, "technique"),
                                   .devices = devices,
                                   .device_count = read_texts(json, "devices", devices, MOST),
                                   .seconds = rg_json_number_of(json, "seconds"),
                                   .is_compared = json_is_true(json_object_get(json, "compared")),
                                   .is_over = json_is_true(json_object_get(json, "over")),
                                   .message = text_of(json, "message"),
                                   .details = text_of(json, "details"),
                                   .attachments = attachments,
                                   .ratio = bounded_of(json, "ratio"),
                                   .smallest_visible = rg_json_number_of(json, "smallest_visible"),
                                   .time_ms = bounded_of(json, "time_ms"),
                                   .baseline_ms = rg_json_number_of(json, "baseline_ms")};
    found.attachment_count = read_texts(json, "attachments", attachments, MOST);
    int number = 0;
    while (ending && number < RG_ENDING_COUNT &&
           strcmp(ending, rg_ending_name((enum rg_ending)number)) != 0)
        number++;
    found.ending = (enum rg_ending)number;
    return found.name && ending && number < RG_ENDING_COUNT
               ? rg_report_add(report, &found)
               : rg_error("a gate's record has a case without a name or an ending; run its shard "
                          "again");
}
