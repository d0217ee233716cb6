#include "harness/devices/drivers/variables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/devices/workers/environment.h"

void rg_variables_drop(struct rg_worker_variables *v, const char *key)
{
    char *value = v->text ? (char *)rg_environment_find(v->text, key) : NULL;
    if (!value)
        return;
    char *from = value - strlen(key) - 1, *next = value + strlen(value) + 1;
    memmove(from, next, (size_t)(v->text + v->size + 1 - next));
    v->size -= (size_t)(next - from);
}

bool rg_variables_set(struct rg_worker_variables *v, const char *key, const char *value)
{
    const size_t more = strlen(key) + strlen(value) + 2;
    rg_variables_drop(v, key);
    char *text = realloc(v->text, v->size + more + 1);
    v->failed = v->failed || !text;
    if (!text)
        return false;
    snprintf(text + v->size, more, "%s=%s", key, value);
    v->text = text;
    v->size += more;
    text[v->size] = 0;
    return true;
}

const char *rg_variables_find(const struct rg_worker_variables *v, const char *key)
{
    const char *value = v->text ? rg_environment_find(v->text, key) : NULL;
    return value ? value : getenv(key);
}

void rg_variables_free(struct rg_worker_variables *v)
{
    free(v->text);
    *v = (struct rg_worker_variables){.text = NULL};
}
