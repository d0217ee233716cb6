#include "harness/compare/gate/text/glob.h"

#include <string.h>

// After a mismatch it is enough to let the last * take one more character; earlier ones need no
// second try.
bool rg_glob_part(const char *pattern, size_t length, const char *text)
{
    const char *end = pattern + length;
    const char *star = NULL, *from = NULL; // after the last *; the text that it has not taken yet
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
