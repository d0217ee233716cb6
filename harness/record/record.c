#include "harness/record/record.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

const struct rg_tally_field rg_tally_fields[RG_TALLY_FIELDS] = {
    {"runs", offsetof(struct rg_tally, runs)},
    {"dispatches", offsetof(struct rg_tally, dispatches)},
    {"items", offsetof(struct rg_tally, items)},
    {"records", offsetof(struct rg_tally, records)},
    {"fragments", offsetof(struct rg_tally, fragments)},
    {"fragments_kept", offsetof(struct rg_tally, fragments_kept)},
    {"light_evaluations", offsetof(struct rg_tally, light_evaluations)},
    {"texels_fetched", offsetof(struct rg_tally, texels_fetched)},
    {"bytes_written", offsetof(struct rg_tally, bytes_written)},
    {"bytes_read", offsetof(struct rg_tally, bytes_read)},
};

int64_t rg_tally_count(const struct rg_tally *tally, int field)
{
    int64_t count;
    memcpy(&count, (const char *)tally + rg_tally_fields[field].offset, sizeof(count));
    return count;
}

json_t *rg_tally_json(const struct rg_tally *tally)
{
    json_t *json = json_object();
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        const int64_t count = rg_tally_count(tally, i);
        json_object_set_new(json, rg_tally_fields[i].name,
                            rg_is_counted(count) ? json_integer(count) : json_null());
    }
    return json;
}

bool rg_record_end(struct rg_record *record, enum rg_outcome outcome, const char *detail)
{
    record->outcome = outcome;
    rg_text_copy(record->detail, sizeof(record->detail), detail);
    return false;
}

bool rg_record_end_by_error(struct rg_record *record)
{
    const struct rg_failure failure = rg_failure_take();
    return rg_record_end(record, failure.outcome, failure.line);
}

static void settle(double *number)
{
    *number = rg_number_kept(*number);
}

// Copies the times of undisturbed launches, and returns their number.
static int calm_launches(const struct rg_record *record, double times_ms[RG_MAX_LAUNCHES])
{
    int count = 0;
    for (int i = 0; i < record->launch_count; i++)
        if (!rg_launch_is_disturbed(&record->launches[i]))
            times_ms[count++] = record->launches[i].ms;
    return count;
}

int rg_record_calm_launches(const struct rg_record *record)
{
    double times_ms[RG_MAX_LAUNCHES];
    return calm_launches(record, times_ms);
}

static bool is_of_launches(const struct rg_record *record)
{
    return rg_record_calm_launches(record) > 1;
}

void rg_record_settle(struct rg_record *record)
{
    double sorted[RG_MAX_SAMPLES > RG_MAX_LAUNCHES ? RG_MAX_SAMPLES : RG_MAX_LAUNCHES];
    settle(&record->truth_error.flip_mask_mean);
    settle(&record->truth_error.flip_mean);
    settle(&record->create_ms);
    settle(&record->first_frame_ms);
    settle(&record->api_over_wall);
    settle(&record->calibration_begin_ms);
    settle(&record->calibration_end_ms);
    for (int i = 0; i < record->pass_count; i++)
        settle(&record->passes[i].ms);
    for (int i = 0; i < record->sample_count; i++) {
        settle(&record->samples_ms[i]);
        settle(&record->taken[i]);
    }
    for (int i = 0; i < record->launch_count; i++) {
        settle(&record->launches[i].ms);
        settle(&record->launches[i].stolen);
        settle(&record->launches[i].others);
        settle(&record->launches[i].seconds);
    }
    if (is_of_launches(record)) {
        record->frame_ms = rg_median_of_launches(sorted, calm_launches(record, sorted));
    } else if (record->sample_count) {
        memcpy(sorted, record->samples_ms, (size_t)record->sample_count * sizeof(double));
        record->frame_ms = rg_median(sorted, record->sample_count);
    }
}

bool rg_launch_is_disturbed(const struct rg_launch *launch)
{
    return launch->stolen > RG_MOST_TAKEN || launch->others > RG_MOST_TAKEN;
}

bool rg_record_is_whole(const struct rg_record *record)
{
    return record->outcome != RG_OK ||
           (record->pass_frames > 0 && record->sample_count >= record->wanted_samples);
}

int rg_record_disturbed(const struct rg_record *record)
{
    int count = 0;
    for (int i = 0; !is_of_launches(record) && i < record->sample_count; i++)
        count += record->taken[i] > RG_MOST_TAKEN;
    return count;
}

double rg_record_noise(const struct rg_record *record)
{
    const double width = record->frame_ms.high / record->frame_ms.low;
    return width > RG_WIDE_INTERVAL ? sqrt(width) - 1 : 0; // NAN: there is no interval
}

void rg_record_mark(const struct rg_record *record, char mark[RG_MARK_SIZE])
{
    const double noise = rg_record_noise(record);
    const bool is_busy = rg_record_disturbed(record);
    *mark = 0;
    if (noise > 0)
        snprintf(mark, RG_MARK_SIZE, "+-%.0f%%%s", fmin(100 * noise, 1e6), is_busy ? " busy" : "");
    else if (is_busy)
        snprintf(mark, RG_MARK_SIZE, "busy");
}

double rg_record_fps(const struct rg_record *record)
{
    return 1000 / record->frame_ms.median;
}

double rg_record_load_ms(const struct rg_record *record)
{
    return (record->calibration_begin_ms + record->calibration_end_ms) / 2;
}

double rg_record_drift(const struct rg_record *a, const struct rg_record *b)
{
    const double ms_a = rg_record_load_ms(a), ms_b = rg_record_load_ms(b);
    return ms_a > 0 && ms_b > 0 ? fmax(ms_a / ms_b, ms_b / ms_a) : 1;
}

double rg_record_passes_ms(const struct rg_record *record)
{
    double sum = 0;
    for (int i = 0; i < record->pass_count; i++)
        sum += record->passes[i].ms;
    return sum;
}

double rg_record_published_fps(const struct rg_record *record)
{
    const double *fps = rg_named_number(record->published, record->published_count, "fps");
    return fps ? *fps : NAN;
}

void rg_record_published_range(const struct rg_record *record, double *low, double *high)
{
    const struct rg_named *published = record->published;
    const double *least = rg_named_number(published, record->published_count, "ms_per_frame_min");
    const double *most = rg_named_number(published, record->published_count, "ms_per_frame_max");
    *low = most ? 1000 / *most : rg_record_published_fps(record);
    *high = least ? 1000 / *least : rg_record_published_fps(record);
}

// The largest acceptable ratio between our number of particles and the printed one.
#define SAME_COUNT 1.2

bool rg_record_is_other_work(const struct rg_record *record, double *apart)
{
    const double *due = rg_named_number(record->published, record->published_count, "particles");
    const double *found = rg_named_number(record->facts, record->fact_count, "particles");
    double ratio = 1;
    if (due && found && *due > 0 && *found > 0)
        ratio = fmax(*due / *found, *found / *due);
    if (apart)
        *apart = ratio;
    return ratio > SAME_COUNT;
}

void rg_record_row_name(const struct rg_record *record, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < record->row_count && used < size; i++) {
        const struct rg_named *named = &record->row[i];
        char *to = text + used;
        const char *comma = used ? ", " : "";
        if (*named->text && i == 0)
            used += (size_t)snprintf(to, size - used, "%s", named->text);
        else if (*named->text)
            used += (size_t)snprintf(to, size - used, "%s%s %s", comma, named->name, named->text);
        else
            used +=
                (size_t)snprintf(to, size - used, "%s%s %.10g", comma, named->name, named->number);
    }
}
