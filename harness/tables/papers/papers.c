#include "harness/tables/papers/papers.h"

#include <math.h>
#include <stdio.h>
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

int rg_table_variant_count(const struct rg_table *table)
{
    int count = 0;
    while (table->variants[count].name)
        count++;
    return count;
}

double rg_table_value(const struct rg_table *table, int row, const char *column)
{
    for (int c = 0; table->columns[c]; c++)
        if (!strcmp(table->columns[c], column))
            return table->rows[row].values[c];
    return NAN;
}

bool rg_table_is_extra(const struct rg_table *table, int column)
{
    for (int v = 0; table->variants[v].name; v++)
        if (table->variants[v].fps && !strcmp(table->variants[v].fps, table->columns[column]))
            return false;
    return column >= table->key_count;
}

void rg_table_row_name(const struct rg_table *table, int row, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", table->names ? table->rows[row].name : "");
    for (int c = 0; c < table->key_count && used < size; c++)
        used += (size_t)snprintf(text + used, size - used, "%s%s %.10g", used ? ", " : "",
                                 table->columns[c], table->rows[row].values[c]);
}
