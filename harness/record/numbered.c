#include "harness/record/numbered.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

// The length of a place for a number at `at`, 0 if there is none; *digits: its least number of
// digits.
static int place_at(const char *at, int *digits)
{
    *digits = 0;
    if (at[0] != '%')
        return 0;
    if (at[1] == 'd')
        return 2;
    if (at[1] != '0' || at[2] < '1' || at[2] > '9' || at[3] != 'd')
        return 0;
    *digits = at[2] - '0';
    return 4;
}

// The first place from `at` on, or NULL.
static const char *find_place(const char *at, int *digits, int *length)
{
    for (; *at; at++)
        if ((*length = place_at(at, digits)))
            return at;
    return NULL;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

int rg_numbered_places(const char *path)
{
    int count = 0, digits, length;
    for (const char *at = name_of(path); (at = find_place(at, &digits, &length)); at += length)
        count++;
    return count;
}

bool rg_numbered_path(const char *path, int number, char *numbered, size_t size)
{
    int digits = 0, length = 0;
    const char *place = find_place(name_of(path), &digits, &length);
    const int written = snprintf(numbered, size, "%.*s%0*d%s", (int)(place - path), path, digits,
                                 number, place + length);
    return (written >= 0 && (size_t)written < size) ||
           rg_error("%.80s...: the path is too long; choose a shorter one", path);
}
