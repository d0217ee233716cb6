#include "core/base/text/add.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void rg_text_add(char *text, size_t size, const char *between, const char *format, ...)
{
    size_t used = strlen(text);
    if (used)
        used += (size_t)snprintf(text + used, size - used, "%s", between);
    if (used >= size)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(text + used, size - used, format, args);
    va_end(args);
}
