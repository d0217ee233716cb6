#include "core/image/files/why.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

#include "core/base/log.h"

#define SET(is_of_machine)                                                                         \
    va_list args;                                                                                  \
    va_start(args, format);                                                                        \
    vsnprintf(why->text, sizeof(why->text), format, args);                                         \
    va_end(args);                                                                                  \
    why->is_machine = is_of_machine;                                                               \
    return false

bool rg_why_set(struct rg_why *why, const char *format, ...)
{
    SET(false);
}

bool rg_why_refused(struct rg_why *why, const char *format, ...)
{
    SET(true);
}

bool rg_why_unwritten(struct rg_why *why, const char *reason)
{
    return rg_why_set(why, "cannot be written: %s; %s", reason,
                      errno == EFBIG ? "allow larger files (ulimit -f)" : "make room");
}

bool rg_why_tell(const struct rg_why *why, const char *path)
{
    return why->is_machine ? rg_unsupported("%s: %s", path, why->text)
                           : rg_error("%s: %s", path, why->text);
}
