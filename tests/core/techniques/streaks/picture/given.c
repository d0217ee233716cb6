#include "tests/core/techniques/streaks/picture/given.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

// --- the atlas ---

static struct streak_atlas atlas;
static int first_level;
static uint16_t *texels[2][STREAK_OSCILLATIONS][STREAK_LEVELS];

static const uint16_t *read_level(struct rg_image *image, int which, int layer, int level)
{
    const int own = level - first_level;
    const size_t count = (size_t)(image->desc.width >> own) * (size_t)(image->desc.height >> own);
    uint16_t *to = texels[which][layer][level] = malloc(2 * count);
    assert_non_null(to);
    assert_true(rg_image_read(image, layer, own, to));
    return to;
}

// Reads the device's pictures, whose ends are joined, and the factors.
static void take_atlas(void)
{
    struct streaks *s = rain_open("");
    const struct streaks_textures *t = s->textures;
    float factors[STREAK_OSCILLATIONS * STREAK_VIEWS * (STREAK_HEIGHTS * STREAK_AZIMUTHS + 1)];
    assert_true(rg_buf_read(t->factors, 0, factors, sizeof(factors)));
    const float *next = factors;
    first_level = t->first_level;
    for (int i = 0; i < STREAK_OSCILLATIONS; i++) {
        for (int level = first_level; level < STREAK_LEVELS; level++) {
            atlas.points[i][level] = read_level(t->points, 0, i, level);
            atlas.skies[i][level] = read_level(t->skies, 1, i, level);
        }
        for (int k = 0; k < STREAK_VIEWS * STREAK_HEIGHTS * STREAK_AZIMUTHS; k++)
            (&atlas.point_factors[i][0][0][0])[k] = (double)*next++;
    }
    for (int k = 0; k < STREAK_OSCILLATIONS * STREAK_VIEWS; k++)
        (&atlas.sky_factors[0][0])[k] = (double)*next++;
    rain_close(s);
}

const struct streak_atlas *given_atlas(void)
{
    if (!first_level)
        take_atlas();
    return &atlas;
}

void given_atlas_free(void)
{
    for (int i = 0; i < 2 * STREAK_OSCILLATIONS * STREAK_LEVELS; i++)
        free((&texels[0][0][0])[i]);
}

// --- lights ---

static void write_light(FILE *file, const struct streak_light *l)
{
    static const char *const types[] = {"point", "spot", "sun"};
    fprintf(file, "{\"type\": \"%s\"", types[l->kind]);
    if (l->kind != STREAK_SUN)
        fprintf(file, ", \"position_m\": [%g, %g, %g]", l->at[0], l->at[1], l->at[2]);
    if (l->kind != STREAK_LAMP)
        fprintf(file, ", \"direction\": [%.12g, %.12g, %.12g]", l->direction[0], l->direction[1],
                l->direction[2]);
    if (l->kind == STREAK_SPOT)
        fprintf(file, ", \"inner_deg\": %g, \"outer_deg\": %g", l->inner_deg, l->outer_deg);
    fprintf(file, ", \"colour\": [%g, %g, %g], \"shadows\": false}", l->colour[0], l->colour[1],
            l->colour[2]);
}

int given_lights(const char *path, const struct streak_light *lights, int count, int chosen,
                 struct streak_light *written)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [");
    int next = 0;
    for (int i = 0; i < count; i++)
        if (chosen & 1 << i) {
            fprintf(file, "%s", next ? ", " : "");
            write_light(file, &lights[i]);
            written[next++] = lights[i];
        }
    fprintf(file, "]}\n");
    assert_int_equal(fclose(file), 0);
    return next;
}

// --- the view ---

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void make_unit(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

// The world's y is up in the picture. For a viewer along z, x is on the left.
static void look(struct streak_view *view, const struct streaks_settings *set)
{
    const double eye[3] = {set->eye_x_m, set->eye_y_m, set->eye_z_m};
    const double target[3] = {set->target_x_m, set->target_y_m, set->target_z_m};
    for (int i = 0; i < 3; i++) {
        view->eye[i] = eye[i];
        view->ahead[i] = target[i] - eye[i];
    }
    make_unit(view->ahead);
    cross(view->ahead, (double[]){0, 1, 0}, view->right);
    make_unit(view->right);
    cross(view->right, view->ahead, view->above);
    view->width = RAIN_WIDTH;
    view->height = RAIN_HEIGHT;
    view->focal_px = RAIN_HEIGHT / 2.0 / tan(set->view_angle_deg / 2 * pi / 180);
}

struct streak_view given_view(const struct streaks *s)
{
    struct streak_view view = {.taps = 2 << s->settings.taps,
                               .first_level = s->textures->first_level,
                               .last_level = s->settings.last_mip,
                               .absolute = s->settings.absolute_views,
                               .gain = s->settings.streak_gain,
                               .opacity = s->settings.streak_opacity};
    for (int c = 0; c < 3; c++)
        view.up[c] = -s->space.s[c];
    look(&view, &s->settings);
    return view;
}
