// Words in a text, with a space between two.
#ifndef RG_CORE_BASE_TEXT_WORDS_H
#define RG_CORE_BASE_TEXT_WORDS_H

#include <stdbool.h>

// Whether a word is among them.
bool rg_has_word(const char *words, const char *word);

#endif
