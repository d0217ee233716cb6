#include "harness/tables/sheet/curve.h"

#include <math.h>
#include <string.h>

#include "harness/console/terminal.h"
#include "harness/tables/sheet/trend.h"

enum { LEVELS = 8 };

// The width of a line of curves, if the page is that wide; the next line begins after it.
enum { WIDTH = 100 };

static double measured(const struct rg_record *record)
{
    return record->outcome == RG_OK ? rg_record_fps(record) : NAN;
}

static void find_range(const struct rg_result *result, struct rg_place of,
                       double (*fps_of)(const struct rg_record *), double *least, double *most)
{
    *least = INFINITY;
    *most = 0;
    for (of.row = result->first_row; of.row <= result->last_row; of.row++) {
        const double fps =
            rg_result_has(result, of.row) ? fps_of(rg_result_at(result, of)) : (double)NAN;
        if (fps > 0) {
            *least = fmin(*least, fps);
            *most = fmax(*most, fps);
        }
    }
}

static const char *block_of(double fps, double least, double most)
{
    static const char *const blocks[LEVELS] = {"\u2581", "\u2582", "\u2583", "\u2584",
                                               "\u2585", "\u2586", "\u2587", "\u2588"};
    if (!(fps > 0))
        return ".";
    if (!(most > least))
        return blocks[LEVELS / 2];
    return blocks[(int)fmin(LEVELS * log(fps / least) / log(most / least), LEVELS - 1)];
}

static bool begins_anew(const struct rg_result *result, struct rg_place at)
{
    const struct rg_named *now = rg_trend_axis(rg_result_at(result, at));
    at.row--;
    if (at.row < result->first_row || !rg_result_has(result, at.row))
        return false;
    const struct rg_named *before = rg_trend_axis(rg_result_at(result, at));
    return now && before && now->number < before->number;
}

static int print_curve(const struct rg_result *result, struct rg_place of, const char *name,
                       double (*fps_of)(const struct rg_record *), FILE *out)
{
    double least, most;
    int width = fprintf(out, "%s ", name);
    find_range(result, of, fps_of, &least, &most);
    for (of.row = result->first_row; of.row <= result->last_row; of.row++) {
        const bool there = rg_result_has(result, of.row);
        const double fps = there ? fps_of(rg_result_at(result, of)) : (double)NAN;
        const bool anew = there && begins_anew(result, of);
        fprintf(out, "%s%s", anew ? " " : "", block_of(fps, least, most));
        width += anew ? 2 : 1;
    }
    return width;
}

static bool has_axis(const struct rg_result *result, struct rg_place of)
{
    of.row = result->first_row;
    return result->last_row - result->first_row >= 2 && rg_result_has(result, of.row) &&
           rg_trend_axis(rg_result_at(result, of));
}

// "Curves from 5 to 40: ": the first and the last value of the axis. Returns its length.
static int print_ends(const struct rg_result *result, struct rg_place of, FILE *out)
{
    struct rg_place last = of;
    of.row = result->first_row;
    last.row = result->last_row;
    const struct rg_named *end =
        rg_result_has(result, last.row) ? rg_trend_axis(rg_result_at(result, last)) : NULL;
    return end ? fprintf(out, "Curves from %.10g to %.10g: ",
                         rg_trend_axis(rg_result_at(result, of))->number, end->number)
               : fprintf(out, "Curves: ");
}

void rg_curves_print(const struct rg_result *result, struct rg_place of, FILE *out)
{
    of.device = 0;
    if (!has_axis(result, of))
        return;
    const int width_most = rg_page_width(out) < WIDTH ? rg_page_width(out) : WIDTH;
    int column = print_ends(result, of, out);
    of.row = result->first_row;
    const char *before = "";
    if (isfinite(rg_record_published_fps(rg_result_at(result, of)))) {
        column += print_curve(result, of, "print", rg_record_published_fps, out);
        before = ", ";
    }
    for (; of.device < result->device_count; of.device++) {
        const int rows = result->last_row - result->first_row + 1;
        const int width = (int)strlen(result->devices[of.device].name) + rows + 4;
        const bool fits = column + width <= width_most;
        fprintf(out, "%s", fits ? before : "\n        ");
        before = ", ";
        column = (fits ? column + 2 : 8) +
                 print_curve(result, of, result->devices[of.device].name, measured, out);
    }
    fprintf(out, "\n\n");
}
