#include "harness/commands/cli/option.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static const struct rg_option help_rows[] = {
    RG_GROUP("Help"),
    {RG_OPTION_HELP, "help", .letter = 'h', .about = "prints this help"},
    {RG_OPTION_END},
};

// `includer` is the row that includes the table; its properties override those of the table's rows.
static int add_rows(const struct rg_option *table, const struct rg_option *includer,
                    struct rg_option *rows, int count)
{
    int arguments = includer->arguments;
    for (; table->kind; table++) {
        struct rg_option row = *table;
        if (row.kind == RG_OPTION_GROUP)
            arguments = row.arguments;
        row.arguments = arguments;
        row.offset += includer->offset;
        if (row.kind == RG_OPTION_INCLUDE) {
            count = add_rows(row.included, &row, rows, count);
            continue;
        }
        assert(count < RG_MAX_OPTION_ROWS);
        row.initial = includer->initial ? includer->initial : row.initial;
        rows[count++] = row;
    }
    return count;
}

int rg_option_rows(const struct rg_option *table, struct rg_option *rows)
{
    const struct rg_option command = {0};
    return add_rows(help_rows, &command, rows, add_rows(table, &command, rows, 0));
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

bool rg_words_name(const struct rg_words *words, const char *text)
{
    bool found = !words->count;
    for (int i = 0; i < words->count; i++)
        found = found || !strcmp(words->items[i], text);
    return found;
}
