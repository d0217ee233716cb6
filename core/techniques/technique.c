#include "core/techniques/technique.h"

#include <stdlib.h>
#include <string.h>

#include "core/lists.h"

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
    void *settings = malloc(technique->params->settings_size);
    rg_params_reset(technique->params, settings);
    return settings;
}

void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments)
{
    char *copy = malloc(technique->params->settings_size);
    char *words = strdup(assignments), *rest = NULL;
    memcpy(copy, settings, technique->params->settings_size);
    bool ok = true;
    for (char *one = strtok_r(words, " ", &rest); one && ok; one = strtok_r(NULL, " ", &rest))
        ok = rg_params_set(technique->params, copy, one);
    free(words);
    if (ok)
        return copy;
    free(copy);
    return NULL;
}
