#include "core/image/files/why.h"

#include <stdarg.h>
#include <stdio.h>

bool rg_why_set(struct rg_why *why, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why->text, sizeof(why->text), format, args);
    va_end(args);
    return false;
}
