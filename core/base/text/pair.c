#include "core/base/text/pair.h"

#include <limits.h>
#include <stdlib.h>

// Reads a number at *text and advances *text.
static bool take(const char **text, int *number)
{
    char *end;
    const long value = strtol(*text, &end, 10);
    if (end == *text)
        return false;
    *number = value > INT_MAX ? INT_MAX : value < INT_MIN ? INT_MIN : (int)value;
    *text = end;
    return true;
}

bool rg_pair_read(const char *text, char sign, int *first, int *second)
{
    return take(&text, first) && *text++ == sign && take(&text, second) && !*text;
}

bool rg_range_read(const char *text, int *first, int *last)
{
    const char *rest = text;
    if (rg_pair_read(text, '-', first, last))
        return true;
    const bool is_one = take(&rest, first) && !*rest;
    *last = *first;
    return is_one;
}
