#include "harness/compare/diff/beside.h"

#include <stdio.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "core/image/extras.h"

static void copy(char *to, size_t size, const char *text, int length)
{
    snprintf(to, size, "%.*s", length, text);
    rg_plain(to);
}

static void note_difference(void *user, const struct rg_extra *a, const struct rg_extra *b)
{
    struct rg_beside *beside = user;
    if (!rg_array_fit(&beside->items, &beside->room, beside->count + 1, sizeof(*beside->items),
                      "what files hold besides")) {
        beside->is_short = true;
        return;
    }
    struct rg_difference *d = &beside->items[beside->count++];
    copy(d->what, sizeof(d->what), a->name, a->name_length);
    copy(d->a, sizeof(d->a), a->value, a->value_length);
    copy(d->b, sizeof(d->b), b->value, b->value_length);
}

// Equal texels mean different pictures if only one of the files is premultiplied.
static void compare_alpha(const struct rg_picture *a, const struct rg_picture *b,
                          struct rg_beside *beside)
{
    static const struct rg_extra kinds[] = {{true, "alpha", "straight", 5, 8},
                                            {true, "alpha", "associated", 5, 10}};
    if (a->is_associated != b->is_associated && rg_picture_is_see_through(a) &&
        rg_picture_is_see_through(b))
        note_difference(beside, &kinds[a->is_associated], &kinds[b->is_associated]);
}

static void warn_of_unapplied(const struct rg_picture *a, const char *name_a, const char *name_b)
{
    char names[300] = "";
    struct rg_extra extra;
    for (const char *at = a->extras; rg_extras_next(&at, &extra);) {
        const size_t length = strlen(names);
        if (!extra.is_applied)
            snprintf(names + length, sizeof(names) - length, "%s%.*s", length ? ", " : "",
                     extra.name_length, extra.name);
    }
    if (*names)
        rg_warning("%s and %s: have the same %s, which is not applied: figures of light are those "
                   "of sRGB's colours",
                   name_a, name_b, names);
}

bool rg_beside_find(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                    const char *name_b, struct rg_beside *beside)
{
    compare_alpha(a, b, beside);
    if (!rg_extras_compare(a->extras, b->extras, note_difference, beside))
        warn_of_unapplied(a, name_a, name_b);
    return !beside->is_short;
}

void rg_beside_judge(const struct rg_beside *beside, struct rg_comparison *comparison)
{
    if (!beside->count)
        return;
    for (int tier = 0; tier < RG_TIER_COUNT; tier++) {
        struct rg_verdict *verdict = &comparison->tiers.of[tier];
        if (verdict->holds)
            snprintf(verdict->why, sizeof(verdict->why), "the files differ in %.60s",
                     beside->items[0].what);
        verdict->holds = false;
    }
    comparison->tier = "none";
}

void rg_beside_print(const struct rg_beside *beside)
{
    if (beside->count)
        printf("\nthe files differ in\n");
    for (int64_t i = 0; i < beside->count; i++)
        printf("  %-28s A: %s; B: %s\n", beside->items[i].what, beside->items[i].a,
               beside->items[i].b);
}

// JSON must be UTF-8; in other text non-ASCII bytes become '?'.
static json_t *text_json(char *text)
{
    json_t *json = json_string(text);
    for (char *c = text; !json && *c; c++)
        if ((unsigned char)*c > 126)
            *c = '?';
    return json ? json : json_string(text);
}

json_t *rg_beside_json(const struct rg_beside *beside)
{
    json_t *all = json_array();
    for (int64_t i = 0; i < beside->count; i++)
        json_array_append_new(
            all, json_pack("{s:o, s:o, s:o}", "what", text_json(beside->items[i].what), "a",
                           text_json(beside->items[i].a), "b", text_json(beside->items[i].b)));
    return all;
}
