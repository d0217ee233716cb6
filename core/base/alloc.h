// Allocations that log their own failure.
#ifndef RG_CORE_BASE_ALLOC_H
#define RG_CORE_BASE_ALLOC_H

#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/memory.h"

// Zeroed memory for `count` elements, which the caller frees. NULL, and one logged line that names
// `what` it was for, when memory runs out or one call asks for more than is allowed (memory.h).
static inline void *rg_alloc(size_t count, size_t size, const char *what)
{
    size_t bytes;
    if (!__builtin_mul_overflow(count, size, &bytes) && !rg_memory_allows_piece((int64_t)bytes)) {
        rg_memory_refuse(what, (int64_t)bytes, "a smaller --size or setting");
        return NULL;
    }
    void *memory = calloc(count ? count : 1, size);
    return memory ? memory
                  : rg_harness_error_null(
                        "%s: no memory for %zu times %zu bytes; ask for less, or close "
                        "other programs",
                        what, count, size);
}

// Memory aligned to cache lines, not zeroed, which the caller frees. NULL, without a message, when
// there is none.
static inline void *rg_alloc_lines(size_t size)
{
    const size_t line = 64;
    return aligned_alloc(line, (size + line - 1) / line * line);
}

#endif
