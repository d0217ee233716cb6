#include "tests/core/techniques/shower/rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static const char *device_name = "cpu";
struct rg_device *pour_device;

struct shower *pour_open(const char *settings, int width, int height)
{
    return (struct shower *)instance_of(pour_device, "shower", "geometry=off", settings, width,
                                        height);
}

void pour_close(struct shower *s)
{
    rg_instance_close(&s->base);
}

void pour_step(struct shower *s, int steps)
{
    for (int i = 0; i < steps; i++)
        assert_true(s->base.technique->step(&s->base));
}

void *pour_words(struct shower *s, const char *name)
{
    return asset_words(&s->base, name);
}

struct oracle_drop *pour_read(struct shower *s)
{
    const int slots = s->params.slots;
    float *words = pour_words(s, "particles");
    struct oracle_drop *drops = malloc((size_t)slots * sizeof(*drops));
    assert_non_null(drops);
    for (int i = 0; i < slots; i++)
        drops[i] = (struct oracle_drop){(double)words[i], (double)words[slots + i],
                                        (double)words[2 * slots + i], (double)words[3 * slots + i]};
    free(words);
    return drops;
}

float *pour_attributes(struct shower *s, int plane)
{
    const int64_t bytes = (int64_t)s->params.slots * 4;
    float *words = malloc((size_t)bytes);
    assert_non_null(words);
    assert_true(rg_buf_read(s->attributes->buf, plane * bytes, words, bytes));
    return words;
}

static void put_plane(struct shower *s, struct rg_asset *asset, int plane, const float *words)
{
    const int64_t bytes = (int64_t)s->params.slots * 4;
    assert_true(rg_buf_write(asset->buf, plane * bytes, words, bytes));
}

void pour_put(struct shower *s, const struct oracle_drop *drops, int count)
{
    float *words = calloc((size_t)s->params.slots, sizeof(*words));
    assert_non_null(words);
    assert_between(count, 0, s->params.slots);
    for (int plane = 0; plane < 4; plane++) {
        for (int i = 0; i < count; i++)
            words[i] = (float)(plane == 0   ? drops[i].x
                               : plane == 1 ? drops[i].y
                               : plane == 2 ? drops[i].z
                                            : drops[i].fall_m_s);
        put_plane(s, s->particles, plane, words);
    }
    for (int plane = 0; s->params.is_full && plane < SHOWER_ATTRIBUTES; plane++) {
        for (int i = 0; i < count; i++)
            words[i] = plane == SHOWER_AY ? -(float)s->settings.gravity_m_s2 : 0;
        put_plane(s, s->attributes, plane, words);
    }
    const uint32_t alive = (uint32_t)count;
    assert_true(rg_buf_write(s->counts->buf, SHOWER_ALIVE * 4, &alive, sizeof(alive)));
    free(words);
}

uint32_t pour_tally(struct shower *s, int word)
{
    uint32_t value;
    assert_true(rg_buf_read(s->counts->buf, word * 4, &value, sizeof(value)));
    return value;
}

// The parts that each system has, by the paper; a switch overrides it.
static bool is_improved(const struct shower *s, int choice)
{
    return choice == 2 || (choice == 0 && s->settings.system == 1);
}

struct oracle_rain pour_oracle(const struct shower *s)
{
    const struct shower_settings *set = &s->settings;
    const struct rg_image_desc *d = &s->base.target->desc;
    const double frame = (double)s->base.frame, pi = acos(-1);
    const double before_s = set->step_s * (frame - 1), walked = set->walk_m_s * set->step_s * frame;
    const double speed = set->wind_m_s * (1 + set->gust * sin(2 * pi * before_s / set->gust_s));
    const double heading = set->heading_deg * pi / 180, beta = set->view_angle_deg * pi / 180;
    return (struct oracle_rain){
        .step_s = set->step_s,
        .wind_x = speed * cos(set->wind_deg * pi / 180),
        .wind_z = speed * sin(set->wind_deg * pi / 180),
        .fall_m_s = set->fall_m_s,
        .gravity_m_s2 = set->gravity_m_s2,
        .accelerates = !is_improved(s, set->motion),
        .is_layered = is_improved(s, set->layers),
        .tests_corners = !is_improved(s, set->crop),
        .eye = {set->eye_x_m - walked * sin(heading), set->eye_y_m,
                set->eye_z_m - walked * cos(heading)},
        .heading = heading,
        .alpha = 2 * atan(tan(beta / 2) * d->width / d->height),
        .beta = beta,
        .near_m = set->near_m,
        .far_m = oracle_farthest(set->drop_height_m, beta, d->height),
        .height_m = set->drop_height_m,
        .width_m = set->drop_width_m,
        .width_px = d->width,
        .height_px = d->height,
    };
}

double pour_sky(int colour)
{
    const struct scenery_look day = scenery_day();
    const float sky[] = {day.sky.horizon_r, day.sky.horizon_g, day.sky.horizon_b};
    return (double)sky[colour];
}

double pour_light(const struct shower *s, int colour)
{
    const struct scenery_look day = scenery_day();
    const float sky[] = {day.sky.zenith_r, day.sky.zenith_g, day.sky.zenith_b};
    return s->settings.light * (double)sky[colour];
}

void pour_expect(const char *what, double found, double due, double off)
{
    if (!(fabs(found - due) <= off))
        fail_msg("%s: %.9g, not %.9g within %.3g", what, found, due, off);
}

static int set_up(void **state)
{
    (void)state;
    pour_device = rg_device_open(device_name);
    return pour_device ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    return rg_device_close(pour_device) ? 0 : -1;
}

int pour_tests_run(int argc, char **argv, const struct CMUnitTest *tests, int count)
{
    if (argc > 1)
        device_name = argv[1];
    return _cmocka_run_group_tests("shower", tests, (size_t)count, set_up, tear_down);
}
