// Prints the changes between a baseline and the one before it.
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/compare/gate/baseline/baseline.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "harness/record/passport/key.h"

// Appends to the changes of a cell, in one line.
enum { LINE = 1024 };
#define PUT(line, ...) rg_text_add(line, LINE, ", ", __VA_ARGS__)

// --- a cell ---

static void put_states(char line[LINE], const struct rg_baseline_row *then,
                       const struct rg_baseline_row *now)
{
    for (int i = 0; i < now->state_count; i++) {
        const char *was = rg_baseline_state(then, now->states[i].name);
        if (!was || strcmp(was, now->states[i].digest) != 0)
            PUT(line, "%s state '%s'", was ? "another" : "a new", now->states[i].name);
    }
    for (int i = 0; i < then->state_count; i++)
        if (!rg_baseline_state(now, then->states[i].name))
            PUT(line, "no state '%s'", then->states[i].name);
}

static const struct rg_count *find_counter(const struct rg_counters *counters, const char *name)
{
    for (int i = 0; i < counters->count; i++)
        if (!strcmp(counters->counters[i].name, name))
            return &counters->counters[i];
    return NULL;
}

static void put_counters(char line[LINE], const struct rg_counters *then,
                         const struct rg_counters *now)
{
    for (int i = 0; i < now->count; i++) {
        const struct rg_count *is = &now->counters[i], *was = find_counter(then, is->name);
        if (!was)
            PUT(line, "a new counter '%s'", is->name);
        else if (was->value != is->value)
            PUT(line, "'%s' %" PRId64 " and not %" PRId64, is->name, is->value, was->value);
    }
    for (int i = 0; i < then->count; i++)
        if (!find_counter(now, then->counters[i].name))
            PUT(line, "no counter '%s'", then->counters[i].name);
}

static void put_work(char line[LINE], const struct rg_tally *then, const struct rg_tally *now)
{
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        const int64_t was = rg_tally_count(then, i), is = rg_tally_count(now, i);
        if (was != is)
            PUT(line, "%" PRId64 " %s a frame and not %" PRId64, is, rg_tally_fields[i].name, was);
    }
}

// `rows`: the number of cells among which a gate shares its error.
static void put_times(char line[LINE], int rows, const struct rg_launches *then,
                      const struct rg_launches *now)
{
    struct rg_gate_rule rule = rg_gate_rule_apart(rows);
    rule.look_count = 1;
    const struct rg_gate_sample was = rg_baseline_sample(then), is = rg_baseline_sample(now);
    if (!then->count != !now->count)
        PUT(line, now->count ? "timed now" : "not timed any more");
    if (!then->count || !now->count)
        return;
    const struct rg_gate_decision d = rg_gate_decide_apart(&rule, &was, is.logs, is.count);
    if (d.verdict == RG_TWO_REGRESSED || d.verdict == RG_TWO_IMPROVED)
        PUT(line, "%.3g ms a frame and not %.3g", rg_launches_median(now),
            rg_launches_median(then));
}

static void put_row(char line[LINE], const struct rg_baseline_row *then,
                    const struct rg_baseline_row *now, bool same_key, int rows)
{
    if (strcmp(then->settings, now->settings) != 0)
        PUT(line, "other settings");
    if (then->outcome != now->outcome)
        PUT(line, "%s and not %s%s%s", rg_outcome_name(now->outcome),
            rg_outcome_name(then->outcome), *now->why ? ": " : "", now->why);
    if (strcmp(then->picture, now->picture) != 0)
        PUT(line, "another picture");
    put_states(line, then, now);
    put_counters(line, &then->counters, &now->counters);
    put_work(line, &then->work, &now->work);
    if (same_key)
        put_times(line, rows, &then->launches, &now->launches);
}

// --- fixed functions ---

static int print_digest(const char *device, const char *feature, const json_t *was,
                        const json_t *is, FILE *out)
{
    if (json_equal(was, is))
        return 0;
    fprintf(out, "%c fixed function '%s' of %s: %s\n",
            !was ? '+'
            : is ? '~'
                 : '-',
            feature, device,
            !was ? "new"
            : is ? "another digest"
                 : "gone");
    return 1;
}

static int print_fixed(const json_t *then, const json_t *now, const char *device, FILE *out)
{
    json_t *was = (json_t *)rg_fixed_kept(then, device), *is = (json_t *)rg_fixed_kept(now, device);
    const char *feature;
    json_t *digest;
    int count = 0;
    json_object_foreach(is, feature, digest)
    {
        count += print_digest(device, feature, json_object_get(was, feature), digest, out);
    }
    json_object_foreach(was, feature, digest)
    {
        if (!json_object_get(is, feature))
            count += print_digest(device, feature, digest, NULL, out);
    }
    return count;
}

// --- all changes ---

static int print_devices(const struct rg_baseline *then, const struct rg_baseline *now, FILE *out)
{
    int count = 0;
    for (int i = 0; i < now->device_count; i++) {
        const struct rg_baseline_device *is = &now->devices[i];
        const struct rg_baseline_device *was = rg_baseline_device(then, is->name);
        char text[RG_KEY_TEXT];
        if (!was || json_equal(is->parts, was->parts))
            continue;
        rg_key_difference(is->parts, was->parts, text);
        fprintf(out, "~ %s: another key: %s\n", is->name, text);
        count++;
    }
    return count;
}

static bool has_same_key(const struct rg_baseline *then, const struct rg_baseline *now,
                         const char *device)
{
    const struct rg_baseline_device *was = rg_baseline_device(then, device);
    const struct rg_baseline_device *is = rg_baseline_device(now, device);
    return was && is && json_equal(was->parts, is->parts);
}

static int print_row(const struct rg_baseline *then, const struct rg_baseline *now,
                     const struct rg_baseline_row *row, FILE *out)
{
    const struct rg_baseline_row *was = rg_baseline_find(then, row->cell, row->device);
    char line[LINE] = "";
    if (was)
        put_row(line, was, row, has_same_key(then, now, row->device), (int)now->count);
    else
        PUT(line, "new");
    if (!*line)
        return 0;
    fprintf(out, "%c %s.%s: %s\n", was ? '~' : '+', row->cell, row->device, line);
    return 1;
}

int rg_baseline_print_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                              FILE *out)
{
    int count = print_devices(then, now, out);
    for (int i = 0; i < now->device_count; i++)
        count += print_fixed(then->passport, now->passport, now->devices[i].name, out);
    for (int64_t i = 0; i < now->count; i++)
        count += print_row(then, now, &now->rows[i], out);
    for (int64_t i = 0; i < then->count; i++) {
        const struct rg_baseline_row *row = &then->rows[i];
        if (rg_baseline_find(now, row->cell, row->device))
            continue;
        fprintf(out, "- %s.%s: gone\n", row->cell, row->device);
        count++;
    }
    return count;
}
