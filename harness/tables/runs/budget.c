#include "harness/tables/runs/budget.h"

#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/tables/runs/needed.h"

static double passed_s(const struct rg_budget *b)
{
    return (rg_now_ms() - b->start_ms) / 1000;
}

// --- telling ---

// The rows of a table that are chosen.
static void choose_rows(const struct rg_budget *b, int i, bool rows[RG_TABLE_ROWS])
{
    if (b->choices[i].all_rows)
        rg_quick_rows(b->tables[i], rows);
    else
        rg_needed_rows(b->tables[i], rows);
}

static int divisor_of(const struct rg_budget_choice *choice)
{
    return 4 >> choice->size;
}

// "1, 4, 8-10": rows that are measured, or that are not.
static void name_rows(const struct rg_budget *b, int i, bool left_out, char *text, size_t size)
{
    bool chosen[RG_TABLE_ROWS];
    size_t used = 0;
    int from = -1;
    const int rows = b->tables[i]->row_count;
    choose_rows(b, i, chosen);
    *text = 0;
    for (int row = 0; row <= rows; row++) {
        const bool in = row < rows && chosen[row] != left_out;
        if (in && from < 0)
            from = row;
        if (in || from < 0)
            continue;
        if (used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%d", used ? ", " : "", from + 1);
        if (row - from > 1 && used < size)
            used += (size_t)snprintf(text + used, size - used, "-%d", row);
        from = -1;
    }
}

static void name_devices(const struct rg_budget *b, unsigned devices, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int d = 0; d < b->devices->count; d++)
        if (devices >> d & 1 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     b->devices->devices[d]->info.name);
}

// What is needed of a table would take so long.
static double needed_s(const struct rg_budget *b, int i)
{
    const struct rg_budget_choice needed = {.devices = b->all & ~b->last,
                                            .size = b->costs[i].smallest};
    return rg_budget_expect(&b->costs[i], &needed);
}

static void print_table(const struct rg_budget *b, int i, FILE *out)
{
    const struct rg_table *table = b->tables[i];
    const struct rg_budget_choice *c = &b->choices[i];
    char rows[256], devices[256];
    name_rows(b, i, false, rows, sizeof(rows));
    name_devices(b, c->devices, devices, sizeof(devices));
    if (!c->devices) {
        fprintf(out, "  %-16s left out; what is needed of it would take %.0f s\n", table->id,
                needed_s(b, i));
        return;
    }
    const int divisor = divisor_of(c);
    fprintf(out, "  %-16s %5.1f s  rows %s%s%s", table->id, c->expected_s, rows,
            c->all_works && b->costs[i].works > 1 ? ", all works" : "",
            c->all_variants && b->costs[i].variants > b->costs[i].needed_variants ? ", all variants"
                                                                                  : "");
    if (!table->is_of_textures)
        fprintf(out, ", %dx%d, %s samples", table->width / divisor, table->height / divisor,
                c->all_samples ? "quick" : "6");
    fprintf(out, ", on %s\n", devices);
}

static void print_plan(const struct rg_budget *b, FILE *out)
{
    double all_s = b->probed_s;
    for (int i = 0; i < b->count; i++)
        all_s += needed_s(b, i);
    fprintf(out,
            "plan: %.0f s, with %.0f s that this plan took; the budget is %.0f s, and what curves "
            "and claims need would take %.0f s\n",
            b->probed_s + b->planned_s, b->probed_s, b->seconds, all_s);
    for (int i = 0; i < b->count; i++)
        print_table(b, i, out);
    fflush(out);
}

// What of a table is not measured; false where it is whole.
static bool print_left_out(const struct rg_budget *b, int i, FILE *out)
{
    const struct rg_budget_table *costs = &b->costs[i];
    const struct rg_budget_choice *c = &b->choices[i];
    char rows[256], devices[256];
    if (!c->devices) {
        fprintf(out, "  %-16s all of it\n", b->tables[i]->id);
        return true;
    }
    name_rows(b, i, true, rows, sizeof(rows));
    name_devices(b, b->all & ~c->devices, devices, sizeof(devices));
    char text[768];
    const int length =
        snprintf(text, sizeof(text), "%s%s%s%s%s%s%s%s", *rows ? "; rows " : "", rows,
                 !c->all_works && costs->works > 1 ? "; works but what was printed" : "",
                 !c->all_variants && costs->variants > costs->needed_variants
                     ? "; variants that no claim is about"
                     : "",
                 c->size < RG_BUDGET_WHOLE ? "; whole pictures" : "",
                 c->all_samples || b->tables[i]->is_of_textures ? "" : "; more than 6 samples",
                 *devices ? "; " : "", devices);
    if (length > 2)
        fprintf(out, "  %-16s %s\n", b->tables[i]->id, text + 2);
    return length > 2;
}

void rg_budget_end(const struct rg_budget *b, FILE *out)
{
    const double taken_s = passed_s(b), planned_s = b->probed_s + b->planned_s;
    fprintf(out, "took %.0f s, planned %.0f s (%+.0f %%), of a budget of %.0f s; left out:\n",
            taken_s, planned_s, 100 * (taken_s / planned_s - 1), b->seconds);
    bool any = false;
    for (int i = 0; i < b->count; i++)
        any = print_left_out(b, i, out) || any;
    if (!any)
        fprintf(out, "  nothing\n");
}

// --- planning ---

// The first table of the same technique, and of the same kind of size.
static int kind_of(const struct rg_table *const tables[], int i)
{
    for (int k = 0; k < i; k++)
        if (!strcmp(tables[k]->technique, tables[i]->technique) &&
            tables[k]->width == tables[i]->width && !tables[k]->is_of_textures)
            return k;
    return i;
}

// Of the budget, as much as looking at more than one table of a technique may take.
#define MOST_PROBING 0.25

// Looks at the first table of each technique, or at the others, as long as there is time for it.
static void probe_tables(struct rg_budget *b, struct rg_kept *kept, bool first_ones, FILE *out)
{
    for (int i = 0; i < b->count && !rg_interrupted(); i++) {
        const int kind = kind_of(b->tables, i);
        if ((kind == i) != first_ones)
            continue;
        if (kind != i && passed_s(b) > MOST_PROBING * b->seconds) {
            rg_budget_alike(b->tables[i], &b->costs[kind], &b->costs[i]);
            continue;
        }
        fprintf(out, "planning: %s\n", b->tables[i]->id);
        fflush(out);
        rg_budget_probe(b->tables[i], kept, &b->kinds[kind], &b->costs[i]);
    }
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
    for (int d = 0; d < kept->devices->count; d++) {
        b->all |= 1u << d;
        if (!strcmp(kept->devices->devices[d]->info.name, "cpu:reference"))
            b->last |= 1u << d;
    }
    // The one device that is given is measured, whichever it is.
    b->last = b->last == b->all ? 0 : b->last;
    probe_tables(b, kept, true, out);
    probe_tables(b, kept, false, out);
    if (rg_interrupted())
        return true;
    b->probed_s = passed_s(b);
    b->planned_s =
        rg_budget_plan(b->costs, count, b->all, b->last, seconds - b->probed_s, b->choices);
    print_plan(b, out);
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

// Plans a table and those that follow anew where they would not be done in time.
static void plan_again(struct rg_budget *b, int from, FILE *out)
{
    const struct rg_budget_choice before = b->choices[from];
    const double slow = slowness(b), left_s = (b->seconds - passed_s(b)) / slow;
    double due_s = 0;
    for (int i = from; i < b->count; i++)
        due_s += b->choices[i].expected_s;
    if (due_s <= left_s)
        return;
    rg_budget_plan(b->costs + from, b->count - from, b->all, b->last, left_s, b->choices + from);
    if (!is_same_choice(&before, &b->choices[from])) {
        fprintf(out, "planned anew, as cells take %.2f times as long as they were to:\n", slow);
        print_table(b, from, out);
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
    choose_rows(b, i, chosen);
    for (int row = 0; row < b->tables[i]->row_count; row++)
        result->left_out[row] = !chosen[row];
}

bool rg_budget_next(struct rg_budget *b, int i, struct rg_result *result, FILE *out)
{
    plan_again(b, i, out);
    const struct rg_budget_choice *c = &b->choices[i];
    if (!c->devices)
        return false;
    const struct rg_table_part part = {.last_row = b->tables[i]->row_count - 1};
    b->table = *b->tables[i];
    b->table.width /= divisor_of(c);
    b->table.height /= divisor_of(c);
    if (!c->all_works && b->table.works[0].name)
        b->table.works[1].name = NULL;
    choose_variants(b, i);
    choose_devices(b, i);
    rg_table_begin(result, &b->table, &part, &b->chosen);
    leave_out_rows(b, i, result);
    result->budget_s = b->seconds;
    result->budget_end_ms = b->start_ms + 1000 * b->seconds;
    result->size_divisor = divisor_of(c);
    result->few_samples = !c->all_samples;
    return true;
}

void rg_budget_done(struct rg_budget *b, int i, const struct rg_result *result, double start_ms)
{
    int wanted = 0, had = 0;
    bool chosen[RG_TABLE_ROWS];
    choose_rows(b, i, chosen);
    for (int row = 0; row < b->tables[i]->row_count; row++) {
        wanted += chosen[row];
        had += rg_result_has(result, row);
    }
    // Textures are expected to take nothing, which tells nothing of the others.
    if (!(b->choices[i].expected_s > 0))
        return;
    b->due_s += b->choices[i].expected_s * had / fmax(wanted, 1);
    b->taken_s += (rg_now_ms() - start_ms) / 1000;
}
