#include "harness/tables/sheet/trend.h"

#include <math.h>
#include <string.h>

#include "harness/tables/claims/margin.h"
#include "harness/tables/claims/order.h"

// The 5 % are divided between both sides.
#define ERROR_SHARE 0.025

const char *rg_trend_text(enum rg_trend_verdict verdict)
{
    static const char *const texts[] = {"reproduced",     "trend only", "same order",
                                        "not reproduced", "undecided",  "growth",
                                        "not comparable", "other work"};
    return texts[verdict];
}

const struct rg_named *rg_trend_axis(const struct rg_record *record)
{
    for (int i = 0; i < record->row_count; i++)
        if (!*record->row[i].text)
            return &record->row[i];
    return NULL;
}

// Whether all rows are present and timed, as a trend requires.
static bool is_whole(const struct rg_result *result)
{
    return !result->is_of_textures && rg_result_first_missing(result) > result->last_row;
}

// A trend's rows, as logarithms, except printed values.
struct rows {
    int count;
    const struct rg_record *records[RG_RESULT_ROWS];
    struct rg_slope_point points[RG_RESULT_ROWS];
    double printed[RG_RESULT_ROWS]; // fps
};

static bool is_same(const struct rg_named *a, const struct rg_named *b)
{
    return *a->text ? !strcmp(a->text, b->text) : a->number == b->number;
}

// Whether two rows differ only in the axis. Rows with only a name do not differ.
static bool is_same_group(const struct rg_record *a, const struct rg_record *b)
{
    const struct rg_named *axis = rg_trend_axis(a);
    for (int i = 0; axis && i < a->row_count; i++)
        if (&a->row[i] != axis && !is_same(&a->row[i], &b->row[i]))
            return false;
    return true;
}

static void add_row(struct rows *rows, const struct rg_record *record)
{
    const struct rg_named *along = rg_trend_axis(record);
    const int row = rows->count++;
    int group = 0;
    while (group < row && !is_same_group(rows->records[group], record))
        group++;
    rows->records[row] = record;
    rows->printed[row] = rg_record_published_fps(record);
    rows->points[row] = (struct rg_slope_point){.x = along ? log(along->number) : NAN,
                                                .group = group,
                                                .samples = record->samples_ms,
                                                .count = record->sample_count,
                                                .load_ms = rg_record_load_ms(record)};
}

// If every row differs from all others in more than the axis, these values vary with the axis and
// form no groups.
static void join_single_rows(struct rows *rows)
{
    bool all_single = true;
    for (int i = 0; i < rows->count; i++)
        all_single = all_single && rows->points[i].group == i;
    for (int i = 0; all_single && i < rows->count; i++)
        rows->points[i].group = 0;
}

// Collects rows, without those that did other work. False if a row has no time.
static bool collect(const struct rg_result *result, struct rg_place of, struct rows *rows)
{
    for (of.row = result->first_row; of.row <= result->last_row; of.row++) {
        if (!rg_result_has(result, of.row))
            continue;
        const struct rg_record *record = rg_result_at(result, of);
        if (record->outcome != RG_OK || !record->sample_count)
            return false;
        if (!rg_record_is_other_work(record, NULL))
            add_row(rows, record);
    }
    join_single_rows(rows);
    return true;
}

// --- the order ---

struct orders {
    double surest_against; // p value of the pair most surely in the opposite order
};

// Adds a pair of rows; the first is the faster one in print.
static void add_pair(struct rg_trend *trend, struct orders *orders, const struct rg_record *fast,
                     const struct rg_record *slow)
{
    const bool enough =
        fast->sample_count >= RG_LEAST_SAMPLES && slow->sample_count >= RG_LEAST_SAMPLES;
    const double drift = rg_record_drift(fast, slow);
    const double against = enough
                               ? rg_order_probability(fast->samples_ms, fast->sample_count, drift,
                                                      slow->samples_ms, slow->sample_count)
                               : 1;
    const double in_favour = enough
                                 ? rg_order_probability(slow->samples_ms, slow->sample_count, drift,
                                                        fast->samples_ms, fast->sample_count)
                                 : 1;
    trend->pairs++;
    trend->pairs_in_order += rg_record_fps(fast) > rg_record_fps(slow);
    trend->pairs_undecided += against > ERROR_SHARE && in_favour > ERROR_SHARE;
    orders->surest_against = fmin(orders->surest_against, in_favour);
}

static struct orders count_pairs(struct rg_trend *trend, const struct rows *rows)
{
    struct orders orders = {1};
    for (int a = 0; a < rows->count; a++)
        for (int b = 0; b < rows->count; b++)
            if (rows->points[a].group == rows->points[b].group &&
                rg_margin_orders(rows->printed[a], rows->printed[b]))
                add_pair(trend, &orders, rows->records[a], rows->records[b]);
    return orders;
}

// --- the verdict ---

static void find_slopes(struct rg_trend *trend, const struct rows *rows)
{
    double weights[RG_RESULT_ROWS];
    const struct rg_interval s = rg_slope_resampled(rows->points, rows->count);
    rg_slope_weights(rows->points, rows->count, weights);
    trend->published_slope = 0;
    for (int i = 0; i < rows->count; i++)
        trend->published_slope += weights[i] * log(rows->printed[i]);
    // Frame times grow where rates fall.
    trend->slope = -s.median;
    trend->slope_low = -s.high;
    trend->slope_high = -s.low;
    trend->margin = !isfinite(trend->published_slope)
                        ? NAN
                        : rg_margin_slope(rows->points, weights, rows->printed, rows->count);
    trend->has_slope = isfinite(trend->slope);
}

// The order is reproduced if every pair is decided; that some pair is decided the other way is
// corrected for the number of pairs.
static enum rg_trend_verdict judge(const struct rg_trend *t, const struct orders *orders)
{
    if (orders->surest_against * t->pairs <= ERROR_SHARE)
        return RG_TREND_NOT;
    if (t->pairs_undecided || t->pairs_in_order < t->pairs)
        return RG_TREND_UNDECIDED;
    if (!t->has_slope || !isfinite(t->published_slope))
        return RG_TREND_ORDER;
    return t->slope_low >= t->published_slope - t->margin &&
                   t->slope_high <= t->published_slope + t->margin
               ? RG_TREND_REPRODUCED
               : RG_TREND_ONLY;
}

struct rg_trend rg_trend_of(const struct rg_result *result, struct rg_place of)
{
    struct rg_trend trend = {.verdict = RG_TREND_UNKNOWN};
    struct rows rows = {0};
    if (!is_whole(result))
        return trend;
    if (*result->hardware && !rg_result_is_of_print(result, of.work))
        return (struct rg_trend){.verdict = RG_TREND_OTHER_WORK};
    if (!collect(result, of, &rows))
        return trend;
    trend.axis = rows.count ? rg_trend_axis(rows.records[0]) : NULL;
    if (!*result->hardware) {
        find_slopes(&trend, &rows);
        trend.verdict = trend.has_slope ? RG_TREND_GROWTH : RG_TREND_UNKNOWN;
        return trend;
    }
    const struct orders orders = count_pairs(&trend, &rows);
    if (!trend.pairs)
        return trend;
    find_slopes(&trend, &rows);
    trend.verdict = judge(&trend, &orders);
    return trend;
}

static json_t *trend_json(const struct rg_result *result, struct rg_place of)
{
    const struct rg_trend s = rg_trend_of(result, of);
    const bool known = s.verdict < RG_TREND_UNKNOWN;
    const double slope = known && !s.has_slope ? NAN : s.slope;
    const double published = known && !s.has_slope ? NAN : s.published_slope;
    json_t *json = json_pack("{soss}", "device", rg_json_text(result->devices[of.device].name),
                             "variant", result->variants[of.variant]);
    if (result->work_count)
        json_object_set_new(json, "work", json_string(result->works[of.work].name));
    if (s.has_slope) {
        json_object_set_new(json, "slope_low", rg_number_json(s.slope_low));
        json_object_set_new(json, "slope_high", rg_number_json(s.slope_high));
        json_object_set_new(json, "published_margin", rg_number_json(s.margin));
    }
    json_t *rest =
        json_pack("{sssbsisisisoso}", "verdict", rg_trend_text(s.verdict), "same_ranking",
                  s.pairs_in_order == s.pairs, "pairs", s.pairs, "pairs_in_order", s.pairs_in_order,
                  "pairs_undecided", s.pairs_undecided, "slope", rg_number_json(slope),
                  "published_slope", rg_number_json(published));
    json_object_update(json, rest);
    json_decref(rest);
    return json;
}

json_t *rg_trends_json(const struct rg_result *result)
{
    json_t *trends = json_array();
    struct rg_place of = rg_result_start_row(result->first_row);
    while (!result->is_of_textures && rg_result_next_in_row(result, &of))
        json_array_append_new(trends, trend_json(result, of));
    return trends;
}

// --- the spread ---

static double share_of(double least, double most)
{
    return 1 - least / most;
}

// Adds the rows of a variant. False if a number is missing.
static bool add_variant(const struct rg_result *result, struct rg_place at,
                        double (*fps_of)(const struct rg_record *), struct rg_spread *spread)
{
    double least = INFINITY, most = 0;
    for (at.row = result->first_row; at.row <= result->last_row; at.row++) {
        if (!rg_result_has(result, at.row))
            return false;
        const struct rg_record *record = rg_result_at(result, at);
        const double fps = fps_of(record);
        if (record->outcome != RG_OK || !*record->row[0].text || !(fps > 0))
            return false;
        least = fmin(least, fps);
        most = fmax(most, fps);
    }
    spread->least_fps = fmin(spread->least_fps, least);
    spread->most_fps = fmax(spread->most_fps, most);
    spread->of_a_variant = fmax(spread->of_a_variant, share_of(least, most));
    return true;
}

static bool find_spread(const struct rg_result *result, int work, int device,
                        double (*fps_of)(const struct rg_record *), struct rg_spread *spread)
{
    *spread = (struct rg_spread){.least_fps = INFINITY};
    for (int v = 0; v < result->variant_count; v++) {
        const struct rg_place at = {.work = work, .variant = v, .device = device};
        if (!add_variant(result, at, fps_of, spread))
            return false;
    }
    spread->share = share_of(spread->least_fps, spread->most_fps);
    return true;
}

bool rg_spread_of(const struct rg_result *result, int work, int device, struct rg_spread *measured,
                  struct rg_spread *published)
{
    return !result->is_of_textures && result->last_row > result->first_row &&
           find_spread(result, work, device, rg_record_fps, measured) &&
           find_spread(result, work, device, rg_record_published_fps, published);
}
