#include "harness/compare/gate/text/glob.h"

#include <string.h>

// After a mismatch the last * takes one character more: no earlier one need be tried again.
bool rg_glob_part(const char *pattern, size_t length, const char *text)
{
    const char *end = pattern + length;
    const char *star = NULL, *from = NULL; // behind the last *, and what it has not taken yet
    while (*text) {
        if (pattern < end && *pattern == '*') {
            star = ++pattern;
            from = text;
        } else if (pattern < end && (*pattern == '?' || *pattern == *text)) {
            pattern++;
            text++;
        } else if (star) {
            pattern = star;
            text = ++from;
        } else {
            return false;
        }
    }
    while (pattern < end && *pattern == '*')
        pattern++;
    return pattern == end;
}

bool rg_glob(const char *pattern, const char *text)
{
    return rg_glob_part(pattern, strlen(pattern), text);
}
