#include "harness/tables/sheet/below.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/text/wrap.h"
#include "harness/console/terminal.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/sheet/digits.h"
#include "harness/tables/sheet/sheet.h"
#include "harness/tables/sheet/trend.h"

// Limit of the notes' lines.
enum { LINES = 5 };

// --- claims ---

// Colours of verdicts up to OTHER_WORK; others have none.
static const char *const colours[RG_CLAIM_OTHER_WORK + 1] = {RG_GREEN, RG_RED, RG_YELLOW, RG_YELLOW,
                                                             RG_YELLOW};

// "reproduced on cpu, gl; undecided on opencl"; "reproduced on all devices".
static void print_verdicts(const struct rg_claim *claim, const struct rg_result *result,
                           bool painted, const char *between, FILE *out)
{
    struct rg_judgement of[RG_MAX_DEVICES];
    for (int d = 0; d < result->device_count; d++)
        of[d] = rg_claim_judge(claim, result, d);
    for (int first = 0, told = 0; first < result->device_count; first++) {
        const char *text = rg_judgement_text(&of[first]);
        const bool has_colour = painted && of[first].verdict <= RG_CLAIM_OTHER_WORK;
        char names[512] = "";
        size_t used = 0;
        int found = 0;
        bool is_told = false;
        for (int d = 0; d < result->device_count && used < sizeof(names); d++) {
            if (strcmp(rg_judgement_text(&of[d]), text) != 0)
                continue;
            is_told = is_told || d < first;
            used += (size_t)snprintf(names + used, sizeof(names) - used, "%s%s",
                                     found++ ? ", " : "", result->devices[d].name);
        }
        if (!is_told)
            fprintf(out, "%s%s%s%s on %s", told++ ? between : "",
                    has_colour ? colours[of[first].verdict] : "", text, has_colour ? RG_PLAIN : "",
                    found > 1 && found == result->device_count ? "all devices" : names);
    }
}

// The length of the verdicts, without colours.
static int verdicts_length(const struct rg_claim *claim, const struct rg_result *result)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return 0;
    print_verdicts(claim, result, false, "; ", out);
    fclose(out);
    free(text);
    return (int)size;
}

// ", by 2 of 5 rows", if some device decided a claim so.
static void name_fewer_rows(const struct rg_claim *claim, const struct rg_result *result,
                            char *text, size_t size)
{
    *text = 0;
    for (int d = 0; d < result->device_count && !*text; d++) {
        const struct rg_judgement j = rg_claim_judge(claim, result, d);
        if (rg_claim_is_decided(j.verdict) && j.rows < j.rows_needed)
            snprintf(text, size, ", by %d of %d rows", j.rows, j.rows_needed);
    }
}

static void print_claims(const struct rg_result *result, FILE *out)
{
    bool any = false;
    for (const struct rg_claim *claim = rg_claims; claim->table && !result->is_part; claim++) {
        if (strcmp(claim->table, result->table) != 0)
            continue;
        char title[RG_CLAIM_TITLE], fewer[48], text[RG_CLAIM_TITLE + 128];
        name_fewer_rows(claim, result, fewer, sizeof(fewer));
        rg_claim_title(claim, title);
        snprintf(text, sizeof(text), "%s (%s%s):", title, claim->where, fewer);
        const int length = verdicts_length(claim, result), width = rg_page_width(out);
        if (2 + (int)strlen(text) + 1 + length <= width)
            fprintf(out, "- %s ", text);
        else {
            rg_print_wrapped(out, "- ", text);
            fprintf(out, "  ");
        }
        print_verdicts(claim, result, rg_has_colours(out), 2 + length <= width ? "; " : ";\n  ",
                       out);
        fprintf(out, "\n");
        any = true;
    }
    if (any)
        fprintf(out, "\n");
}

// --- notes ---

// Prints text broken into lines, up to a limit.
struct notes {
    FILE *out;
    int lines;
    bool more; // something did not fit
};

static void print_line(struct notes *notes, const char *text, int length, bool is_first)
{
    if (notes->lines >= LINES - 1) {
        notes->more = true;
        return;
    }
    fprintf(notes->out, "%s%.*s\n", is_first ? "- " : "  ", length, text);
    notes->lines++;
}

static void add(struct notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(struct notes *notes, const char *format, ...)
{
    const int width = rg_page_width(notes->out);
    const int room = (width < RG_PAGE_WIDTH ? width : RG_PAGE_WIDTH) - 2;
    char text[2 * RG_NOTE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    const char *next;
    for (const char *line = text; *line; line = next) {
        const int length = rg_wrap(line, room, &next);
        print_line(notes, line, length, line == text);
    }
}

static void add_outcomes(struct notes *notes, const struct rg_result *result)
{
    const struct rg_record *first = NULL;
    int count = 0;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        if (record->outcome == RG_OK)
            continue;
        first = count++ ? first : record;
    }
    if (count)
        add(notes, "%d cells have no number; the first, on %s: %s", count, first->device.name,
            first->detail);
}

static void add_other_work(struct notes *notes, const struct rg_result *result)
{
    char rows[256] = "";
    size_t used = 0;
    const int work = rg_result_printed_work(result);
    for (int row = result->first_row; work >= 0 && row <= result->last_row; row++) {
        const struct rg_place at = {.row = row, .work = work};
        if (rg_result_has(result, row) && used < sizeof(rows) &&
            rg_record_is_other_work(rg_result_at(result, at), NULL))
            used += (size_t)snprintf(rows + used, sizeof(rows) - used, "%s%d", used ? ", " : "",
                                     row + 1);
    }
    if (*rows)
        add(notes,
            "Other work: rows %s draw 1.2 times the particles in print or more, or as few; "
            "no verdict is about them.",
            rows);
    if (*result->changed)
        add(notes, "All cells have %s%s.", result->changed,
            *result->hardware ? ": not what was printed" : "");
}

// Notes the parts that a time budget reduced, so that nobody takes the result for the full table.
static void add_budget(struct notes *notes, const struct rg_result *result)
{
    int rows = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        rows += rg_result_wants(result, row);
    if (result->budget_s > 0)
        add(notes, "Within a budget of %.0f s: %d of %d rows%s%s.", result->budget_s, rows,
            result->last_row - result->first_row + 1,
            result->size_divisor > 2   ? ", pictures of a fourth of the width and height"
            : result->size_divisor > 1 ? ", pictures of half the width and height"
                                       : "",
            result->size_divisor > 1 && *result->hardware ? ": not what was printed" : "");
}

static void add_method(struct notes *notes, const struct rg_result *result)
{
    if (rg_result_first_missing(result) <= result->last_row)
        add(notes, "Rows are missing from %d on: the run was interrupted.",
            rg_result_first_missing(result) + 1);
    if (result->is_of_textures)
        return;
    char medians_of[64], marks[RG_TITLE_SIZE], drift[48] = "";
    rg_result_medians_of(result, medians_of, sizeof(medians_of));
    if (rg_result_drift(result) > 0)
        snprintf(drift, sizeof(drift), " The machine drifted by %.1f %%.",
                 100 * rg_result_drift(result));
    rg_result_marks(result, marks, sizeof(marks));
    add(notes, "%s%s%sMedians of %s by wall clock, %s%s%s.%s%s%s",
        *result->hardware ? "In print on " : "", result->hardware, *result->hardware ? ". " : "",
        medians_of, result->full ? "full" : "quick", !result->full && *result->quick ? ": " : "",
        result->full ? "" : result->quick, drift, *marks ? " " : "", marks);
}

// Notes the growth of the first work of a table without a paper: "The time of a frame of work paper
// goes with drops to the power: cpu 0.98 (0.95 to 1.01), gl 1.02".
static void add_growth(struct notes *notes, const struct rg_result *result)
{
    char text[512] = "", power[32], low[32], high[32];
    size_t used = 0;
    const struct rg_named *axis = NULL;
    for (struct rg_place of = rg_result_start_row(result->first_row);
         rg_result_next_in_row(result, &of);) {
        const struct rg_trend trend = rg_trend_of(result, of);
        if (of.work || trend.verdict != RG_TREND_GROWTH || used >= sizeof(text))
            continue;
        axis = trend.axis;
        snprintf(power, sizeof(power), "%.2f", -trend.slope);
        snprintf(low, sizeof(low), "%.2f", -trend.slope_high);
        snprintf(high, sizeof(high), "%.2f", -trend.slope_low);
        const bool interval = isfinite(trend.slope_low);
        used += (size_t)snprintf(
            text + used, sizeof(text) - used, "%s%s%s%s %s%s%s%s%s%s", used ? ", " : "",
            result->variant_count > 1 ? result->variants[of.variant] : "",
            result->variant_count > 1 ? " on " : "", result->devices[of.device].name, power,
            interval ? " (" : "", interval ? low : "", interval ? " to " : "", interval ? high : "",
            interval ? ")" : "");
    }
    if (axis)
        add(notes, "The time of a frame%s%s goes with %s to the power: %s.",
            result->work_count > 1 ? " of work " : "",
            result->work_count > 1 ? result->works[0].name : "", axis->name, text);
}

void rg_brief_below(const struct rg_result *result, FILE *out)
{
    struct notes notes = {.out = out};
    print_claims(result, out);
    add_outcomes(&notes, result);
    add_other_work(&notes, result);
    add_budget(&notes, result);
    add_method(&notes, result);
    add_growth(&notes, result);
    add(&notes, "%s", result->note);
    if (notes.more)
        fprintf(out, "  ... (`raingauge table --wide`, csv and json have all of it)\n");
}
