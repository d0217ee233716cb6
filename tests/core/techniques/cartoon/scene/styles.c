// The scene's maps against a ray caster in double precision, and each style's colours against its
// paper's formula, for each pixel.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/cartoon/rig.h"
#include "tests/tools/expect.h"

// --- maps ---

// Normals have 10 bits in the mesh and 11 in the map; depths are floats.
static const double NORMAL_OFF = 0.004, DEPTH_OFF = 2e-6;

static double off_by(const float *texel, struct vec n)
{
    return fmax(fabs((double)texel[0] - n.x),
                fmax(fabs((double)texel[1] - n.y), fabs((double)texel[2] - n.z)));
}

static void compare_maps(struct rg_device *device, const char *settings, int width, int height)
{
    struct cartoon *c = rig_draw(device, settings, width, height);
    const struct scene_oracle o = rig_oracle(c);
    float *normals = rig_asset(c, "normal_map"), *depths = rig_asset(c, "depth_map");
    int seen = 0, unsure = 0;
    for (int i = 0; i < width * height; i++) {
        struct scene_hit hit;
        if (!scene_cast_pixel(&o, i % width, i / width, &hit)) {
            unsure++;
            continue;
        }
        const float *texel = normals + 4 * (size_t)i;
        const double material = hit.face < 0 ? 0 : 1 + c->diorama->materials[hit.face];
        assert_equals((double)texel[3], material);
        if (fabs((double)depths[i] - hit.depth) > DEPTH_OFF)
            fail_msg("%s: pixel %d %d: depth %.9g, not %.9g", settings, i % width, i / width,
                     (double)depths[i], hit.depth);
        if (off_by(texel, hit.normal) > NORMAL_OFF)
            fail_msg("%s: pixel %d %d: normal %g %g %g, not %g %g %g", settings, i % width,
                     i / width, (double)texel[0], (double)texel[1], (double)texel[2], hit.normal.x,
                     hit.normal.y, hit.normal.z);
        seen += hit.face >= 0;
    }
    assert_above(seen, width * height / 3);
    assert_below(unsure, width * height / 4);
    free(normals);
    free(depths);
    rig_close(c);
}

static void maps_hold_what_rays_meet(void **state)
{
    compare_maps(*state, "scene=house2 style=gooch", 72, 64);
    compare_maps(*state, "scene=house2 style=gooch turn_deg=170 rise_deg=25 zoom=2", 48, 40);
    compare_maps(*state, "scene=car style=gooch", 40, 36);
    compare_maps(*state, "scene=ground style=gooch turn_deg=-70 zoom=1.5", 40, 30);
}

// Seen from behind, a sheet's normals are on the other side. Even a low camera sees puddles and
// lawns from above, so that an open mesh is turned to be seen from within.
static void sheets_have_two_sides(void **state)
{
    struct cartoon *c = rig_draw(*state, "scene=table style=gooch zoom=2.5 rise_deg=-20", 48, 48);
    const struct scene_oracle o = rig_oracle(c);
    float *normals = rig_asset(c, "normal_map"), *depths = rig_asset(c, "depth_map");
    int behind = 0;
    for (int i = 0; i < 48 * 48; i++) {
        const float *n = normals + 4 * (size_t)i;
        if (n[3] == 0)
            continue;
        const struct vec at = scene_place(&o, i % 48, i / 48, (double)depths[i]);
        const double towards = (double)n[0] * (o.eye.x - at.x) + (double)n[1] * (o.eye.y - at.y) +
                               (double)n[2] * (o.eye.z - at.z);
        behind += towards < 0;
    }
    assert_below(behind, 48 * 48 / 100); // at rims, smooth normals look away a little
    free(normals);
    free(depths);
    rig_close(c);
}

// --- styles ---

// The target stores halves, rounded down: off by 1/1024 of light, and half as much of its root.
static const double COLOUR_OFF = 0.0012;

struct styled {
    struct cartoon *c;
    struct scene_oracle o;
    struct look look;
    struct hatching hatching;
    uint8_t *strokes[CARTOON_LEVELS];
    float *normals, *depths, *inks, *colours;
};

// Unpacks a texel's seven tones from the two layers of words on the device.
static void read_strokes(struct styled *s)
{
    const struct rg_image *image = rg_asset_find(&s->c->base, "strokes")->image;
    for (int level = 0; level < CARTOON_LEVELS; level++) {
        const size_t texels = (size_t)(CARTOON_TILE_PX >> level) * (CARTOON_TILE_PX >> level);
        uint32_t *words[2] = {malloc(4 * texels), malloc(4 * texels)};
        s->strokes[level] = malloc(7 * texels);
        assert_true(words[0] && words[1] && s->strokes[level]);
        for (int layer = 0; layer < 2; layer++)
            assert_true(rg_image_read((struct rg_image *)image, layer, level, words[layer]));
        for (size_t i = 0; i < texels; i++)
            for (int tone = 0; tone < 7; tone++)
                s->strokes[level][7 * i + (size_t)tone] =
                    (uint8_t)(tone < 4 ? words[0][i] >> 8 * tone : words[1][i] >> 8 * (tone - 3));
        s->hatching.bytes[level] = s->strokes[level];
        free(words[0]);
        free(words[1]);
    }
}

static double radians(double degrees)
{
    return degrees / 180 * M_PI;
}

static struct styled styled_draw(struct rg_device *device, const char *settings, int size)
{
    struct styled s = {.c = rig_draw(device, settings, size, size)};
    const struct cartoon_settings *set = &s.c->settings;
    const struct diorama_view *view = &s.c->diorama->view;
    const double turn = radians(view->turn_deg + set->light_turn_deg);
    const double rise = radians(set->light_rise_deg);
    s.o = rig_oracle(s.c);
    s.look = (struct look){s.o.eye, {cos(rise) * sin(turn), sin(rise), cos(rise) * cos(turn)}};
    s.normals = rig_asset(s.c, "normal_map");
    s.depths = rig_asset(s.c, "depth_map");
    s.inks = rig_asset(s.c, "ink");
    s.colours = rig_texels(s.c->base.target);
    s.hatching = (struct hatching){.size_px = CARTOON_TILE_PX,
                                   .levels = CARTOON_LEVELS,
                                   .paper = {set->paper[0], set->paper[1], set->paper[2]},
                                   .ink = {set->ink[0], set->ink[1], set->ink[2]},
                                   .lit = set->hatch_lit,
                                   .ambient = set->hatch_ambient,
                                   .wash = set->hatch_wash};
    s.hatching.focal_px = size / 2.0 / tan(radians(view->angle_deg) / 2);
    s.hatching.tile_m = set->hatch_px * view->distance_m / s.hatching.focal_px;
    if (set->style == CARTOON_HATCHING)
        read_strokes(&s);
    return s;
}

static void styled_close(struct styled *s)
{
    for (int level = 0; level < CARTOON_LEVELS; level++)
        free(s->strokes[level]);
    free(s->normals);
    free(s->depths);
    free(s->inks);
    free(s->colours);
    rig_close(s->c);
}

static struct surface surface_at(const struct styled *s, int i)
{
    const float *n = s->normals + 4 * (size_t)i;
    const struct diorama_material *m = &s->c->diorama->palette[(int)n[3] - 1];
    const int width = s->o.width;
    return (struct surface){
        .normal = {(double)n[0], (double)n[1], (double)n[2]},
        .at = scene_place(&s->o, i % width, i / width, (double)s->depths[i]),
        .colour = {round((double)m->r * 255) / 255, round((double)m->g * 255) / 255,
                   round((double)m->b * 255) / 255},
        .shine = round((double)m->shine * 255) / 255,
    };
}

static struct vec sky_at(const struct styled *s, int i)
{
    const double t = (i / s->o.width + 0.5) / s->o.height;
    const float *high = s->c->diorama->sky, *low = s->c->diorama->low_sky;
    double c[3];
    for (int k = 0; k < 3; k++)
        c[k] = (double)high[k] * (1 - t) + (double)low[k] * t;
    return (struct vec){c[0], c[1], c[2]};
}

// A style's colour without outlines.
static struct vec due_at(const struct styled *s, int i)
{
    const struct cartoon_settings *set = &s->c->settings;
    const bool nothing = s->normals[4 * (size_t)i + 3] == 0;
    const struct gooch gooch = {set->gooch_blue, set->gooch_yellow, set->gooch_alpha,
                                set->gooch_beta};
    const struct tones tones = {set->shadow_tone, set->middle_tone,   set->middle_from,
                                set->lit_from,    set->tone_softness, set->glint_from,
                                set->shadow_blue};
    if (set->style == CARTOON_OUTLINES || (set->style == CARTOON_HATCHING && nothing))
        return s->hatching.paper;
    if (nothing)
        return sky_at(s, i);
    const struct surface surface = surface_at(s, i);
    return set->style == CARTOON_HATCHING ? hatching_colour(&surface, &s->look, &s->hatching)
           : set->style <= CARTOON_GOOCH_OUTLINES ? gooch_colour(&surface, &s->look, &gooch)
                                                  : tones_colour(&surface, &s->look, &tones);
}

enum { SIDE = 64 }; // of the pictures

static void compare_style(struct rg_device *device, const char *settings, double tolerance)
{
    struct styled s = styled_draw(device, settings, SIDE);
    const int style = s.c->settings.style;
    const bool inked = style != CARTOON_GOOCH && style != CARTOON_TONED;
    int lines = 0, things = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const struct vec due = due_at(&s, i);
        const double ink = inked ? 1 - (double)s.inks[i] : 0;
        const double paper[3] = {due.x, due.y, due.z};
        const double pen[3] = {s.hatching.ink.x, s.hatching.ink.y, s.hatching.ink.z};
        for (int k = 0; k < 3; k++) {
            const double drawn = sqrt((double)s.colours[4 * (size_t)i + (size_t)k]);
            const double expected = paper[k] + (pen[k] - paper[k]) * ink;
            if (fabs(drawn - expected) > tolerance)
                fail_msg("%s: pixel %d %d, channel %d: %g, not %g", settings, i % SIDE, i / SIDE, k,
                         drawn, expected);
        }
        lines += ink > 0.5;
        things += s.normals[4 * (size_t)i + 3] > 0;
    }
    assert_above(things, SIDE * SIDE / 3);
    assert_true(inked ? lines > 60 : lines == 0);
    styled_close(&s);
}

static void gooch_is_cool_to_warm(void **state)
{
    compare_style(*state, "scene=car style=gooch", COLOUR_OFF);
    compare_style(*state,
                  "scene=table style=gooch gooch_blue=0.55 gooch_yellow=0.3 gooch_alpha=0.25 "
                  "gooch_beta=0.5 light_turn_deg=30 light_rise_deg=60",
                  COLOUR_OFF);
    compare_style(*state, "scene=house2 style=gooch_outlines turn_deg=40", COLOUR_OFF);
    // The light is behind, where no highlight is.
    compare_style(*state, "scene=car style=gooch light_turn_deg=170 light_rise_deg=5", COLOUR_OFF);
}

// A step between tones enlarges errors of floats by its steepness.
static void cartoon_has_three_tones(void **state)
{
    compare_style(*state, "scene=car style=cartoon tone_softness=0.2", COLOUR_OFF);
    compare_style(*state,
                  "scene=table style=cartoon shadow_tone=0.5 middle_tone=0.7 middle_from=0.1 "
                  "lit_from=0.7 tone_softness=0.1 zoom=2 glint_from=0.7 shadow_blue=0.3",
                  COLOUR_OFF);
    compare_style(*state, "scene=ground style=cartoon_outlines tone_softness=0.3", COLOUR_OFF);
}

static void outlines_are_ink_on_paper(void **state)
{
    compare_style(*state, "scene=house1 style=outlines outline_px=2 inner_px=1.5", COLOUR_OFF);
    compare_style(*state,
                  "scene=house1 style=outlines ink_r=0.6 ink_g=0.2 ink_b=0.1 paper_r=0.9 "
                  "paper_g=0.8 paper_b=0.5",
                  COLOUR_OFF);
}

// Strokes come from texels of 8 bits, which may differ over the whole range.
static void hatching_mixes_tones_and_levels(void **state)
{
    compare_style(*state, "scene=house1 style=hatching hatch_px=100", 0.004);
    compare_style(*state,
                  "scene=table style=hatching hatch_px=60 hatch_ambient=0.1 hatch_lit=0.9 "
                  "hatch_wash=0.6 zoom=2 ink_r=0.4 ink_b=0.5 paper_g=0.8",
                  0.004);
    compare_style(*state, "scene=park2 style=hatching hatch_px=30 light_rise_deg=15", 0.004);
}

// --- pictures kept while the camera stands still ---

enum { KEPT_PX = 72, KEPT_FRAMES = 4 };

// The last of a few frames; the caller frees it.
static float *last_frame(struct rg_device *device, const char *settings)
{
    struct cartoon *c = rig_draw(device, settings, KEPT_PX, KEPT_PX);
    for (int i = 1; i < KEPT_FRAMES; i++)
        assert_true(c->base.technique->step(&c->base) && c->base.technique->draw(&c->base));
    float *texels = rig_texels(c->base.target);
    rig_close(c);
    return texels;
}

static void a_kept_picture_is_the_one_drawn_anew(void **state)
{
    static const char *const styles[] = {"style=gooch", "style=cartoon_outlines",
                                         "style=hatching spin_deg=40", "style=gooch spin_deg=40"};
    for (size_t i = 0; i < sizeof(styles) / sizeof(styles[0]); i++) {
        char settings[128];
        snprintf(settings, sizeof(settings), "scene=house2 redraw=moved %s", styles[i]);
        float *kept = last_frame(*state, settings);
        snprintf(settings, sizeof(settings), "scene=house2 redraw=always %s", styles[i]);
        float *drawn = last_frame(*state, settings);
        assert_memory_equal(kept, drawn, KEPT_PX * KEPT_PX * 4 * sizeof(*kept));
        // The middle is not black, and the spin turns it.
        assert_above(kept[4 * (KEPT_PX * KEPT_PX / 2 + KEPT_PX / 2)], 0);
        free(kept);
        free(drawn);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_hold_what_rays_meet),
        cmocka_unit_test(sheets_have_two_sides),
        cmocka_unit_test(gooch_is_cool_to_warm),
        cmocka_unit_test(cartoon_has_three_tones),
        cmocka_unit_test(outlines_are_ink_on_paper),
        cmocka_unit_test(hatching_mixes_tones_and_levels),
        cmocka_unit_test(a_kept_picture_is_the_one_drawn_anew),
    };
    return rig_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
