#include "tests/core/techniques/streaks/rig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/image/format.h"
#include "tests/tools/expect.h"

#define SMALL                                                                                      \
    "atlas=small city=small depth_map_px=256 shadow_map_px=64 rain_width_m=60 rain_depth_m=60 "    \
    "rain_height_m=40 camera=free eye_y_m=3 culling_radius_m=12 drops_m2_s=60 streak_gain=20 "     \
    "view_angle_deg=70 far_layers=0 splash_fade=0 spectrum=off "

static const char *device_name = "cpu";
struct rg_device *rain_device;

struct streaks *rain_open(const char *settings)
{
    const struct rg_technique *technique = rg_technique_find("streaks");
    char all[1024];
    assert_between(snprintf(all, sizeof(all), SMALL "%s", settings), 0, sizeof(all) - 1);
    void *defaults = rg_settings_create(technique);
    void *copy = rg_settings_copy(technique, defaults, all);
    assert_non_null(copy);
    struct rg_instance *instance =
        rg_instance_open(technique, rain_device, copy, RAIN_WIDTH, RAIN_HEIGHT);
    assert_non_null(instance);
    free(copy);
    free(defaults);
    return (struct streaks *)instance;
}

void rain_close(struct streaks *s)
{
    rg_instance_close(&s->base);
}

void rain_step(struct streaks *s, int frames)
{
    for (int i = 0; i < frames; i++)
        assert_true(s->base.technique->step(&s->base));
}

struct rain_places rain_read_places(const struct streaks *s)
{
    struct rain_places places = {s->selection.block_count * STREAKS_BLOCK, NULL};
    const int64_t bytes = places.count * STREAKS_STATE_WORDS * 4;
    places.words = malloc((size_t)bytes);
    assert_non_null(places.words);
    assert_int_equal(s->base.state_count, 1);
    assert_true(rg_buf_read(s->base.state[0].asset->buf, 0, places.words, bytes));
    return places;
}

struct rain_texels *rain_read(struct streaks *s)
{
    struct rain_texels *picture = malloc(sizeof(*picture));
    assert_non_null(picture);
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_image_read(s->base.target, 0, 0, picture->halves));
    return picture;
}

struct rain_texels *rain_draw_at(const char *settings, int frames)
{
    struct streaks *s = rain_open(settings);
    rain_step(s, frames);
    struct rain_texels *picture = rain_read(s);
    rain_close(s);
    return picture;
}

double rain_texel(const struct rain_texels *picture, int x, int y, int colour)
{
    return (double)rg_unpack_half(picture->halves[4 * (y * RAIN_WIDTH + x) + colour]);
}

static struct streaks *shared;

// One instance stays open beside those of the tests, so that instances share one city and one
// atlas.
static int set_up(void **state)
{
    (void)state;
    rain_device = rg_device_open(device_name);
    if (!rain_device)
        return -1;
    shared = rain_open("");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    rain_close(shared);
    return rg_device_close(rain_device) ? 0 : -1;
}

int rain_tests_run(int argc, char **argv, const struct CMUnitTest *tests, int count)
{
    if (argc > 1)
        device_name = argv[1];
    return _cmocka_run_group_tests("streaks", tests, (size_t)count, set_up, tear_down);
}
