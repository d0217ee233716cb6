#include "harness/tables/runs/budget.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/tell.h"

static double passed_s(const struct rg_budget *b)
{
    return (rg_now_ms() - b->start_ms) / 1000;
}

// --- planning ---

// Of the budget, as much as looking at more than one table of a technique may take.
#define MOST_PROBING 0.25

// Looks at the first table of each technique, or at the others, as long as there is time for it.
static void probe_tables(struct rg_budget *b, struct rg_kept *kept, bool first_ones)
{
    for (int i = 0; i < b->count && !rg_interrupted(); i++) {
        const int kind = rg_budget_kind_of(b->tables, i);
        if ((kind == i) != first_ones)
            continue;
        if (kind != i && passed_s(b) > MOST_PROBING * b->seconds) {
            rg_budget_alike(b->tables[i], &b->costs[kind], &b->costs[i]);
            continue;
        }
        rg_info("planning: %s", b->tables[i]->id);
        rg_budget_probe(b->tables[i], kept, false, &b->kinds[kind], &b->costs[i]);
    }
}

// Of the devices that are given: cpu comes first, and cpu:reference last, unless it is alone.
static void name_bits(struct rg_budget *b)
{
    struct rg_budget_devices *bits = &b->bits;
    for (int d = 0; d < b->devices->count; d++) {
        const char *name = b->devices->devices[d]->info.name;
        bits->all |= 1u << d;
        bits->first |= !strcmp(name, "cpu") ? 1u << d : 0;
        bits->last |= !strcmp(name, "cpu:reference") ? 1u << d : 0;
    }
    bits->last = bits->last == bits->all ? 0 : bits->last;
    const unsigned others = bits->all & ~bits->last;
    bits->first = bits->first ? bits->first : others & (~others + 1);
}

bool rg_budget_begin(struct rg_budget *b, const struct rg_table *const tables[], int count,
                     struct rg_kept *kept, double seconds, FILE *out)
{
    *b = (struct rg_budget){.tables = tables,
                            .count = count,
                            .devices = kept->devices,
                            .seconds = seconds,
                            .start_ms = rg_now_ms()};
    if (count > RG_BUDGET_TABLES)
        return rg_error("--budget: %d tables are more than %d; name fewer", count,
                        RG_BUDGET_TABLES);
    name_bits(b);
    probe_tables(b, kept, true);
    probe_tables(b, kept, false);
    if (rg_interrupted())
        return true;
    b->probed_s = passed_s(b);
    b->planned_s = rg_budget_plan(b->costs, count, &b->bits, seconds - b->probed_s, b->choices);
    bool any = false;
    for (int i = 0; i < count; i++)
        any = any || b->choices[i].devices;
    if (any)
        rg_budget_tell(b, out);
    return true;
}

// How much longer cells take than they were to. Of little that is done nothing is concluded.
static double slowness(const struct rg_budget *b)
{
    return b->due_s > 0.05 * b->seconds ? fmin(fmax(b->taken_s / b->due_s, 0.5), 4) : 1;
}

static bool is_same_choice(const struct rg_budget_choice *a, const struct rg_budget_choice *b)
{
    return a->devices == b->devices && a->size == b->size && a->all_samples == b->all_samples &&
           a->all_rows == b->all_rows && a->all_variants == b->all_variants &&
           a->all_works == b->all_works;
}

// Of the budget, more than this is worth another plan, and of what is left so much stays for cells
// that take longer again.
#define MORE  0.05
#define STAYS 0.2

// Plans a table and those that follow anew where they would not be done in time, or where those
// before took less than they were to, so that there is time for more of these.
static void plan_again(struct rg_budget *b, int from, FILE *out)
{
    const int count = b->count - from;
    const double slow = slowness(b), left_s = (b->seconds - passed_s(b)) / slow;
    struct rg_budget_choice again[RG_BUDGET_TABLES];
    char why[64];
    double due_s = 0;
    for (int i = from; i < b->count; i++)
        due_s += b->choices[i].expected_s;
    const bool is_late = due_s > left_s;
    const double again_s = rg_budget_plan(b->costs + from, count, &b->bits,
                                          is_late ? left_s : (1 - STAYS) * left_s, again);
    if (!is_late && again_s <= due_s + MORE * b->seconds)
        return;
    if (!is_late)
        snprintf(why, sizeof(why), "there is time for more");
    else if (slow > 1)
        snprintf(why, sizeof(why), "cells take %.2f times as long as they were to", slow);
    else
        snprintf(why, sizeof(why), "less time is left than the rest was to take");
    for (int i = from, told = 0; i < b->count; i++) {
        const bool is_same = is_same_choice(&b->choices[i], &again[i - from]);
        b->choices[i] = again[i - from];
        if (is_same)
            continue;
        if (!told++)
            fprintf(out, "planned anew, as %s:\n", why);
        rg_budget_tell_table(b, i, out);
    }
}

// --- a table as it is chosen ---

static void choose_variants(struct rg_budget *b, int i)
{
    bool needed[RG_TABLE_VARIANTS];
    int kept = 0;
    rg_needed_variants(b->tables[i], needed);
    for (int v = 0; v < RG_TABLE_VARIANTS && b->tables[i]->variants[v].name; v++)
        if (needed[v] || b->choices[i].all_variants)
            b->table.variants[kept++] = b->tables[i]->variants[v];
    b->table.variants[kept].name = NULL;
}

static void choose_devices(struct rg_budget *b, int i)
{
    b->chosen = *b->devices;
    b->chosen.count = 0;
    for (int d = 0; d < b->devices->count; d++)
        if (b->choices[i].devices >> d & 1)
            b->chosen.devices[b->chosen.count++] = b->devices->devices[d];
}

static void leave_out_rows(const struct rg_budget *b, int i, struct rg_result *result)
{
    bool chosen[RG_TABLE_ROWS];
    rg_budget_rows(b, i, chosen);
    for (int row = 0; row < b->tables[i]->row_count; row++)
        result->left_out[row] = !chosen[row];
}

// What the least of the tables behind one takes, which it must leave to them.
static double least_behind_s(const struct rg_budget *b, int table)
{
    double s = 0;
    for (int i = table + 1; i < b->count; i++)
        if (b->choices[i].devices)
            s += fmin(rg_budget_least_s(b, i), b->choices[i].expected_s);
    return s * slowness(b);
}

bool rg_budget_next(struct rg_budget *b, int i, struct rg_result *result, FILE *out)
{
    plan_again(b, i, out);
    const struct rg_budget_choice *c = &b->choices[i];
    free(b->quick);
    b->quick = rg_table_quick(b->tables[i], rg_budget_divisor(c));
    if (!c->devices || !b->quick)
        return false;
    const struct rg_table_part part = {.last_row = b->tables[i]->row_count - 1};
    b->table = *b->tables[i];
    b->table.width /= rg_budget_divisor(c);
    b->table.height /= rg_budget_divisor(c);
    b->table.quick = b->quick;
    if (!rg_budget_has_truth(b->tables[i], c->size))
        b->table.truth = NULL;
    if (!c->all_works && b->table.works[0].name)
        b->table.works[1].name = NULL;
    choose_variants(b, i);
    choose_devices(b, i);
    rg_table_begin(result, &b->table, &part, &b->chosen);
    leave_out_rows(b, i, result);
    result->budget_s = b->seconds;
    result->budget_end_ms = b->start_ms + 1000 * (b->seconds - least_behind_s(b, i));
    result->size_divisor = rg_budget_divisor(c);
    result->few_samples = !c->all_samples;
    return true;
}

void rg_budget_done(struct rg_budget *b, int i, const struct rg_result *result, double start_ms)
{
    int wanted = 0, had = 0;
    bool chosen[RG_TABLE_ROWS];
    rg_budget_rows(b, i, chosen);
    for (int row = 0; row < b->tables[i]->row_count; row++) {
        wanted += chosen[row];
        had += rg_result_has(result, row);
    }
    b->measured += had > 0;
    // Textures are expected to take nothing, where what holds them is open: that tells nothing of
    // the others.
    if (b->tables[i]->is_of_textures)
        return;
    b->due_s += b->choices[i].expected_s * had / fmax(wanted, 1);
    b->taken_s += (rg_now_ms() - start_ms) / 1000;
}

// The table of which the least takes least.
static int cheapest(const struct rg_budget *b)
{
    int least = 0;
    for (int i = 1; i < b->count; i++)
        if (rg_budget_least_s(b, i) < rg_budget_least_s(b, least))
            least = i;
    return least;
}

bool rg_budget_end(const struct rg_budget *b, FILE *out)
{
    const int least = cheapest(b);
    if (!b->measured)
        return rg_error("--budget: nothing was measured within %g s, of which planning took %.1f "
                        "s; %s would take %.1f s more: give more time, or name fewer tables",
                        b->seconds, b->probed_s, b->tables[least]->id, rg_budget_least_s(b, least));
    rg_budget_tell_end(b, passed_s(b), out);
    return true;
}
