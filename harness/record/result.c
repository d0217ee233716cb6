#include "harness/record/result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// --- rows ---

static int works(const struct rg_result *result)
{
    return result->work_count ? result->work_count : 1;
}

int rg_result_row_cells(const struct rg_result *result)
{
    return works(result) * result->variant_count * result->device_count;
}

bool rg_result_has(const struct rg_result *result, int row)
{
    return row >= result->first_row && row <= result->last_row &&
           result->rows[row - result->first_row];
}

bool rg_result_is_whole(const struct rg_result *result, int row)
{
    bool whole = true;
    for (struct rg_place at = rg_result_start_row(row);
         !result->is_of_textures && rg_result_next_in_row(result, &at);)
        whole = whole && rg_record_is_whole(rg_result_at(result, at));
    return whole;
}

void rg_result_drop_begun(struct rg_result *result)
{
    for (int row = result->first_row; row <= result->last_row; row++)
        if (rg_result_has(result, row) && !rg_result_is_whole(result, row))
            rg_result_drop_row(result, row);
}

bool rg_result_wants(const struct rg_result *result, int row)
{
    return !result->left_out[row - result->first_row];
}

static bool is_done(const struct rg_result *result, int row)
{
    return rg_result_has(result, row) || !rg_result_wants(result, row);
}

int rg_result_first_missing(const struct rg_result *result)
{
    int row = result->first_row;
    while (row <= result->last_row && is_done(result, row))
        row++;
    return row;
}

bool rg_result_add_row(struct rg_result *result, int row)
{
    rg_result_drop_row(result, row);
    result->rows[row - result->first_row] =
        rg_alloc((size_t)rg_result_row_cells(result), sizeof(struct rg_record), result->table);
    return rg_result_has(result, row);
}

void rg_result_drop_row(struct rg_result *result, int row)
{
    free(result->rows[row - result->first_row]);
    result->rows[row - result->first_row] = NULL;
}

bool rg_result_keep_rows(struct rg_result *result, int first, int last)
{
    if (first > result->last_row || last < result->first_row)
        return false;
    for (int row = result->first_row; row <= result->last_row; row++)
        if (row < first || row > last)
            rg_result_drop_row(result, row);
    const int before = first > result->first_row ? first - result->first_row : 0;
    const size_t left = (size_t)(RG_RESULT_ROWS - before), size = sizeof(result->rows[0]);
    memmove(result->rows, result->rows + before, left * size);
    memset(result->rows + left, 0, (size_t)before * size);
    memmove(result->left_out, result->left_out + before, left * sizeof(result->left_out[0]));
    memset(result->left_out + left, 0, (size_t)before * sizeof(result->left_out[0]));
    result->first_row += before;
    result->last_row = last < result->last_row ? last : result->last_row;
    return true;
}

bool rg_result_keep_work(struct rg_result *result, const char *work)
{
    int kept = 0;
    while (kept < result->work_count && strcmp(result->works[kept].name, work) != 0)
        kept++;
    if (!result->work_count || kept == result->work_count)
        return !result->work_count;
    const size_t cells = (size_t)(result->variant_count * result->device_count);
    for (int i = 0; i < RG_RESULT_ROWS; i++)
        if (result->rows[i])
            memmove(result->rows[i], result->rows[i] + (size_t)kept * cells,
                    cells * sizeof(struct rg_record));
    result->works[0] = result->works[kept];
    result->work_count = 1;
    return true;
}

bool rg_result_keep_variant(struct rg_result *result, const char *variant)
{
    int kept = 0;
    while (kept < result->variant_count && strcmp(result->variants[kept], variant) != 0)
        kept++;
    if (kept == result->variant_count)
        return false;
    const size_t devices = (size_t)result->device_count;
    for (int i = 0; i < RG_RESULT_ROWS; i++)
        for (int work = 0; result->rows[i] && work < works(result); work++) {
            const size_t from = (size_t)(work * result->variant_count + kept) * devices;
            memmove(result->rows[i] + (size_t)work * devices, result->rows[i] + from,
                    devices * sizeof(struct rg_record));
        }
    memmove(result->variants[0], result->variants[kept], sizeof(result->variants[0]));
    result->variant_count = 1;
    return true;
}

bool rg_result_is_of_print(const struct rg_result *result, int work)
{
    return *result->hardware && !*result->works[work].saves && !*result->changed &&
           result->size_divisor <= 1;
}

int rg_result_printed_work(const struct rg_result *result)
{
    for (int i = 0; i < result->work_count; i++)
        if (!strcmp(result->works[i].name, "paper"))
            return i;
    return result->work_count ? -1 : 0;
}

// --- cells ---

struct rg_record *rg_result_at(const struct rg_result *result, struct rg_place place)
{
    const int variant = place.work * result->variant_count + place.variant;
    return &result->rows[place.row - result->first_row]
                        [variant * result->device_count + place.device];
}

struct rg_place rg_result_start_row(int row)
{
    return (struct rg_place){.row = row, .device = -1};
}

bool rg_result_next_in_row(const struct rg_result *result, struct rg_place *at)
{
    if (++at->device < result->device_count)
        return true;
    at->device = 0;
    if (++at->variant < result->variant_count)
        return true;
    at->variant = 0;
    return ++at->work < works(result);
}

struct rg_place rg_result_start(const struct rg_result *result)
{
    return rg_result_start_row(result->first_row);
}

bool rg_result_next(const struct rg_result *result, struct rg_place *at)
{
    while (at->row <= result->last_row) {
        if (rg_result_has(result, at->row) && rg_result_next_in_row(result, at))
            return true;
        *at = rg_result_start_row(at->row + 1);
    }
    return false;
}

// Finds a record's cell in another result; false if that lacks it.
static bool find_place(const struct rg_result *in, const struct rg_record *record, int row,
                       struct rg_place *at)
{
    if (!rg_result_has(in, row))
        return false;
    for (*at = rg_result_start_row(row); rg_result_next_in_row(in, at);)
        if (!strcmp(in->work_count ? in->works[at->work].name : "", record->work) &&
            !strcmp(in->variants[at->variant], record->variant) &&
            !strcmp(in->devices[at->device].name, record->device.name))
            return true;
    return false;
}

void rg_result_take(struct rg_result *into, const struct rg_result *from)
{
    struct rg_place to;
    for (struct rg_place at = rg_result_start(from); rg_result_next(from, &at);)
        if (find_place(into, rg_result_at(from, at), at.row, &to))
            *rg_result_at(into, to) = *rg_result_at(from, at);
}

void rg_result_medians_of(const struct rg_result *result, char *text, size_t size)
{
    static const char *const names[2] = {"samples", "launches"};
    int least[2] = {0}, most[2] = {0};
    size_t used = 0;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        const int launches = rg_record_calm_launches(record), of = launches > 1;
        const int count = of ? launches : record->sample_count;
        if (record->outcome != RG_OK || !count)
            continue;
        least[of] = !least[of] || count < least[of] ? count : least[of];
        most[of] = count > most[of] ? count : most[of];
    }
    rg_text_copy(text, size, "0 samples");
    for (int of = 1; of >= 0; of--) {
        if (most[of] && used < size)
            used +=
                (size_t)snprintf(text + used, size - used, "%s%d", used ? " or " : "", least[of]);
        if (least[of] < most[of] && used < size)
            used += (size_t)snprintf(text + used, size - used, " to %d", most[of]);
        if (most[of] && used < size)
            used += (size_t)snprintf(text + used, size - used, " %s", names[of]);
    }
}

double rg_result_drift(const struct rg_result *result)
{
    double least = INFINITY, most = 0;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        if (!(record->calibration_begin_ms > 0))
            continue;
        least = fmin(least, fmin(record->calibration_begin_ms, record->calibration_end_ms));
        most = fmax(most, fmax(record->calibration_begin_ms, record->calibration_end_ms));
    }
    return most > 0 ? most / least - 1 : 0;
}

void rg_result_free(struct rg_result *result)
{
    for (int i = 0; i < RG_RESULT_ROWS; i++)
        free(result->rows[i]);
    json_decref(result->passport);
    *result = (struct rg_result){0};
}
