#include "harness/compare/gate/text/glob.h"

#include <stddef.h>

bool rg_glob(const char *pattern, const char *text)
{
    const char *star = NULL, *from = NULL; // behind the last *, and what it has not taken yet
    while (*text) {
        if (*pattern == '*') {
            star = ++pattern;
            from = text;
        } else if (*pattern == '?' || *pattern == *text) {
            pattern++;
            text++;
        } else if (star) {
            pattern = star;
            text = ++from;
        } else {
            return false;
        }
    }
    while (*pattern == '*')
        pattern++;
    return !*pattern;
}
