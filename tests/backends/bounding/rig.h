// A scene of a plain state, whose values are worked out by hand.
#ifndef RG_TESTS_BACKENDS_BOUNDING_RIG_H
#define RG_TESTS_BACKENDS_BOUNDING_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "shaders/fixed/bounds/bounds.h"
#include "shaders/fixed/bounds/scene.h"
#include "tests/tools/expect.h"

static const struct rg_fixed_precision fine = {
    .subpixel_bits = 8,
    .subtexel_bits = 8,
    .mip_bits = 8,
    .has_places = true,
    .places = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}},
};

static inline void assert_span(struct rg_span a, double low, double high)
{
    const double slack = 1e-5;
    if (fabs(a.low - low) > slack || fabs(a.high - high) > slack)
        fail_msg("%.9g to %.9g, and not %.9g to %.9g", a.low, a.high, low, high);
}

static struct rg_scene *scene; // of a plain state

static const struct rg_fixed_state plain = {0};

static inline int begin(void **state)
{
    (void)state;
    scene = calloc(1, sizeof(*scene));
    if (!scene)
        return -1;
    scene->texture.texels = calloc(RG_SCENE_FACES, sizeof(*scene->texture.texels));
    if (!scene->texture.texels)
        return -1;
    scene->state = &plain;
    scene->precision = &fine;
    scene->grid = 1 / 256.0;
    scene->sample_count = 1;
    return 0;
}

static inline int end(void **state)
{
    (void)state;
    free(scene->texture.texels);
    free(scene);
    return 0;
}

// A corner at a pixel of the 64 x 64.
static inline struct rg_corner corner(double x, double y, double w, double value)
{
    return (struct rg_corner){.place = {(x / 32 - 1) * w, (y / 32 - 1) * w, 0.5 * w, w},
                              .colour = {value, value, value, value},
                              .cut = 1};
}

static inline struct rg_primitive triangle(struct rg_corner a, struct rg_corner b,
                                           struct rg_corner c)
{
    return (struct rg_primitive){.count = 3, .corners = {a, b, c}};
}

// Half a square of 20 pixels.
static inline struct rg_primitive half_square(void)
{
    return triangle(corner(10, 10, 1, 0), corner(30, 10, 1, 1), corner(10, 30, 1, 0));
}

#endif
