#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

enum { FIRST_ROOM = 64 };

bool rg_array_fit(void *array, int64_t *room, int64_t count, size_t size, const char *what)
{
    if (count <= *room)
        return true;
    int64_t wanted = 2 * *room > FIRST_ROOM ? 2 * *room : FIRST_ROOM;
    if (wanted < count)
        wanted = count;
    void *memory;
    memcpy(&memory, array, sizeof(memory));
    // realloc must not see more than PTRDIFF_MAX bytes: no object is so large, and sanitizers end a
    // program that asks.
    const bool fits = (size_t)wanted <= PTRDIFF_MAX / size;
    void *grown = fits ? realloc(memory, (size_t)wanted * size) : NULL;
    if (!grown)
        return rg_harness_error("%s: no memory for %lld; ask for less, or close other programs",
                                what, (long long)wanted);
    memcpy(array, &grown, sizeof(grown));
    *room = wanted;
    return true;
}
