#include "core/base/text/words.h"

#include <string.h>

bool rg_has_word(const char *words, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = words; (at = strstr(at, word)); at += length)
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    return false;
}

// Letters to insert, delete or change to make `a` of `b`.
static int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 64 };
    int row[LONGEST + 1];
    int length = (int)strnlen(b, LONGEST);
    for (int j = 0; j <= length; j++)
        row[j] = j;
    for (int i = 0; a[i]; i++) {
        int diagonal = row[0];
        row[0] = i + 1;
        for (int j = 0; j < length; j++) {
            int changed = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            int shorter = row[j] < diagonal ? row[j] + 1 : diagonal + 1;
            row[j + 1] = changed < shorter ? changed : shorter;
        }
    }
    return row[length];
}

void rg_nearest_try(struct rg_nearest *nearest, const char *typed, const char *name)
{
    const int distance = edit_distance(typed, name);
    if (!nearest->name || distance < nearest->distance)
        *nearest = (struct rg_nearest){name, distance};
}
