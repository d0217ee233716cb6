#include "harness/tables/claims/text.h"

#include <stdio.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/console/terminal.h"

// "ref" for "cpu:reference", because a page must fit a screen.
static const char *short_name(const char *device)
{
    return strcmp(device, "cpu:reference") ? device : "ref";
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
    if (rg_claims_are_of_several(o))
        rg_sheet_column(sheet, "on");
    for (int i = 0; i < o->count; i++)
        column_of(sheet, wide ? o->outcomes[i].device : short_name(o->outcomes[i].device));
}

// Begins the row of a claim on a machine, which has a name if there are several.
static void begin_row(const struct rg_claim_outcome *outcome, bool wide, bool has_name,
                      char (*cells)[RG_SHEET_CELL])
{
    const struct rg_claim *claim = outcome->claim;
    char title[RG_CLAIM_TITLE];
    int column = 0;
    rg_claim_title(claim, title);
    snprintf(cells[column++], RG_SHEET_CELL, "%s", claim->table);
    if (wide)
        snprintf(cells[column++], RG_SHEET_CELL, "%s", claim->where);
    snprintf(cells[column++], RG_SHEET_CELL, "%s", title);
    if (has_name)
        rg_origin_name(outcome->origin, cells[column]);
}

static void add_rows(const struct rg_claim_outcomes *o, bool wide, struct rg_sheet *sheet)
{
    char(*cells)[RG_SHEET_CELL] = NULL;
    const bool has_names = rg_claims_are_of_several(o);
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        if (!i || outcome->claim != outcome[-1].claim || outcome->origin != outcome[-1].origin) {
            if (!(cells = rg_sheet_row(sheet)))
                return;
            begin_row(outcome, wide, has_names, cells);
        }
        const char *device = wide ? outcome->device : short_name(outcome->device);
        snprintf(cells[column_of(sheet, device)], RG_SHEET_CELL, "%s",
                 rg_claim_mark(&outcome->judgement, wide));
    }
}

// Explains the page's marks, and says where the reasons are.
static void add_legend(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    bool has[RG_CLAIM_VERDICTS] = {false};
    char text[512] = "";
    size_t used = 0;
    for (int i = 0; i < o->count; i++)
        has[o->outcomes[i].judgement.verdict] = true;
    for (int v = 0; v < RG_CLAIM_ONE_LAUNCH; v++)
        if (has[v])
            used += (size_t)snprintf(text + used, sizeof(text) - used, "%s: %s; ",
                                     rg_claim_verdict_mark((enum rg_claim_verdict)v),
                                     rg_claim_verdict_text((enum rg_claim_verdict)v));
    if (has[RG_CLAIM_ONE_LAUNCH])
        used += (size_t)snprintf(text + used, sizeof(text) - used, "in (): one launch; ");
    snprintf(text + used, sizeof(text) - used, "why: `--wide`.");
    rg_sheet_note(sheet, "%s", text);
}

static bool end_alike(const struct rg_claim_outcome *a, const struct rg_claim_outcome *b)
{
    return a->claim == b->claim && a->judgement.verdict == b->judgement.verdict &&
           !strcmp(a->judgement.why, b->judgement.why);
}

// The devices with the same verdict and reason, from one on: "gl, vulkan", "gl of A, gl of B"; ""
// if an earlier one had it.
static void name_alike(const struct rg_claim_outcomes *o, int from, char *text, size_t size)
{
    char place[RG_CLAIM_PLACE];
    *text = 0;
    for (int i = 0; i < o->count; i++) {
        if (!end_alike(&o->outcomes[i], &o->outcomes[from]))
            continue;
        if (i < from)
            return;
        rg_claim_place(o, &o->outcomes[i], place);
        rg_text_add(text, size, ", ", "%s", place);
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
            rg_sheet_note(sheet, "%s: %s.", o->outcomes[i].length, tables);
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
        if (claim == told || !rg_claim_is_decided(j->verdict) || j->rows == j->rows_needed ||
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
        char devices[1024], title[RG_CLAIM_TITLE];
        rg_claim_title(claim, title);
        name_alike(o, i, devices, sizeof(devices));
        if (*devices)
            rg_sheet_note(sheet, "%s, %s, %s on %s: %s.", claim->table, title,
                          rg_claim_mark(j, true), devices, j->why);
    }
}

// Lists today's figures that differ from kept verdicts, and counts the others.
static void add_agreements(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    int counts[RG_AGREEMENT_NOT_SEEN + 1] = {0}, kept = -1;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        counts[outcome->agreement]++;
        kept = outcome->is_kept ? i : kept;
    }
    if (kept < 0)
        return;
    rg_sheet_note(sheet,
                  "Verdicts are of kept records, from %s. Today's figures of one launch agree with "
                  "%d of them and differ from %d; %d are not seen today.",
                  o->outcomes[kept].machine, counts[RG_AGREEMENT_AGREES],
                  counts[RG_AGREEMENT_DIFFERS], counts[RG_AGREEMENT_NOT_SEEN]);
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        char title[RG_CLAIM_TITLE], place[RG_CLAIM_PLACE];
        rg_claim_title(outcome->claim, title);
        rg_claim_place(o, outcome, place);
        if (outcome->agreement == RG_AGREEMENT_DIFFERS)
            rg_sheet_note(sheet, "Today differs: %s, %s on %s.", outcome->claim->table, title,
                          place);
    }
}

// The terminal's colour of a verdict.
static const char *paint(const char *cell)
{
    static const char *const colours[] = {RG_GREEN, RG_RED, RG_YELLOW, RG_YELLOW, RG_YELLOW};
    for (int i = 0; i <= RG_CLAIM_OTHER_WORK; i++)
        if (!strcmp(cell, rg_claim_verdict_mark((enum rg_claim_verdict)i)) ||
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
    rg_claims_total(outcomes, sheet);
    add_columns(outcomes, wide, sheet);
    add_rows(outcomes, wide, sheet);
    if (!wide)
        add_legend(outcomes, sheet);
    rg_claims_compare(outcomes, sheet);
    add_agreements(outcomes, sheet);
    add_lengths(outcomes, sheet);
    add_fewer_rows(outcomes, sheet);
    if (wide)
        add_reasons(outcomes, sheet);
    add_contradictions(outcomes, sheet);
}
