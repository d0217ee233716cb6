#include "harness/tables/papers/papers.h"

#include <string.h>

#include "harness/tables/papers/lists.h"

#define DECLARE(id) extern const struct rg_table rg_table_##id;
#define ENTRY(id)   &rg_table_##id,

RG_TABLES(DECLARE)
static const struct rg_table *const of_papers[] = {RG_TABLES(ENTRY) NULL};
const struct rg_table *const *rg_tables = of_papers;

const struct rg_table *rg_table_find(const char *id)
{
    for (int i = 0; rg_tables[i]; i++)
        if (!strcmp(rg_tables[i]->id, id))
            return rg_tables[i];
    return NULL;
}
