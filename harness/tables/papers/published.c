#include "harness/tables/papers/published.h"

#include <math.h>
#include <string.h>

bool rg_table_is_published(const struct rg_table *table)
{
    return table->hardware != NULL;
}

double rg_table_value(const struct rg_table *table, int row, const char *column)
{
    for (int c = 0; table->columns[c]; c++)
        if (!strcmp(table->columns[c], column))
            return table->rows[row].values[c];
    return NAN;
}

double rg_table_published_fps(const struct rg_table *table, int row, int variant)
{
    const char *column = table->variants[variant].fps;
    return rg_table_is_published(table) && column ? rg_table_value(table, row, column) : NAN;
}

bool rg_table_is_extra(const struct rg_table *table, int column)
{
    for (int v = 0; table->variants[v].name; v++)
        if (table->variants[v].fps && !strcmp(table->variants[v].fps, table->columns[column]))
            return false;
    return column >= table->key_count;
}
