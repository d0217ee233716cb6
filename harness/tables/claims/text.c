#include "harness/tables/claims/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/console/terminal.h"

// The marks of verdicts on the page; its notes explain them. Figures of one launch are no verdict
// and stand in brackets.
static const char *const marks[RG_CLAIM_VERDICTS] = {"yes",   "no",     "bound", "open",
                                                     "other", "unseen", ""};
static const char *const figure_marks[RG_FIGURES_COUNT] = {"(yes)", "(no)", "(near)", "unseen"};
static const char *mark_of(const struct rg_judgement *j, bool wide)
{
    if (wide)
        return rg_judgement_text(j);
    return j->verdict == RG_CLAIM_ONE_LAUNCH ? figure_marks[j->figures] : marks[j->verdict];
}

const char *rg_claim_agreement_text(enum rg_claim_agreement agreement)
{
    static const char *const texts[] = {"", "agrees", "differs", "not seen"};
    return texts[agreement];
}

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

// --- verdicts that are kept ---

// Figures near the bound agree with every verdict.
static enum rg_claim_agreement agreement_of(enum rg_claim_verdict kept, enum rg_claim_figures today)
{
    const enum rg_claim_figures due = kept == RG_CLAIM_REPRODUCED       ? RG_FIGURES_FIT
                                      : kept == RG_CLAIM_NOT_REPRODUCED ? RG_FIGURES_MISS
                                                                        : RG_FIGURES_NEAR;
    if (!rg_claim_is_decided(kept))
        return RG_AGREEMENT_NONE;
    if (today == RG_FIGURES_NONE)
        return RG_AGREEMENT_NOT_SEEN;
    return today == due || today == RG_FIGURES_NEAR ? RG_AGREEMENT_AGREES : RG_AGREEMENT_DIFFERS;
}

// The processor's name, from the passport of the launches.
static void take_machine(const struct rg_result *result, char machine[RG_TITLE_SIZE])
{
    const json_t *cpu = json_object_get(json_object_get(result->passport, "machine"), "cpu");
    const char *name = json_string_value(cpu);
    rg_text_copy(machine, RG_TITLE_SIZE, name ? name : "");
}

// Takes the verdict of the kept records on the same device, if they have one by launches.
static void take_kept(struct rg_claim_outcome *outcome, const struct rg_stored *kept)
{
    for (int i = 0; kept && i < kept->count; i++) {
        const struct rg_result *result = &kept->results[i];
        for (int d = 0; d < result->device_count; d++) {
            if (strcmp(result->table, outcome->claim->table) != 0 ||
                strcmp(result->devices[d].name, outcome->device) != 0)
                continue;
            const struct rg_judgement j = rg_claim_judge(outcome->claim, result, d);
            if (j.verdict == RG_CLAIM_ONE_LAUNCH || j.verdict == RG_CLAIM_NOT_SEEN)
                continue;
            outcome->agreement = agreement_of(j.verdict, outcome->judgement.figures);
            outcome->judgement = j;
            outcome->is_kept = true;
            take_machine(result, outcome->machine);
            rg_claims_length(result, outcome->length, sizeof(outcome->length));
        }
    }
}

static bool is_shown(const struct rg_claim *claim, const struct rg_claims_shown *shown)
{
    const int low = claim->first < claim->last ? claim->first : claim->last;
    const int high = claim->first < claim->last ? claim->last : claim->first;
    const bool is_variant = !shown->variant || !strcmp(claim->variant, shown->variant) ||
                            (claim->other && !strcmp(claim->other, shown->variant));
    return is_variant &&
           (!shown->first_row || (low <= shown->last_row && high >= shown->first_row));
}

static bool add_outcome(struct rg_claim_outcomes *o, const struct rg_claim *claim,
                        const struct rg_result *result, int device, const struct rg_stored *kept)
{
    if (!rg_array_fit(&o->outcomes, &o->room, o->count + 1, sizeof(*o->outcomes), "claims"))
        return false;
    struct rg_claim_outcome *outcome = &o->outcomes[o->count++];
    *outcome = (struct rg_claim_outcome){.claim = claim,
                                         .judgement = rg_claim_judge(claim, result, device)};
    memcpy(outcome->device, result->devices[device].name, RG_NAME_SIZE);
    rg_claims_length(result, outcome->length, sizeof(outcome->length));
    take_machine(result, outcome->machine);
    if (!outcome->judgement.launches)
        take_kept(outcome, kept);
    return true;
}

bool rg_claims_add(struct rg_claim_outcomes *o, const struct rg_result *result,
                   const struct rg_stored *kept, const struct rg_claims_shown *shown)
{
    const int before = o->count;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        for (int i = 0; i < result->device_count && !strcmp(claim->table, result->table); i++)
            if (is_shown(claim, shown) && !add_outcome(o, claim, result, i, kept))
                return false;
    return o->count == before || add_table(o, result);
}

void rg_claims_free(struct rg_claim_outcomes *outcomes)
{
    free(outcomes->outcomes);
    json_decref(outcomes->tables);
    *outcomes = (struct rg_claim_outcomes){0};
}

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
        if (!i || outcome->claim != o->outcomes[i - 1].claim) {
            if (!(cells = rg_sheet_row(sheet)))
                return;
            add_claim(outcome->claim, wide, cells);
        }
        const char *device = wide ? outcome->device : short_name(outcome->device);
        snprintf(cells[column_of(sheet, device)], RG_SHEET_CELL, "%s",
                 mark_of(&outcome->judgement, wide));
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
            used += (size_t)snprintf(text + used, sizeof(text) - used, "%s: %s; ", marks[v],
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
        char devices[256], title[RG_CLAIM_TITLE];
        rg_claim_title(claim, title);
        name_alike(o, i, devices, sizeof(devices));
        if (*devices)
            rg_sheet_note(sheet, "%s, %s, %s on %s: %s.", claim->table, title, mark_of(j, true),
                          devices, j->why);
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
        char title[RG_CLAIM_TITLE];
        rg_claim_title(outcome->claim, title);
        if (outcome->agreement == RG_AGREEMENT_DIFFERS)
            rg_sheet_note(sheet, "Today differs: %s, %s on %s.", outcome->claim->table, title,
                          outcome->device);
    }
}

// The terminal's colour of a verdict.
static const char *paint(const char *cell)
{
    static const char *const colours[] = {RG_GREEN, RG_RED, RG_YELLOW, RG_YELLOW, RG_YELLOW};
    for (int i = 0; i <= RG_CLAIM_OTHER_WORK; i++)
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
    rg_claims_total(outcomes, sheet);
    add_columns(outcomes, wide, sheet);
    add_rows(outcomes, wide, sheet);
    if (!wide)
        add_legend(outcomes, sheet);
    add_agreements(outcomes, sheet);
    add_lengths(outcomes, sheet);
    add_fewer_rows(outcomes, sheet);
    if (wide)
        add_reasons(outcomes, sheet);
    add_contradictions(outcomes, sheet);
}
