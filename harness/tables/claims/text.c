#include "harness/tables/claims/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/console/colour.h"

// The marks of verdicts on the page; its notes explain them.
static const char *const marks[RG_CLAIM_VERDICTS] = {"yes", "no", "open", "other"};

void rg_claims_length(const struct rg_result *result, char *text, size_t size)
{
    const char *length = result->full ? "full" : "quick";
    const char *set = result->full ? "" : result->quick;
    int used = snprintf(text, size, "%s%s%s%s", length, *set ? " (" : "", set, *set ? ")" : "");
    if (result->size_divisor > 1 && used < (int)size)
        snprintf(text + used, size - (size_t)used, ", with 1/%d of the width and height",
                 result->size_divisor);
}

// Adds the result's own JSON description (docs/records.md), and its devices.
static bool add_table(struct rg_claim_outcomes *o, const struct rg_result *result)
{
    if (!o->tables && !(o->tables = json_array()))
        return rg_harness_error("claims: no memory");
    json_t *table = json_pack(
        "{ss ss so si sO?}", "table", result->table, "length", result->full ? "full" : "quick",
        "quick", *result->quick ? rg_json_text(result->quick) : json_null(), "size_divisor",
        result->size_divisor > 1 ? result->size_divisor : 1, "passport", result->passport);
    if (*result->changed)
        json_object_set_new(table, "changed", rg_json_text(result->changed));
    return !json_array_append_new(o->tables, table) || rg_harness_error("claims: no memory");
}

bool rg_claims_add(struct rg_claim_outcomes *o, const struct rg_result *result)
{
    const int before = o->count;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++) {
        for (int i = 0; i < result->device_count && !strcmp(claim->table, result->table); i++) {
            if (!rg_array_fit(&o->outcomes, &o->room, o->count + 1, sizeof(*o->outcomes), "claims"))
                return false;
            struct rg_claim_outcome *outcome = &o->outcomes[o->count++];
            outcome->claim = claim;
            memcpy(outcome->device, result->devices[i].name, RG_NAME_SIZE);
            rg_claims_length(result, outcome->length, sizeof(outcome->length));
            outcome->judgement = rg_claim_judge(claim, result, i);
        }
    }
    return o->count == before || add_table(o, result);
}

void rg_claims_free(struct rg_claim_outcomes *outcomes)
{
    free(outcomes->outcomes);
    json_decref(outcomes->tables);
    *outcomes = (struct rg_claim_outcomes){0};
}

// "reference" for "cpu:reference", because a page must fit a screen.
static const char *short_name(const char *device)
{
    return strcmp(device, "cpu:reference") ? device : "reference";
}

// The column of a device, which is added if it is missing.
static int column_of(struct rg_sheet *sheet, const char *device)
{
    for (int i = 0; i < sheet->column_count; i++)
        if (!strcmp(sheet->columns[i], device))
            return i;
    return rg_sheet_column(sheet, "%s", device);
}

static void add_columns(const struct rg_claim_outcomes *o, bool wide, struct rg_sheet *sheet)
{
    rg_sheet_column(sheet, "table");
    if (wide)
        rg_sheet_column(sheet, "section");
    rg_sheet_column(sheet, "claim");
    for (int i = 0; i < o->count; i++)
        column_of(sheet, wide ? o->outcomes[i].device : short_name(o->outcomes[i].device));
}

static void add_claim(const struct rg_claim *claim, bool wide, char (*cells)[RG_SHEET_CELL])
{
    char title[RG_CLAIM_TITLE];
    int column = 0;
    rg_claim_title(claim, title);
    snprintf(cells[column++], RG_SHEET_CELL, "%s", claim->table);
    if (wide)
        snprintf(cells[column++], RG_SHEET_CELL, "%s", claim->where);
    snprintf(cells[column], RG_SHEET_CELL, "%s", title);
}

static void add_rows(const struct rg_claim_outcomes *o, bool wide, struct rg_sheet *sheet)
{
    char(*cells)[RG_SHEET_CELL] = NULL;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        const enum rg_claim_verdict verdict = outcome->judgement.verdict;
        if (!i || outcome->claim != o->outcomes[i - 1].claim) {
            if (!(cells = rg_sheet_row(sheet)))
                return;
            add_claim(outcome->claim, wide, cells);
        }
        const char *device = wide ? outcome->device : short_name(outcome->device);
        snprintf(cells[column_of(sheet, device)], RG_SHEET_CELL, "%s",
                 wide ? rg_claim_verdict_text(verdict) : marks[verdict]);
    }
}

// Adds an explanation of the marks, and where to find the reasons.
static void add_legend(struct rg_sheet *sheet)
{
    rg_sheet_note(sheet, "%s: %s; %s: %s; %s: %s; %s: %s.", marks[RG_CLAIM_REPRODUCED],
                  rg_claim_verdict_text(RG_CLAIM_REPRODUCED), marks[RG_CLAIM_NOT_REPRODUCED],
                  rg_claim_verdict_text(RG_CLAIM_NOT_REPRODUCED), marks[RG_CLAIM_UNDECIDED],
                  rg_claim_verdict_text(RG_CLAIM_UNDECIDED), marks[RG_CLAIM_OTHER_WORK],
                  rg_claim_verdict_text(RG_CLAIM_OTHER_WORK));
    rg_sheet_note(sheet,
                  "`--wide` has the section of each claim, the reason of each verdict and the "
                  "probability behind it.");
}

// ", p 0.004": the p value behind a verdict; "" without one.
static void print_probability(const struct rg_judgement *j, char *text, size_t size)
{
    const double p = rg_claim_probability(j);
    *text = 0;
    if (isfinite(p) && p < 0.001)
        snprintf(text, size, ", p < 0.001");
    else if (isfinite(p))
        snprintf(text, size, ", p %.2g", p);
}

static bool end_alike(const struct rg_claim_outcome *a, const struct rg_claim_outcome *b)
{
    return a->claim == b->claim && a->judgement.verdict == b->judgement.verdict &&
           !strcmp(a->judgement.why, b->judgement.why);
}

// The devices with the same verdict and reason, from one on: "gl, vulkan"; "" if an earlier one had
// it.
static void name_alike(const struct rg_claim_outcomes *o, int from, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < o->count; i++) {
        if (!end_alike(&o->outcomes[i], &o->outcomes[from]))
            continue;
        if (i < from)
            return;
        if (used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     o->outcomes[i].device);
    }
}

// The tables judged at one length, from an outcome on: "feng-1, feng-2"; "" if that length was
// listed before.
static void name_tables(const struct rg_claim_outcomes *o, int from, char *text, size_t size)
{
    size_t used = 0;
    const char *last = "";
    *text = 0;
    for (int i = 0; i < o->count; i++) {
        const char *table = o->outcomes[i].claim->table;
        if (strcmp(o->outcomes[i].length, o->outcomes[from].length) != 0)
            continue;
        if (i < from)
            return;
        if (strcmp(table, last) != 0 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", table);
        last = table;
    }
}

static void add_lengths(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    for (int i = 0; i < o->count; i++) {
        char tables[512];
        name_tables(o, i, tables, sizeof(tables));
        if (*tables)
            rg_sheet_note(sheet, "Measured %s: %s.", o->outcomes[i].length, tables);
    }
}

// Lists claims that were judged by only some of their rows.
static void add_fewer_rows(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    const struct rg_claim *told = NULL;
    char text[1024] = "";
    size_t used = 0;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim *claim = o->outcomes[i].claim;
        const struct rg_judgement *j = &o->outcomes[i].judgement;
        if (claim == told || j->verdict >= RG_CLAIM_UNDECIDED || j->rows == j->rows_needed ||
            used >= sizeof(text))
            continue;
        char title[RG_CLAIM_TITLE];
        rg_claim_title(claim, title);
        used += (size_t)snprintf(text + used, sizeof(text) - used, "%s%s, %s, by %d of %d",
                                 used ? "; " : "", claim->table, title, j->rows, j->rows_needed);
        told = claim;
    }
    if (*text)
        rg_sheet_note(sheet, "Judged by some of the rows: %s.", text);
}

static void add_contradictions(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    char text[1024] = "";
    size_t used = 0;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim *claim = o->outcomes[i].claim;
        const bool is_told = i && o->outcomes[i - 1].claim == claim;
        if (is_told || !o->outcomes[i].judgement.print_contradicts || used >= sizeof(text))
            continue;
        char title[RG_CLAIM_TITLE];
        rg_claim_title(claim, title);
        used += (size_t)snprintf(text + used, sizeof(text) - used, "%s%s, %s", used ? "; " : "",
                                 claim->table, title);
    }
    if (*text)
        rg_sheet_note(sheet, "The paper's own table contradicts: %s.", text);
}

static void add_reasons(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        const struct rg_claim *claim = outcome->claim;
        const struct rg_judgement *j = &outcome->judgement;
        char p[32], devices[256], title[RG_CLAIM_TITLE];
        rg_claim_title(claim, title);
        print_probability(j, p, sizeof(p));
        name_alike(o, i, devices, sizeof(devices));
        if (*devices)
            rg_sheet_note(sheet, "%s, %s, %s on %s%s: %s.", claim->table, title,
                          rg_claim_verdict_text(j->verdict), devices, p, j->why);
    }
}

// The terminal's colour of a verdict.
static const char *paint(const char *cell)
{
    static const char *const colours[RG_CLAIM_VERDICTS] = {RG_GREEN, RG_RED, RG_YELLOW, RG_YELLOW};
    for (int i = 0; i < RG_CLAIM_VERDICTS; i++)
        if (!strcmp(cell, marks[i]) ||
            !strcmp(cell, rg_claim_verdict_text((enum rg_claim_verdict)i)))
            return colours[i];
    return NULL;
}

void rg_claims_sheet(const struct rg_claim_outcomes *outcomes, bool wide, struct rg_sheet *sheet)
{
    sheet->title = "claims";
    sheet->width_step = wide ? 0 : 1;
    sheet->note_width = wide ? 0 : RG_PAGE_WIDTH;
    sheet->paint = rg_has_colours(stdout) ? paint : NULL;
    add_columns(outcomes, wide, sheet);
    add_rows(outcomes, wide, sheet);
    if (!wide)
        add_legend(sheet);
    add_lengths(outcomes, sheet);
    add_fewer_rows(outcomes, sheet);
    if (wide)
        add_reasons(outcomes, sheet);
    add_contradictions(outcomes, sheet);
}
