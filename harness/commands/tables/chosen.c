#include "harness/commands/tables/chosen.h"

#include <stddef.h>

#include "core/base/log.h"
#include "core/base/text/words.h"
#include "harness/tables/papers/papers.h"

bool rg_table_refuse(const char *id)
{
    struct rg_nearest nearest = {0};
    for (int i = 0; rg_tables[i]; i++)
        rg_nearest_try(&nearest, id, rg_tables[i]->id);
    return rg_error("table '%s': unknown; the nearest is '%s', and `raingauge list tables` prints "
                    "them",
                    id, nearest.name);
}

bool rg_tables_choose(const struct rg_words *ids, const struct rg_table *chosen[RG_MAX_WORDS],
                      int *count)
{
    *count = 0;
    for (int i = 0; i < ids->count; i++)
        if (!rg_table_find(ids->items[i]))
            return rg_table_refuse(ids->items[i]);
    for (int i = 0; rg_tables[i] && *count < RG_MAX_WORDS; i++)
        if (rg_words_name(ids, rg_tables[i]->id))
            chosen[(*count)++] = rg_tables[i];
    return true;
}
