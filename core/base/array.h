// An array that grows at its end.
#ifndef RG_CORE_BASE_ARRAY_H
#define RG_CORE_BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Makes room for `count` elements of `size` bytes. `array` is the address of the pointer to them,
// of any type, which the caller frees; `room` is how many it holds. Both are 0 at first. Elements
// stay, and room at least doubles, so that growing one by one takes time in proportion. False, and
// one logged line that names `what` they are, when memory runs out; the array is then unchanged.
//
//     if (!rg_array_fit(&list->rows, &list->room, list->count + 1, sizeof(*list->rows), "rows"))
//         return false;
//     list->rows[list->count++] = row;
bool rg_array_fit(void *array, int64_t *room, int64_t count, size_t size, const char *what);

#endif
