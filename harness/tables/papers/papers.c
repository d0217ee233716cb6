#include "harness/tables/papers/papers.h"

#include <math.h>
#include <string.h>

#include "harness/tables/papers/lists.h"

#define DECLARE(id) extern const struct rg_table rg_table_##id;
#define ENTRY(id)   &rg_table_##id,

RG_TABLES(DECLARE)
const struct rg_table *const rg_tables[] = {RG_TABLES(ENTRY) NULL};

const struct rg_table *rg_table_find(const char *id)
{
    for (int i = 0; rg_tables[i]; i++)
        if (!strcmp(rg_tables[i]->id, id))
            return rg_tables[i];
    return NULL;
}

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
