#include "core/techniques/stages/instance.h"

#include <stdarg.h>
#include <stdio.h>

#include "core/base/log.h"

void rg_add_counters(struct rg_instance *instance, const char *const *names, int count)
{
    for (int i = 0; i < count && instance->counter_count < RG_MAX_COUNTERS; i++)
        instance->counters[instance->counter_count++] = (struct rg_counter){names[i], 0};
}

struct rg_fact *rg_tell(struct rg_instance *instance, const char *name, double number)
{
    const bool is_full = instance->fact_count == RG_MAX_FACTS;
    if (is_full)
        instance->has_failed = !rg_error("fact '%s': one more than an instance has room for; "
                                         "raise RG_MAX_FACTS",
                                         name);
    struct rg_fact *fact = &instance->facts[is_full ? 0 : instance->fact_count++];
    *fact = (struct rg_fact){.name = name, .number = number};
    return fact;
}

struct rg_fact *rg_tell_text(struct rg_instance *instance, const char *name, const char *format,
                             ...)
{
    struct rg_fact *fact = rg_tell(instance, name, 0);
    va_list args;
    va_start(args, format);
    vsnprintf(fact->text, sizeof(fact->text), format, args);
    va_end(args);
    return fact;
}

void rg_tell_texture(struct rg_instance *instance, const char *name, const struct rg_image *image,
                     int first_level)
{
    if (instance->texture_count < RG_MAX_TEXTURES)
        instance->textures[instance->texture_count++] =
            (struct rg_texture){name, image, first_level};
}
