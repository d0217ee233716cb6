#include "harness/commands/cli/subject.h"

#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/text/words.h"

const struct rg_technique *rg_subject_technique(const char *name)
{
    const struct rg_technique *technique = rg_technique_find(name);
    struct rg_nearest nearest = {0};
    if (technique)
        return technique;
    for (int i = 0; rg_techniques[i]; i++)
        rg_nearest_try(&nearest, name, rg_techniques[i]->name);
    return rg_error_null("technique '%s': unknown; the nearest is '%s', and `raingauge list "
                         "techniques` prints them",
                         name, nearest.name);
}

void *rg_subject_settings(const struct rg_technique *technique, const struct rg_words *sets)
{
    void *settings = rg_settings_create(technique);
    for (int i = 0; settings && i < sets->count; i++) {
        if (!rg_params_set(technique->params, settings, sets->items[i])) {
            free(settings);
            return NULL;
        }
    }
    return settings;
}

const struct rg_technique *rg_subject_find(const struct rg_words *arguments,
                                           const struct rg_words *sets, void **settings)
{
    if (arguments->count < 1)
        return rg_error_null("no technique named; `raingauge list techniques` prints them");
    const struct rg_technique *technique = rg_subject_technique(arguments->items[0]);
    *settings = technique ? rg_subject_settings(technique, sets) : NULL;
    return *settings ? technique : NULL;
}
