#include "harness/report/pictures/linear.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { AROUND = RG_LINEAR_SIDE / 2, MOST_DIGITS = 24 };

struct window {
    int x, y; // the texel
    int left, top, width, height;
};

// --- which texels differ most ---

static bool are_alike(const struct rg_linear *linear)
{
    const struct rg_picture *first = &linear->pictures[0];
    bool are = linear->count > 1;
    for (int i = 1; i < linear->count; i++) {
        const struct rg_picture *other = &linear->pictures[i];
        are = are && other->width == first->width && other->height == first->height &&
              other->channels == first->channels;
    }
    return are;
}

static bool is_same(float a, float b)
{
    return !memcmp(&a, &b, sizeof(a));
}

// How much a value differs among the pictures: infinite if one of them alone is no number.
static float spread_of(const struct rg_linear *linear, int64_t at)
{
    float least = linear->pictures[0].texels[at], most = least;
    bool is_finite = isfinite(least), differs = false;
    for (int i = 1; i < linear->count; i++) {
        const float value = linear->pictures[i].texels[at];
        differs = differs || !is_same(value, linear->pictures[0].texels[at]);
        is_finite = is_finite && isfinite(value);
        least = fminf(least, value);
        most = fmaxf(most, value);
    }
    return !differs ? 0 : is_finite ? most - least : INFINITY;
}

// The largest spread of each texel's values.
static float *spreads_of(const struct rg_linear *linear)
{
    const struct rg_picture *first = &linear->pictures[0];
    const int64_t texels = (int64_t)first->width * first->height;
    float *spreads = malloc((size_t)texels * sizeof(*spreads));
    if (!spreads)
        return NULL;
    for (int64_t i = 0; i < texels; i++) {
        spreads[i] = 0;
        for (int c = 0; c < first->channels; c++)
            spreads[i] = fmaxf(spreads[i], spread_of(linear, i * first->channels + c));
    }
    return spreads;
}

// The surroundings of a texel, moved into the picture.
static struct window window_of(const struct rg_picture *picture, int x, int y)
{
    struct window w = {.x = x, .y = y};
    w.width = picture->width < RG_LINEAR_SIDE ? picture->width : RG_LINEAR_SIDE;
    w.height = picture->height < RG_LINEAR_SIDE ? picture->height : RG_LINEAR_SIDE;
    w.left = x - AROUND < 0 ? 0 : x - AROUND;
    w.top = y - AROUND < 0 ? 0 : y - AROUND;
    w.left = w.left + w.width > picture->width ? picture->width - w.width : w.left;
    w.top = w.top + w.height > picture->height ? picture->height - w.height : w.top;
    return w;
}

static int64_t count_differing(const struct rg_picture *picture, const float *spreads)
{
    const int64_t texels = (int64_t)picture->width * picture->height;
    int64_t count = 0;
    for (int64_t i = 0; i < texels; i++)
        count += spreads[i] > 0;
    return count;
}

// Takes the texel that differs most, the first of several, and clears its surroundings.
static bool take_worst(const struct rg_picture *picture, float *spreads, struct window *window)
{
    const int64_t texels = (int64_t)picture->width * picture->height;
    int64_t worst = 0;
    for (int64_t i = 1; i < texels; i++)
        worst = spreads[i] > spreads[worst] ? i : worst;
    if (!(spreads[worst] > 0))
        return false;
    *window = window_of(picture, (int)(worst % picture->width), (int)(worst / picture->width));
    for (int y = 0; y < window->height; y++)
        memset(spreads + (int64_t)(window->top + y) * picture->width + window->left, 0,
               (size_t)window->width * sizeof(*spreads));
    return true;
}

// --- their values ---

static json_t *values_json(const struct rg_linear *linear, int number, const struct window *w)
{
    const struct rg_picture *first = &linear->pictures[0], *picture = &linear->pictures[number];
    const size_t most = (size_t)w->width * (size_t)w->height * (size_t)first->channels;
    char *text = malloc(most * MOST_DIGITS + 1), *to = text;
    for (int y = w->top; text && y < w->top + w->height; y++) {
        const int64_t row = ((int64_t)y * first->width + w->left) * first->channels;
        for (int64_t i = row; i < row + (int64_t)w->width * first->channels; i++) {
            const bool is_told = number && is_same(picture->texels[i], first->texels[i]);
            to += is_told ? sprintf(to, "= ") : sprintf(to, "%.9g ", (double)picture->texels[i]);
        }
    }
    json_t *json = text ? json_stringn(text, (size_t)(to - text - 1)) : NULL;
    free(text);
    return json;
}

static json_t *pictures_json(const struct rg_linear *linear, const struct window *windows,
                             int count)
{
    json_t *pictures = json_array();
    for (int i = 0; i < linear->count; i++) {
        json_t *values = json_array();
        for (int w = 0; w < count; w++)
            json_array_append_new(values, values_json(linear, i, &windows[w]));
        json_array_append_new(pictures,
                              json_pack("{ss so}", "name", linear->names[i], "values", values));
    }
    return pictures;
}

json_t *rg_linear_json(const struct rg_linear *linear)
{
    struct window windows[RG_LINEAR_WORST];
    float *spreads = are_alike(linear) ? spreads_of(linear) : NULL;
    const int64_t differing = spreads ? count_differing(&linear->pictures[0], spreads) : 0;
    int count = 0;
    while (spreads && count < RG_LINEAR_WORST &&
           take_worst(&linear->pictures[0], spreads, &windows[count]))
        count++;
    free(spreads);
    if (!count)
        return NULL;
    json_t *worst = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(worst,
                              json_pack("{si si si si si si}", "x", windows[i].x, "y", windows[i].y,
                                        "left", windows[i].left, "top", windows[i].top, "width",
                                        windows[i].width, "height", windows[i].height));
    return json_pack("{si sI so so}", "channels", linear->pictures[0].channels, "differing",
                     (json_int_t)differing, "worst", worst, "pictures",
                     pictures_json(linear, windows, count));
}

void rg_linear_free(struct rg_linear *linear)
{
    for (int i = 0; i < linear->count; i++)
        rg_picture_destroy(&linear->pictures[i]);
    linear->count = 0;
}
