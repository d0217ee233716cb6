#include "harness/tables/sheet/trend.h"

#include <math.h>
#include <string.h>

// Slopes closer than this, in powers of the axis, count as the same.
#define SAME_SLOPE 0.25

const char *rg_trend_text(enum rg_trend_verdict verdict)
{
    static const char *const texts[] = {"reproduced",     "trend only", "same order",
                                        "not reproduced", "growth",     "not comparable",
                                        "other work"};
    return texts[verdict];
}

const struct rg_named *rg_trend_axis(const struct rg_record *record)
{
    for (int i = 0; i < record->row_count; i++)
        if (!*record->row[i].text)
            return &record->row[i];
    return NULL;
}

// Counts the pairs that a row forms with those before it. Equal numbers in print order nothing.
static void count_pairs(struct rg_trend *trend, const double *published, const double *measured,
                        int row)
{
    for (int other = 0; other < row; other++) {
        const double order = published[row] - published[other];
        trend->pairs += order != 0;
        trend->pairs_in_order += order * (measured[row] - measured[other]) > 0;
    }
}

// Whether a table has a trend: all its rows are there, and timed.
static bool is_whole(const struct rg_result *result)
{
    return !result->is_of_textures && rg_result_first_missing(result) > result->last_row;
}

// What the rows of a trend have: logarithms of what is beside each other.
struct points {
    int count;
    double axis[RG_RESULT_ROWS], published[RG_RESULT_ROWS], measured[RG_RESULT_ROWS];
};

static struct rg_trend judge(struct rg_trend trend)
{
    const double apart = fabs(trend.slope - trend.published_slope);
    trend.has_slope = isfinite(trend.slope) && isfinite(trend.published_slope);
    trend.verdict = trend.pairs_in_order < trend.pairs ? RG_TREND_NOT
                    : !trend.has_slope                 ? RG_TREND_ORDER
                    : apart <= SAME_SLOPE              ? RG_TREND_REPRODUCED
                                                       : RG_TREND_ONLY;
    return trend;
}

// Rows that are other work take no part. False where a row has no time.
static bool collect(const struct rg_result *result, struct rg_place of, struct points *points)
{
    for (of.row = result->first_row; of.row <= result->last_row; of.row++) {
        const struct rg_record *record = rg_result_at(result, of);
        const struct rg_named *along = rg_trend_axis(record);
        if (record->outcome != RG_OK)
            return false;
        if (rg_record_is_other_work(record, NULL))
            continue;
        const int row = points->count++;
        points->axis[row] = along ? log(along->number) : NAN;
        points->published[row] = log(rg_record_published_fps(record));
        points->measured[row] = log(rg_record_fps(record));
    }
    return true;
}

static struct rg_trend growth_of(const struct points *points)
{
    const struct rg_interval slope =
        rg_slope_interval(points->axis, points->measured, points->count);
    return (struct rg_trend){
        .verdict = isfinite(slope.median) ? RG_TREND_GROWTH : RG_TREND_UNKNOWN,
        .has_slope = isfinite(slope.median),
        .slope = slope.median,
        .slope_low = slope.low,
        .slope_high = slope.high,
        .published_slope = NAN,
    };
}

struct rg_trend rg_trend_of(const struct rg_result *result, struct rg_place of)
{
    struct rg_trend trend = {.verdict = RG_TREND_UNKNOWN};
    struct points points = {0};
    if (!is_whole(result))
        return trend;
    if (*result->hardware && !rg_result_is_of_print(result, of.work))
        return (struct rg_trend){.verdict = RG_TREND_OTHER_WORK};
    if (!collect(result, of, &points))
        return trend;
    if (!*result->hardware)
        return growth_of(&points);
    for (int row = 0; row < points.count; row++)
        count_pairs(&trend, points.published, points.measured, row);
    if (!trend.pairs)
        return trend;
    const struct rg_interval slope = rg_slope_interval(points.axis, points.measured, points.count);
    trend.slope = slope.median;
    trend.slope_low = slope.low;
    trend.slope_high = slope.high;
    trend.published_slope = rg_slope(points.axis, points.published, points.count);
    return judge(trend);
}

static json_t *trend_json(const struct rg_result *result, struct rg_place of)
{
    const struct rg_trend s = rg_trend_of(result, of);
    const bool known = s.verdict < RG_TREND_UNKNOWN;
    const double slope = known && !s.has_slope ? NAN : s.slope;
    const double published = known && !s.has_slope ? NAN : s.published_slope;
    json_t *json = json_pack("{ssss}", "device", result->devices[of.device].name, "variant",
                             result->variants[of.variant]);
    if (result->work_count)
        json_object_set_new(json, "work", json_string(result->works[of.work].name));
    if (s.has_slope) {
        json_object_set_new(json, "slope_low", rg_number_json(s.slope_low));
        json_object_set_new(json, "slope_high", rg_number_json(s.slope_high));
    }
    json_t *rest =
        json_pack("{sssbsisisoso}", "verdict", rg_trend_text(s.verdict), "same_ranking",
                  s.pairs_in_order == s.pairs, "pairs", s.pairs, "pairs_in_order", s.pairs_in_order,
                  "slope", rg_number_json(slope), "published_slope", rg_number_json(published));
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

// Adds the rows of a variant. False where a number is missing.
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
