#include "core/techniques/technique.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/lists.h"

#define DECLARE(name) extern const struct rg_technique rg_technique_##name;
#define ENTRY(name)   &rg_technique_##name,

RG_TECHNIQUES(DECLARE)
const struct rg_technique *const rg_techniques[] = {RG_TECHNIQUES(ENTRY) NULL};

const struct rg_technique *rg_technique_find(const char *name)
{
    for (int i = 0; rg_techniques[i]; i++)
        if (!strcmp(rg_techniques[i]->name, name))
            return rg_techniques[i];
    return NULL;
}

bool rg_instance_run(struct rg_instance *instance, struct rg_pass *pass, const struct rg_run *run)
{
    if (!rg_pass_run(pass, run))
        return false;
    if (instance->after_pass)
        instance->after_pass(pass->kernel->name, instance->user);
    return true;
}

void *rg_settings_create(const struct rg_technique *technique)
{
    void *settings = rg_alloc(1, technique->params->settings_size, technique->name);
    if (settings)
        rg_params_reset(technique->params, settings);
    return settings;
}

void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments)
{
    const size_t length = strlen(assignments) + 1;
    char *copy = rg_alloc(1, technique->params->settings_size, technique->name);
    char *words = copy ? rg_alloc(1, length, technique->name) : NULL, *rest = NULL;
    bool ok = words != NULL;
    if (ok) {
        memcpy(copy, settings, technique->params->settings_size);
        memcpy(words, assignments, length);
    }
    for (char *one = ok ? strtok_r(words, " ", &rest) : NULL; one && ok;
         one = strtok_r(NULL, " ", &rest))
        ok = rg_params_set(technique->params, copy, one);
    free(words);
    if (ok)
        return copy;
    free(copy);
    return NULL;
}
