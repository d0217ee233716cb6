#include "harness/tables/runs/left.h"

#include <string.h>

// Writes the rows that were not measured: "1, 4, 8-10".
static void name_rows(const struct rg_result *result, int count, char *text, size_t size)
{
    size_t used = 0;
    int from = -1;
    *text = 0;
    for (int row = 0; row <= count; row++) {
        const bool in = row < count && !rg_result_has(result, row);
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

static void name_devices(const struct rg_devices *all, unsigned devices, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int d = 0; d < all->count; d++)
        if (devices >> d & 1 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     all->devices[d]->info.name);
}

void rg_left_why(struct rg_left_why *why, const struct rg_devices *devices,
                 const struct rg_step *step, double expected_s, double left_s)
{
    char on[96];
    if (*why->text)
        return;
    name_devices(devices, step->devices, on, sizeof(on));
    const char *what = rg_turn_is_of_devices(step->turn) ? on : rg_turn_about(step->turn);
    if (left_s < 0)
        snprintf(why->text, sizeof(why->text), "%s did not end in time", what);
    else
        snprintf(why->text, sizeof(why->text), "%s would take %.1f s, and %.1f s were left", what,
                 expected_s, left_s);
}

// Prints what was not measured of a table; false if nothing was left out.
static bool print_left_out(const struct rg_standing *s, const struct rg_result *result,
                           const struct rg_left_why *why, const struct rg_devices *all, FILE *out)
{
    const struct rg_share *share = &s->share;
    char rows[256], devices[256], text[768] = "  all of it";
    unsigned bits = 0;
    for (int d = 0; d < all->count; d++)
        bits |= 1u << d;
    name_rows(result, s->table->row_count, rows, sizeof(rows));
    name_devices(all, bits & ~share->devices, devices, sizeof(devices));
    if (s->rows)
        snprintf(text, sizeof(text), "%s%s%s%s%s%s%s%s", *rows ? "; rows " : "", rows,
                 !share->all_works && s->works > 1 ? "; works but what was printed" : "",
                 !share->all_variants && s->variants > s->needed_variants
                     ? "; variants that no claim is about"
                     : "",
                 share->divisor > 1 ? "; whole pictures" : "",
                 share->all_samples ? "" : "; more than 6 samples", *devices ? "; " : "", devices);
    if (*text)
        fprintf(out, "  %-16s %s%s%s%s\n", s->table->id, text + 2, *why->text ? " (" : "",
                why->text, *why->text ? ")" : "");
    return *text;
}

void rg_left_tell(const struct rg_standing *standings, const struct rg_result *results,
                  const struct rg_left_why *whys, int count, const struct rg_devices *devices,
                  FILE *out)
{
    bool any = false;
    for (int i = 0; i < count; i++)
        any = print_left_out(&standings[i], &results[i], &whys[i], devices, out) || any;
    if (!any)
        fprintf(out, "  nothing\n");
}
