// Lists of words in a text, separated by single spaces.
#ifndef RG_CORE_BASE_TEXT_WORDS_H
#define RG_CORE_BASE_TEXT_WORDS_H

#include <stdbool.h>

// Whether `word` is one of `words`.
bool rg_has_word(const char *words, const char *word);

// The nearest of the names tried so far: it takes the fewest letters to insert, delete or change.
// Zero it before the first; `name` is NULL if none was tried.
struct rg_nearest {
    const char *name;
    int distance;
};
void rg_nearest_try(struct rg_nearest *nearest, const char *typed, const char *name);

#endif
