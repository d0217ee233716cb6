// Whole numbers, alone or in pairs such as "1280x720". Those out of range become the nearest int.
#ifndef RG_CORE_BASE_TEXT_PAIR_H
#define RG_CORE_BASE_TEXT_PAIR_H

#include <stdbool.h>

// Whether the text is exactly one number.
bool rg_int_read(const char *text, int *number);
// Whether it is exactly two with a sign between them.
bool rg_pair_read(const char *text, char sign, int *first, int *second);
enum { RG_MOST_PX = 16384 }; // along a side of a picture
// Whether it is the size of a picture, "1280x720".
bool rg_size_read(const char *text, int *width, int *height);
// Whether it is "2-4", or one number that stands for both.
bool rg_range_read(const char *text, int *first, int *last);

#endif
