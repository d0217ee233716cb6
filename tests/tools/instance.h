// Settings and instances by assignments as text. Each function fails the test if it cannot do its
// work.
#ifndef RG_TESTS_TOOLS_INSTANCE_H
#define RG_TESTS_TOOLS_INSTANCE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/stages/assets.h"
#include "core/techniques/technique.h"

// A technique's defaults with `base` and then `more` assigned, each "key=value key=value" or "".
// The caller frees them.
static inline void *settings_of(const char *technique, const char *base, const char *more)
{
    const struct rg_technique *found = rg_technique_find(technique);
    assert_non_null(found);
    void *defaults = rg_settings_create(found);
    assert_non_null(defaults);
    void *based = rg_settings_copy(found, defaults, base);
    assert_non_null(based);
    void *settings = rg_settings_copy(found, based, more);
    assert_non_null(settings);
    free(based);
    free(defaults);
    return settings;
}

// The same settings' instance with a target of this size; rg_instance_close ends it.
static inline struct rg_instance *instance_of(struct rg_device *device, const char *technique,
                                              const char *base, const char *more, int width,
                                              int height)
{
    void *settings = settings_of(technique, base, more);
    struct rg_instance *instance =
        rg_instance_open(rg_technique_find(technique), device, settings, width, height);
    assert_non_null(instance);
    free(settings);
    return instance;
}

// A fact that a technique told.
static inline double fact_of(const struct rg_instance *instance, const char *name)
{
    for (int i = 0; i < instance->fact_count; i++)
        if (!strcmp(instance->facts[i].name, name))
            return instance->facts[i].number;
    fail_msg("no fact '%s'", name);
    return 0;
}

// What an asset's buffer holds; the caller frees it.
static inline void *asset_words(struct rg_instance *instance, const char *name)
{
    const struct rg_asset *asset = rg_asset_find(instance, name);
    assert_non_null(asset);
    void *words = malloc(asset->buf->size);
    assert_non_null(words);
    assert_true(rg_buf_read(asset->buf, 0, words, (int64_t)asset->buf->size));
    return words;
}

#endif
