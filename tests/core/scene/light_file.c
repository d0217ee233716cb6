// Files of lights, good and bad, and the lights of a scene without a file.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/scene/city/textures.h"
#include "core/techniques/scenery/lights/lights.h"
#include "core/techniques/scenery/scenery.h"
#include "tests/tools/expect.h"

static int errors;

static void count_error(enum rg_log_level level, const char *line, void *user)
{
    (void)line;
    (void)user;
    errors += level == RG_LOG_ERROR;
}

// --- files ---

static bool read_text(const char *text, struct rg_lights *lights)
{
    char path[] = "/tmp/lights-XXXXXX";
    const int fd = mkstemp(path);
    assert_at_least(fd, 0);
    assert_equals(write(fd, text, strlen(text)), (ssize_t)strlen(text));
    close(fd);
    errors = 0;
    const bool ok = rg_light_file_read(path, lights);
    unlink(path);
    if (!ok && !strstr(rg_last_error(), path))
        fail_msg("'%s' does not name the file", rg_last_error());
    return ok;
}

// Some editors begin a text with a byte order mark.
static void a_mark_is_no_part_of_a_file(void **state)
{
    (void)state;
    struct rg_lights lights;
    assert_true(read_text("\xef\xbb\xbf{\"lights\": [{\"type\": \"point\", "
                          "\"position_m\": [0, 1, 2], \"colour\": [1, 1, 1]}]}",
                          &lights));
    assert_int_equal(lights.count, 1);
    assert_false(read_text("\xef\xbb", &lights)); // half of the mark
}

static void a_file_says_all_of_its_lights(void **state)
{
    (void)state;
    struct rg_lights lights;
    assert_true(read_text(
        "{\"lights\": ["
        "{\"type\": \"sun\", \"direction\": [0, -3, 4], \"colour\": [1, 0.5, 0.25]},"
        "{\"type\": \"spot\", \"position_m\": [1, 2, 3], \"direction\": [0, -2, 0],"
        " \"colour\": [1, 1, 0.5], \"intensity\": 40, \"inner_deg\": 20, \"outer_deg\": 50,"
        " \"near_m\": 0.25, \"shadows\": false},"
        "{\"type\": \"point\", \"position_m\": [-1, 5.5, 1e2], \"colour\": [0, 0, 2],"
        " \"shadows\": true}],"
        "\"sky\": {\"colour\": [0.1, 0.2, 0.3], \"intensity\": 0.5}}",
        &lights));
    const struct rg_light *l = lights.lights;
    assert_int_equal(lights.count, 3);
    assert_int_equal(l[0].kind, SCENERY_SUN);
    assert_int_equal(l[1].kind, SCENERY_SPOT);
    assert_int_equal(l[2].kind, SCENERY_POINT);
    assert_float_equal(l[0].direction[1], -0.6f, 1e-7f);
    assert_float_equal(l[0].direction[2], 0.8f, 1e-7f);
    assert_equals(l[0].colour[0], 1);
    assert_equals(l[0].colour[1], 0.5f);
    assert_equals(l[0].colour[2], 0.25f);
    assert_true(l[0].shadows && !l[1].shadows && l[2].shadows);
    assert_equals(l[1].position_m[0], 1);
    assert_equals(l[1].position_m[1], 2);
    assert_equals(l[1].position_m[2], 3);
    assert_equals(l[1].direction[1], -1);
    assert_equals(l[1].colour[0], 40);
    assert_equals(l[1].colour[2], 20);
    assert_equals(l[1].inner_deg, 20);
    assert_equals(l[1].outer_deg, 50);
    assert_equals(l[1].near_m, 0.25f);
    assert_equals(l[2].position_m[2], 100);
    assert_equals(l[2].near_m, 0.1f);
    assert_above(l[0].outer_deg, l[0].inner_deg);
    assert_above(l[2].outer_deg, l[2].inner_deg);
    assert_float_equal(lights.sky[1], 0.1f, 1e-7f);
}

static void what_is_left_out_has_defaults(void **state)
{
    (void)state;
    struct rg_lights lights;
    assert_true(read_text("{\"lights\": [{\"type\": \"spot\", \"position_m\": [0, 0, 0],"
                          "\"direction\": [1, 0, 0], \"colour\": [1, 1, 1], \"outer_deg\": 20}]}",
                          &lights));
    assert_equals(lights.lights[0].inner_deg, 15);
    assert_true(lights.lights[0].shadows);
    assert_equals(lights.sky[0], 0);
    assert_equals(lights.sky[1], 0);
    assert_equals(lights.sky[2], 0);
}

#define SPOT(more)                                                                                 \
    "{\"lights\": [{\"type\": \"point\", \"position_m\": [0, 0, 0], \"colour\": [1, 1, 1]}, "      \
    "{\"type\": \"spot\", " more "}]}"
#define PLACED "\"position_m\": [0, 5, 0], "
#define AIMED  PLACED "\"direction\": [0, -1, 0], "
#define WHOLE  AIMED "\"colour\": [1, 1, 1], "

static void bad_files_are_refused_in_one_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says[2];
    } cases[] = {
        {"", {":1:0: ", "docs/lights.md"}},
        {"{\"lights\": [}", {":1:13: ", "docs/lights.md"}},
        {"{\n\"lights\": [],\n\"lights\": []}", {":3:8: ", "duplicate"}},
        {"[]", {": no lights", "{\"lights\": ["}},
        {"7", {":1:1: ", ""}},
        {"{}", {": no lights", ""}},
        {"{\"lights\": []}", {": no lights", ""}},
        {"{\"lights\": 3}", {": no lights", ""}},
        {"{\"lights\": [{}], \"clouds\": 1}", {"'clouds'", "lights and sky"}},
        {"{\"lights\": [3]}", {"light 1", "object"}},
        {"{\"lights\": [{}]}", {"light 1", "'type'"}},
        {SPOT("\"direction\": [0, -1, 0], \"colour\": [1, 1, 1]"), {"light 2", "'position_m'"}},
        {SPOT(PLACED "\"colour\": [1, 1, 1]"), {"light 2", "'direction'"}},
        {SPOT(AIMED "\"outer_deg\": 20"), {"light 2", "'colour' is missing"}},
        {SPOT(AIMED "\"colour\": [1, 1]"), {"light 2", "list of three"}},
        {SPOT(AIMED "\"colour\": 1"), {"light 2", "list of three"}},
        {SPOT(AIMED "\"colour\": [1, 1, \"1\"]"), {"light 2", "numbers alone"}},
        {SPOT(AIMED "\"colour\": [1, -1, 1]"), {"light 2", "'colour' holds -1"}},
        {SPOT(AIMED "\"colour\": [1, 1, 1e300]"), {"light 2", "'colour' holds 1e+300"}},
        {SPOT(AIMED "\"colour\": [1, 1, 1e999]"), {":1:", "overflow"}},
        {SPOT(PLACED "\"direction\": [0, 0, 0], \"colour\": [1, 1, 1]"),
         {"light 2", "no direction"}},
        {SPOT("\"position_m\": [0, 1e9, 0], \"direction\": [0, 1, 0], \"colour\": [1, 1, 1]"),
         {"light 2", "'position_m' holds 1e+09"}},
        {SPOT(WHOLE "\"intensity\": -2"), {"light 2", "'intensity' is -2"}},
        {SPOT(WHOLE "\"intensity\": true"), {"light 2", "'intensity' must be a number"}},
        {SPOT(WHOLE "\"outer_deg\": 85"), {"light 2", "'outer_deg' is 85"}},
        {SPOT(WHOLE "\"outer_deg\": 30, \"inner_deg\": 30"), {"light 2", "'inner_deg' is 30"}},
        {SPOT(WHOLE "\"near_m\": 0"), {"light 2", "'near_m' is 0"}},
        {SPOT(WHOLE "\"shadows\": 1"), {"light 2", "'shadows' must be true or false"}},
        {SPOT(WHOLE "\"color\": 1"), {"light 2", "'color' is no property"}},
        {"{\"lights\": [{\"type\": \"sun\", \"position_m\": [0, 0, 0]}]}",
         {"light 1", "a sun has no 'position_m'"}},
        {"{\"lights\": [{\"type\": \"point\", \"outer_deg\": 4}]}",
         {"light 1", "a point has no 'outer_deg'"}},
        {"{\"lights\": [{\"type\": \"point\", \"position_m\": [0, 0, 0], \"colour\": [1, 1, 1]}],"
         "\"sky\": {\"colour\": 4}}",
         {": sky: ", "list of three"}},
        {"{\"lights\": [{\"type\": \"point\", \"position_m\": [0, 0, 0], \"colour\": [1, 1, 1]}],"
         "\"sky\": {\"colour\": [1, 1, 1], \"intensty\": 4}}",
         {": sky: ", "'intensty' is no property of the sky"}},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_lights lights;
        if (read_text(cases[i].text, &lights))
            fail_msg("not refused: %s", cases[i].text);
        assert_int_equal(errors, 1);
        for (int k = 0; k < 2; k++)
            if (!strstr(rg_last_error(), cases[i].says[k]))
                fail_msg("'%s' does not say '%s'", rg_last_error(), cases[i].says[k]);
    }
}

static void there_are_sixteen_lights_at_most(void **state)
{
    (void)state;
    static const char one[] =
        "{\"type\": \"point\", \"position_m\": [0, 0, 0], \"colour\": [1, 1, 1]}";
    for (int count = 16; count <= 17; count++) {
        char text[4096] = "{\"lights\": [";
        struct rg_lights lights;
        for (int i = 0; i < count; i++)
            snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s%s", i ? "," : "", one);
        strcat(text, "]}");
        assert_equals(read_text(text, &lights), (count == 16));
        assert_true(count == 16 ? lights.count == 16 : !!strstr(rg_last_error(), "17 lights"));
    }
}

// Sixteen lights never need 256 KiB, so that a larger file is not parsed. Here white space follows
// a sound one.
static void files_are_of_256_kib_at_most(void **state)
{
    (void)state;
    enum { MOST = 1 << 18 };
    static const char lights_text[] =
        "{\"lights\": [{\"type\": \"sun\", \"direction\": [0, -1, 0], "
        "\"colour\": [1, 1, 1]}]}";
    char *text = malloc(MOST + 2);
    struct rg_lights lights;
    assert_non_null(text);
    memset(text, ' ', MOST + 2);
    memcpy(text, lights_text, sizeof(lights_text) - 1);
    text[MOST] = 0;
    assert_true(read_text(text, &lights));
    text[MOST] = ' ';
    text[MOST + 1] = 0;
    assert_false(read_text(text, &lights));
    assert_non_null(
        strstr(rg_last_error(), "has more than 256 KiB; name a file of at most 16 lights"));
    free(text);
}

static void what_is_no_file_is_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"/nonexistent/lights.json", "/", "/dev/zero"};
    struct rg_lights lights;
    for (int i = 0; i < 3; i++) {
        errors = 0;
        assert_false(rg_light_file_read(names[i], &lights));
        assert_int_equal(errors, 1);
        assert_non_null(strstr(rg_last_error(), names[i]));
    }
}

// --- presets ---

static const struct city_lamp lamps[] = {
    {CITY_TRAFFIC_GREEN, {3, 2, 0}, {1, 0, 0}, {0}},
    {CITY_STREET_LAMP, {40, 8, 0}, {0, -1, 0}, {0}},
    {CITY_STREET_LAMP, {10, 8, 0}, {0, -1, 0}, {0}},
    {CITY_STREET_LAMP, {-20, 8, 0}, {0, -1, 0}, {0}},
    {CITY_TRAFFIC_RED, {90, 2, 0}, {0, 0, 1}, {0}},
    {CITY_STREET_LAMP, {0, 8, 30}, {0, -1, 0}, {0}},
    {CITY_TRAFFIC_RED, {-50, 2, 0}, {0, 0, 1}, {0}},
    {CITY_TRAFFIC_RED, {-50, 2, 0}, {0, 0, -1}, {0}},
    {CITY_SIGN, {0, 4, 5}, {0, 0, 1}, {2, 0.7f, 0.2f}},
    {CITY_SIGN, {0, 4, 6}, {0, 0, 1}, {0.5f, 1, 1}},
    {CITY_HEADLIGHT, {4, 0.6f, 0}, {1, 0, 0}, {0}},
    {CITY_TRAFFIC_GREEN, {70, 2, 0}, {1, 0, 0}, {0}},
};
enum { LAMPS = sizeof(lamps) / sizeof(lamps[0]) };

// Each light's lamp; -1: the sun or moon.
static void check_lights(enum scenery_time time, const int *due, int count)
{
    const struct scenery_lights_settings settings = {
        .count = count, .time = time, .lamps = lamps, .lamp_count = LAMPS, .about_m = {0, 1, 0}};
    struct rg_lights lights;
    assert_true(scenery_lights_choose(&settings, &lights));
    assert_int_equal(lights.count, count);
    for (int i = 0; i < count; i++) {
        const struct rg_light *light = &lights.lights[i];
        assert_int_equal(light->kind, due[i] < 0 ? SCENERY_SUN : SCENERY_SPOT);
        assert_above(light->outer_deg, light->inner_deg);
        assert_true(light->shadows);
        const float *d = light->direction;
        assert_float_equal(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-6f);
        if (due[i] < 0)
            continue;
        assert_memory_equal(light->position_m, lamps[due[i]].position, sizeof(float[3]));
        assert_memory_equal(light->direction, lamps[due[i]].direction, sizeof(float[3]));
        const float *c = light->colour;
        assert_true(lamps[due[i]].kind != CITY_TRAFFIC_RED || c[0] > 4 * c[1]);
        assert_true(lamps[due[i]].kind != CITY_TRAFFIC_GREEN || c[1] > 4 * c[0]);
        const float *tint = lamps[due[i]].tint;
        assert_true(lamps[due[i]].kind != CITY_SIGN ||
                    fabsf(c[0] * tint[2] - c[2] * tint[0]) < 1e-4f);
    }
}

static void lights_come_in_the_order_of_the_figure(void **state)
{
    (void)state;
    static const int by_day[LAMPS + 1] = {-1, 2, 3, 5, 6, 0, 8, 7, 10, 9, 11, 4, 1};
    static const int by_night[LAMPS + 1] = {2, 3, 5, 6, 0, -1, 8, 7, 10, 9, 11, 4, 1};
    for (int count = 1; count <= LAMPS + 1; count++) {
        check_lights(SCENERY_DAY, by_day, count);
        check_lights(SCENERY_NIGHT, by_night, count);
    }
}

// As many lights as a time has unless they are counted: fewer where there are no more.
static void a_time_has_its_usual_lights(void **state)
{
    (void)state;
    static const int due[][2] = {{1, LAMPS + 1}, {1, 1}}; // by day and night, with lamps or none
    errors = 0;
    for (int i = 0; i < 4; i++) {
        const struct scenery_lights_settings settings = {.count = SCENERY_USUAL_LIGHTS,
                                                         .time = (enum scenery_time)(i % 2),
                                                         .lamps = lamps,
                                                         .lamp_count = i < 2 ? LAMPS : 0};
        struct rg_lights lights;
        assert_true(scenery_lights_choose(&settings, &lights));
        assert_int_equal(lights.count, due[i / 2][i % 2]);
    }
    assert_int_equal(errors, 0);
}

// --- photometry ---

static double luminance(const float c[3])
{
    return 0.2126 * (double)c[0] + 0.7152 * (double)c[1] + 0.0722 * (double)c[2];
}

// The solid angle that a light's cone fills as brightly as its middle.
static double cone_sr(const struct rg_light *l)
{
    enum { STEPS = 100000 };
    const double in = cos((double)l->inner_deg * M_PI / 180),
                 out = cos((double)l->outer_deg * M_PI / 180);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = fmin(fmax((cos(M_PI * (i + 0.5) / STEPS) - out) / (in - out), 0), 1);
        sum += t * t * (3 - 2 * t) * 2 * M_PI * sin(M_PI * (i + 0.5) / STEPS) * M_PI / STEPS;
    }
    return sum;
}

static struct rg_light only_light(enum city_lamp_kind kind)
{
    const struct city_lamp lamp = {kind, {0, 8, 0}, {0, -1, 0}, {1, 1, 1}};
    const struct scenery_lights_settings settings = {
        .count = SCENERY_USUAL_LIGHTS, .time = SCENERY_NIGHT, .lamps = &lamp, .lamp_count = 1};
    struct rg_lights lights;
    assert_true(scenery_lights_choose(&settings, &lights));
    assert_int_equal(lights.count, 2); // the other is the moon
    return lights.lights[lights.lights[0].kind == SCENERY_SUN];
}

// If a street lamp has 10,000 lm, other lamps have the candelas that docs/lights.md says.
static void lamps_have_real_strengths(void **state)
{
    (void)state;
    static const struct {
        enum city_lamp_kind kind;
        double low_cd, high_cd;
    } due[] = {{CITY_SIGN, 1440, 1500}, // 300 cd/m2, 7 m x 0.7 m
               {CITY_HEADLIGHT, 2900, 3100},
               {CITY_TRAFFIC_RED, 100, 400},
               {CITY_TRAFFIC_GREEN, 100, 800},
               {CITY_TAIL_LIGHT, 8, 34}};
    const struct rg_light lamp = only_light(CITY_STREET_LAMP);
    const double lamp_cd = 10000 / cone_sr(&lamp), cd = lamp_cd / luminance(lamp.colour);
    print_message("a street lamp: %.0f cd; a radiance of 1: %.2f cd/m2\n", lamp_cd, cd / M_PI);
    for (int i = 0; i < 5; i++) {
        const struct rg_light light = only_light(due[i].kind);
        print_message("kind %d: %.0f cd\n", (int)due[i].kind, cd * luminance(light.colour));
        assert_between(cd * luminance(light.colour), due[i].low_cd, due[i].high_cd);
    }
    // Rain 2 m before a sign, whose light is half a metre behind it, and 3.5 m below a lamp.
    const double sign_cd = cd * luminance(only_light(CITY_SIGN).colour);
    print_message("%.0f lx, %.0f lx\n", sign_cd / 2.5 / 2.5, lamp_cd / 3.5 / 3.5);
    assert_below(fabs(sign_cd / 2.5 / 2.5 / (lamp_cd / 3.5 / 3.5) - 1), 0.05);
}

// A sign's light has the colour of the sign as it is painted.
static void signs_have_their_colours(void **state)
{
    (void)state;
    const struct city_settings settings = {1, CITY_FULL};
    const size_t count = (size_t)CITY_TEXTURE_PX * CITY_TEXTURE_PX;
    uint32_t *texels = malloc(count * sizeof(*texels));
    struct city_painter *painter = city_painter_create(&settings);
    int lit = 0;
    assert_non_null(texels);
    assert_non_null(painter);
    for (int texture = PAINT_SHOP; texture < PAINT_WALL; texture++) {
        float sum[3] = {0}, tint[3];
        city_paint(painter, texture, texels);
        for (size_t i = 0; i < count; i++) {
            const double y = 1 - ((double)(i / CITY_TEXTURE_PX) + 0.5) / CITY_TEXTURE_PX;
            for (int c = 0; c < 3 && y > 0.74 && y < 0.9; c++) {
                const double root = (texels[i] >> 8 * c & 255) / 255.0;
                sum[c] += (float)(root * root * (texels[i] >> 24) / 255.0);
            }
        }
        assert_equals(city_shop_sign(&settings, texture, tint), luminance(sum) > 0);
        lit += luminance(sum) > 0;
        for (int c = 0; c < 3 && luminance(sum) > 0; c++)
            assert_below(fabs((double)tint[c] * luminance(sum) / (double)sum[c] - 1), 0.06);
    }
    assert_above(lit, 2);
    city_painter_destroy(painter);
    free(texels);
}

// The light of a shop's painted front by night, at 1 m before a lamp of its size and on a white
// surface that faces it: radiance x area / pi.
static double painted(const struct city_painter *painter, int texture, int channel)
{
    const double front_m2 = 7 * 4.4, glow = (double)scenery_night().glow;
    static uint32_t texels[CITY_SMALL_TEXTURE_PX * CITY_SMALL_TEXTURE_PX];
    const int count = sizeof(texels) / sizeof(texels[0]);
    double sum = 0;
    city_paint(painter, texture, texels);
    for (int i = 0; i < count; i++) {
        const double root = (texels[i] >> 8 * channel & 255) / 255.0;
        sum += root * root * (texels[i] >> 24) / 255.0;
    }
    return sum / count * glow * front_m2 / M_PI;
}

// Why painted windows are no lights of a scene: a street lamp has a hundred times as much.
static void shops_are_faint_beside_lamps(void **state)
{
    (void)state;
    static const struct city_lamp lamp = {CITY_STREET_LAMP, {0, 8, 0}, {0, -1, 0}, {0}};
    const struct scenery_lights_settings settings = {
        .count = 1, .time = SCENERY_NIGHT, .lamps = &lamp, .lamp_count = 1};
    struct rg_lights lights;
    assert_true(scenery_lights_choose(&settings, &lights));
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int seed = 1; seed <= 8; seed++) {
            struct city_painter *painter =
                city_painter_create(&(struct city_settings){seed, CITY_SMALL});
            assert_non_null(painter);
            for (int texture = PAINT_SHOP; texture < PAINT_WALL; texture++)
                sum += painted(painter, texture, c);
            city_painter_destroy(painter);
        }
        assert_below(sum / (8 * (PAINT_WALL - PAINT_SHOP)),
                     0.01 * (double)lights.lights[0].colour[c]);
    }
}

static void more_lights_than_lamps_are_refused(void **state)
{
    (void)state;
    struct scenery_lights_settings settings = {
        .count = LAMPS + 2, .lamps = lamps, .lamp_count = LAMPS};
    struct rg_lights lights;
    for (int time = SCENERY_DAY; time <= SCENERY_NIGHT; time++) {
        settings.time = (enum scenery_time)time;
        errors = 0;
        assert_false(scenery_lights_choose(&settings, &lights));
        assert_int_equal(errors, 1);
        assert_non_null(strstr(rg_last_error(), "ask for 13"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_says_all_of_its_lights),
        cmocka_unit_test(a_mark_is_no_part_of_a_file),
        cmocka_unit_test(what_is_left_out_has_defaults),
        cmocka_unit_test(bad_files_are_refused_in_one_line),
        cmocka_unit_test(there_are_sixteen_lights_at_most),
        cmocka_unit_test(files_are_of_256_kib_at_most),
        cmocka_unit_test(what_is_no_file_is_refused),
        cmocka_unit_test(lights_come_in_the_order_of_the_figure),
        cmocka_unit_test(a_time_has_its_usual_lights),
        cmocka_unit_test(lamps_have_real_strengths),
        cmocka_unit_test(signs_have_their_colours),
        cmocka_unit_test(shops_are_faint_beside_lamps),
        cmocka_unit_test(more_lights_than_lamps_are_refused),
    };
    rg_log_listen(count_error, NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
