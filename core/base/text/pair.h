// Pairs of whole numbers, such as "1280x720". Numbers out of range become the nearest int.
#ifndef RG_CORE_BASE_TEXT_PAIR_H
#define RG_CORE_BASE_TEXT_PAIR_H

#include <stdbool.h>

// Whether the text is exactly two numbers with a sign between them.
bool rg_pair_read(const char *text, char sign, int *first, int *second);
// Whether it is "2-4", or one number that stands for both.
bool rg_range_read(const char *text, int *first, int *last);

#endif
