#include "backends/asked/features.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

#define RG_FEATURE_WORD(name, word, does) word,
#define RG_FEATURE_DOES(name, word, does) does,
static const char *const words[] = {RG_FEATURES(RG_FEATURE_WORD)};
static const char *const what[] = {RG_FEATURES(RG_FEATURE_DOES)};

const char *rg_feature_word(int feature)
{
    return words[feature];
}

const char *rg_feature_does(int feature)
{
    return what[feature];
}

void rg_features_write(unsigned features, char text[RG_FEATURES_TEXT])
{
    char *end = text;
    snprintf(text, RG_FEATURES_TEXT, "none");
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        if (features >> i & 1)
            end += sprintf(end, "%s%s", end > text ? "+" : "", words[i]);
}

// Adds the feature of a word with this length. False if there is none.
static bool add(const char *word, size_t length, unsigned *features)
{
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        if (strlen(words[i]) == length && !strncmp(words[i], word, length)) {
            *features |= 1u << i;
            return true;
        }
    return false;
}

bool rg_features_read(unsigned *features)
{
    const char *asked = getenv("RG_NATIVE");
    char all[RG_FEATURES_TEXT];
    rg_features_write(RG_FEATURE_ALL, all);
    *features = asked && *asked ? 0 : RG_FEATURE_ALL;
    if (!asked || !*asked || !strcmp(asked, "none"))
        return true;
    for (const char *word = asked; word; word = strchr(word, '+') ? strchr(word, '+') + 1 : NULL)
        if (!add(word, strcspn(word, "+"), features))
            return rg_error("RG_NATIVE=%.80s: give none, or words of %s, or unset it", asked, all);
    return !(*features & RG_FEATURE_PLACES) || (*features & RG_FEATURE_SETUP) ||
           rg_error("RG_NATIVE=%.80s: places are interpolated only with setup; give both", asked);
}

void rg_features_settle(struct rg_device *device)
{
    const char *word = "";
    device->blends = !(device->info.features & RG_FEATURE_BLENDING) &&
                     !*device->info.limits.no_draws && device->backend->can_blend &&
                     device->backend->can_blend(device, &word);
}
