#include "harness/cli/option.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static const struct rg_option help_rows[] = {
    RG_GROUP("Help"),
    {RG_OPTION_HELP, "help", .letter = 'h', .about = "prints this"},
    {RG_OPTION_END},
};

static int add_rows(const struct rg_option *table, size_t offset, const char *initial,
                    struct rg_option *rows, int count)
{
    for (; table->kind; table++) {
        if (table->kind == RG_OPTION_INCLUDE) {
            count = add_rows(table->included, offset + table->offset, table->initial, rows, count);
            continue;
        }
        assert(count < RG_MAX_OPTION_ROWS);
        rows[count] = *table;
        rows[count].offset += offset;
        rows[count].initial = initial ? initial : table->initial;
        count++;
    }
    return count;
}

int rg_option_rows(const struct rg_option *table, struct rg_option *rows)
{
    return add_rows(help_rows, 0, NULL, rows, add_rows(table, 0, NULL, rows, 0));
}

const char *rg_option_argument(const struct rg_option *row, char text[RG_ARGUMENT_SIZE])
{
    if (row->argument)
        return row->argument;
    size_t used = 0;
    text[0] = 0;
    for (int i = 0; row->choices && row->choices[i] && used < RG_ARGUMENT_SIZE; i++)
        used += (size_t)snprintf(text + used, RG_ARGUMENT_SIZE - used, "%s%s", i ? "|" : "",
                                 row->choices[i]);
    return text;
}

const char *rg_option_about(const struct rg_option *row, char text[RG_ABOUT_SIZE])
{
    if (!row->initial)
        return row->about;
    snprintf(text, RG_ABOUT_SIZE, "%s (default %s)", row->about, row->initial);
    return text;
}
