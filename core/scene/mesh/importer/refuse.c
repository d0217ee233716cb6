#include <stdarg.h>
#include <stdio.h>

#include "core/scene/mesh/importer/importer.h"

bool import_refuse(struct import *import, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(import->reply.error, sizeof(import->reply.error), format, args);
    va_end(args);
    return false;
}
