#include "harness/commands/tables/sets.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/record/record.h"

bool rg_sets_join(const struct rg_words *words, char **text)
{
    size_t size;
    *text = NULL;
    for (int i = 0; i < words->count; i++)
        if (strchr(words->items[i], ' '))
            return rg_error("--set '%s': a table takes no value with a space", words->items[i]);
    if (!words->count)
        return true;
    FILE *out = open_memstream(text, &size);
    for (int i = 0; out && i < words->count; i++)
        fprintf(out, "%s%s", i ? " " : "", words->items[i]);
    if (!out || fclose(out) != 0)
        return rg_harness_error("--set: no memory");
    // A record holds no more, and a cut text would name other settings.
    if (size < RG_SET_SIZE)
        return true;
    free(*text);
    *text = NULL;
    return rg_error("--set: %zu bytes in all; a table takes at most %d", size, RG_SET_SIZE - 1);
}
