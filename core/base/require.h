// Refusing a call in one line.
#ifndef RG_CORE_BASE_REQUIRE_H
#define RG_CORE_BASE_REQUIRE_H

#include "core/base/log.h"

// Returns false, or NULL, from the function that it stands in, with one logged line that names
// object and number, unless `check` holds.
#define require(check, ...)                                                                        \
    do {                                                                                           \
        if (!(check))                                                                              \
            return rg_error(__VA_ARGS__);                                                          \
    } while (0)
#define require_or_null(check, ...)                                                                \
    do {                                                                                           \
        if (!(check))                                                                              \
            return rg_error_null(__VA_ARGS__);                                                     \
    } while (0)

#endif
