#include "core/base/doing.h"

#include <stdbool.h>
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

static bool ends_with(const char *text, size_t length, const char *end)
{
    return length >= strlen(end) && !strcmp(text + length - strlen(end), end);
}

// Kernels that find no room in the text are shown as dots.
void rg_doing_run(const char *kernel)
{
    static const char more[] = ", ...";
    char name[80] = "'", *to = name + 1;
    rg_doing_begin("running kernel", kernel);
    if (!shared)
        return;
    to = append(to, name + sizeof(name) - 2, kernel);
    memcpy(to, "'", 2);
    const size_t used = strlen(shared->queued), left = sizeof(shared->queued) - used;
    if (strstr(shared->queued, name) || ends_with(shared->queued, used, more))
        return;
    const bool fits = strlen(name) + 2 + sizeof(more) <= left;
    char *end = shared->queued + sizeof(shared->queued) - 1;
    to = append(shared->queued + used, end, used && fits ? ", " : "");
    to = append(to, end, fits ? name : more);
    *to = 0;
}

void rg_doing_waited(void)
{
    if (shared)
        *shared->queued = 0;
}
