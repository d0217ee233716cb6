#include "harness/commands/tables/chosen.h"

#include <stddef.h>

#include "core/base/log.h"
#include "core/base/text/words.h"
#include "harness/tables/own/file.h"
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

bool rg_tables_read(const struct rg_words *names, struct rg_words *ids)
{
    *ids = *names;
    for (int i = 0; i < ids->count; i++) {
        if (!rg_own_is_file(names->items[i]))
            continue;
        const struct rg_table *own = rg_own_read(names->items[i]);
        if (!own)
            return false;
        ids->items[i] = own->id;
    }
    return true;
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
