#include "harness/tables/runs/tell.h"

#include "harness/tables/runs/needed.h"

void rg_budget_rows(const struct rg_budget *b, int i, bool rows[RG_TABLE_ROWS])
{
    if (b->choices[i].all_rows)
        rg_quick_rows(b->tables[i], rows);
    else
        rg_needed_rows(b->tables[i], rows);
}

int rg_budget_divisor(const struct rg_budget_choice *choice)
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
    rg_budget_rows(b, i, chosen);
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
    const struct rg_budget_choice needed = {.devices = b->bits.all & ~b->bits.last,
                                            .size = b->costs[i].smallest};
    return rg_budget_expect(&b->costs[i], &needed);
}

double rg_budget_least_s(const struct rg_budget *b, int i)
{
    const struct rg_budget_choice least = {.devices = b->bits.first, .size = b->costs[i].smallest};
    return rg_budget_expect(&b->costs[i], &least);
}

void rg_budget_tell_table(const struct rg_budget *b, int i, FILE *out)
{
    const struct rg_table *table = b->tables[i];
    const struct rg_budget_choice *c = &b->choices[i];
    char rows[256], devices[256];
    name_rows(b, i, false, rows, sizeof(rows));
    name_devices(b, c->devices, devices, sizeof(devices));
    if (!c->devices) {
        fprintf(out, "  %-16s left out; the least of it would take %.1f s\n", table->id,
                rg_budget_least_s(b, i));
        return;
    }
    const int divisor = rg_budget_divisor(c);
    fprintf(out, "  %-16s %5.1f s  rows %s%s%s", table->id, c->expected_s, rows,
            c->all_works && b->costs[i].works > 1 ? ", all works" : "",
            c->all_variants && b->costs[i].variants > b->costs[i].needed_variants ? ", all variants"
                                                                                  : "");
    if (!table->is_of_textures)
        fprintf(out, ", %dx%d, %s samples", table->width / divisor, table->height / divisor,
                c->all_samples ? "quick" : "6");
    fprintf(out, ", on %s\n", devices);
}

void rg_budget_tell(const struct rg_budget *b, FILE *out)
{
    double all_s = b->probed_s;
    for (int i = 0; i < b->count; i++)
        all_s += needed_s(b, i);
    fprintf(out,
            "plan: %.0f s, with %.0f s that this plan took; the budget is %.0f s, and what curves "
            "and claims need would take %.0f s\n",
            b->probed_s + b->planned_s, b->probed_s, b->seconds, all_s);
    for (int i = 0; i < b->count; i++)
        rg_budget_tell_table(b, i, out);
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
    name_devices(b, b->bits.all & ~c->devices, devices, sizeof(devices));
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

void rg_budget_tell_end(const struct rg_budget *b, double taken_s, FILE *out)
{
    const double planned_s = b->probed_s + b->planned_s;
    fprintf(out, "took %.0f s, planned %.0f s (%+.0f %%), of a budget of %.0f s; left out:\n",
            taken_s, planned_s, 100 * (taken_s / planned_s - 1), b->seconds);
    bool any = false;
    for (int i = 0; i < b->count; i++)
        any = print_left_out(b, i, out) || any;
    if (!any)
        fprintf(out, "  nothing\n");
}
