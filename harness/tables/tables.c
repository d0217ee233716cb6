#include "harness/tables/tables.h"

#include <stddef.h>
#include <string.h>

extern const struct rg_table rg_table_stuppacher_2;

const struct rg_table *const rg_tables[] = {&rg_table_stuppacher_2, NULL};

const struct rg_table *rg_table_find(const char *id)
{
    for (int i = 0; rg_tables[i]; i++)
        if (!strcmp(rg_tables[i]->id, id))
            return rg_tables[i];
    return NULL;
}
