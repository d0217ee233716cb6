// A check that refuses a call in one line.
#ifndef RG_CORE_BASE_REQUIRE_H
#define RG_CORE_BASE_REQUIRE_H

#include "core/base/log.h"

// Unless `check` holds, makes the enclosing function return false or NULL and logs one line, which
// should name object and number.
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
