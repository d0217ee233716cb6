#include "core/base/text/pair.h"

#include <ctype.h>
#include <limits.h>
#include <stdlib.h>

// Reads a number at *text and advances *text.
static bool take(const char **text, int *number)
{
    if (!isdigit((unsigned char)**text) && **text != '-')
        return false; // strtol would skip blanks
    char *end;
    const long value = strtol(*text, &end, 10);
    if (end == *text)
        return false;
    *number = value > INT_MAX ? INT_MAX : value < INT_MIN ? INT_MIN : (int)value;
    *text = end;
    return true;
}

bool rg_int_read(const char *text, int *number)
{
    return take(&text, number) && !*text;
}

bool rg_pair_read(const char *text, char sign, int *first, int *second)
{
    return take(&text, first) && *text++ == sign && take(&text, second) && !*text;
}

bool rg_size_read(const char *text, int *width, int *height)
{
    return rg_pair_read(text, 'x', width, height) && *width >= 1 && *height >= 1 &&
           *width <= RG_MOST_PX && *height <= RG_MOST_PX;
}

bool rg_range_read(const char *text, int *first, int *last)
{
    if (rg_pair_read(text, '-', first, last))
        return true;
    const bool is_one = rg_int_read(text, first);
    *last = *first;
    return is_one;
}
