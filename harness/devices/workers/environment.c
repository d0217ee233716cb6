#include "harness/devices/workers/environment.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

char *rg_environment_copy(const char *variables)
{
    size_t size = 1;
    for (const char *v = variables; v && *v; v += strlen(v) + 1)
        size += strlen(v) + 1;
    char *copy = calloc(1, size);
    if (copy && variables)
        memcpy(copy, variables, size);
    return copy;
}

static bool has_key_of(const char *variables, const char *other)
{
    for (const char *v = variables; *v; v += strlen(v) + 1)
        if (!strncmp(v, other, strcspn(v, "=") + 1))
            return true;
    return false;
}

char **rg_environment_with(char *variables)
{
    size_t count = 0, used = 0;
    for (char *v = variables; *v; v += strlen(v) + 1)
        count++;
    for (char **v = environ; *v; v++)
        count++;
    char **all = calloc(count + 1, sizeof(*all));
    for (char *v = variables; all && *v; v += strlen(v) + 1)
        all[used++] = v;
    for (char **v = environ; all && *v; v++)
        if (!has_key_of(variables, *v))
            all[used++] = *v;
    return all;
}

const char *rg_environment_find(const char *variables, const char *key)
{
    const size_t length = strlen(key);
    for (const char *v = variables; *v; v += strlen(v) + 1)
        if (!strncmp(v, key, length) && v[length] == '=')
            return v + length + 1;
    return NULL;
}
