#include "core/base/doing.h"

#include <stddef.h>
#include <string.h>

static struct rg_doing *shared;

void rg_doing_share(struct rg_doing *page)
{
    shared = page;
}

static char *append(char *to, const char *end, const char *text)
{
    while (*text && to < end)
        *to++ = *text++;
    return to;
}

void rg_doing_begin(const char *what, const char *name)
{
    if (!shared)
        return;
    const char *const end = shared->what + sizeof(shared->what) - 1;
    char *to = append(shared->what, end, what);
    if (*name) {
        to = append(to, end, " '");
        to = append(to, end, name);
        to = append(to, end, "'");
    }
    *to = 0;
    atomic_fetch_add_explicit(&shared->count, 1, memory_order_relaxed);
}
