#include "core/image/files/why.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

#define SET(of_fault)                                                                              \
    va_list args;                                                                                  \
    va_start(args, format);                                                                        \
    vsnprintf(why->text, sizeof(why->text), format, args);                                         \
    va_end(args);                                                                                  \
    why->fault = of_fault;                                                                         \
    return false

bool rg_why_set(struct rg_why *why, const char *format, ...)
{
    SET(RG_FAULT_INPUT);
}

bool rg_why_system(struct rg_why *why, int error, const char *format, ...)
{
    SET(rg_is_want(error) ? RG_FAULT_HARNESS : RG_FAULT_INPUT);
}

bool rg_why_unwritten(struct rg_why *why, const char *reason)
{
    const int error = errno;
    return rg_why_system(why, error, "cannot be written: %s; %s", reason,
                         error == EFBIG ? "allow larger files (ulimit -f)" : "make room");
}

bool rg_why_allocate(struct rg_picture *picture, int64_t width, int64_t height, int64_t channels,
                     struct rg_why *why)
{
    if (rg_picture_allocate(picture, width, height, channels, why->text, sizeof(why->text)))
        return true;
    why->fault = rg_is_want(errno) ? RG_FAULT_HARNESS : RG_FAULT_INPUT;
    return false;
}

bool rg_why_tell(const struct rg_why *why, const char *path)
{
    switch (why->fault) {
    case RG_FAULT_NONE:
        return rg_unsupported("%s: %s", path, why->text);
    case RG_FAULT_HARNESS:
        return rg_harness_error("%s: %s", path, why->text);
    default:
        return rg_error("%s: %s", path, why->text);
    }
}
