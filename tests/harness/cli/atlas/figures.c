// The comparison of an atlas with the database's pictures, from correlations that are made up: the
// figures of a set, the way that fits best, brightness, and the two printed forms.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/commands/drawing/atlas/compare.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/printed.h"

// Nine pictures of single lights, five of them from the front, one of light from everywhere, and
// one that is even.
enum { LIGHTS = 9, ENV = LIGHTS, FLAT, PICTURES };
static const double correlations[PICTURES] = {0.95, 0.91, 0.5, 0.7, 0.3, 0.85,
                                              0.65, 0.99, 0.2, 0.6, 0};
// Three lights have a factor. The logarithms correlate by 3 / sqrt(2 * 14 / 3).
static const double ours[PICTURES] = {1, 10, 100}, theirs[PICTURES] = {1, 100, 1000};

static struct rg_cave_row rows[PICTURES];
static const struct rg_cave_comparison all = {PICTURES, rows};

static int make_rows(void **state)
{
    (void)state;
    for (int i = 0; i < PICTURES; i++) {
        const double c = correlations[i];
        rows[i] = (struct rg_cave_row){.found = {.env = i == ENV,
                                                 .oscillation = i,
                                                 .view = i < 5 ? 0 : 3,
                                                 .light = 7,
                                                 .phi = 4,
                                                 .width = 16},
                                       .flat = i == FLAT,
                                       .correlation = {c - 0.4, c, c, c - 0.1},
                                       .ours = i == ENV ? 1e6 : ours[i],
                                       .theirs = i == ENV ? 1e-6 : theirs[i]};
        snprintf(rows[i].found.path, sizeof(rows[i].found.path), "/db/%c.png", 'a' + i);
    }
    return 0;
}

// --- figures ---

static void figures_are_of_a_set(void **state)
{
    (void)state;
    static const struct {
        int which, pictures;
        double median, above, worst;
        int worst_row;
    } due[] = {{RG_CAVE_LIGHTS, 9, 0.7, 3 / 9.0, 0.2, 8},
               {RG_CAVE_ENV, 1, 0.6, 0, 0.6, ENV},
               {0, 5, 0.7, 2 / 5.0, 0.3, 4},
               {3, 4, 0.75, 1 / 4.0, 0.2, 8}};
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++) {
        const struct rg_cave_figures f = rg_cave_figures(&all, due[i].which, RG_CAVE_MIRRORED);
        assert_int_equal(f.pictures, due[i].pictures);
        assert_below(fabs(f.median - due[i].median), 1e-12);
        assert_below(fabs(f.above - due[i].above), 1e-12);
        assert_equals(f.worst, due[i].worst);
        assert_ptr_equal(f.worst_row, &rows[due[i].worst_row]);
    }
    const struct rg_cave_figures none = rg_cave_figures(&all, 1, RG_CAVE_MIRRORED);
    assert_int_equal(none.pictures, 0);
    assert_equals(fabs(none.median) + fabs(none.above) + fabs(none.worst), 0);
    assert_null(none.worst_row);
}

// The first of equals; single lights decide, and light from everywhere where there are none.
static void the_best_way_is_the_first_of_equals(void **state)
{
    (void)state;
    assert_int_equal(rg_cave_best(&all), RG_CAVE_MIRRORED);
    struct rg_cave_row everywhere = rows[ENV];
    const double of_env[RG_CAVE_WAYS] = {0.1, 0.2, 0.5, 0.5};
    memcpy(everywhere.correlation, of_env, sizeof(of_env));
    const struct rg_cave_comparison alone = {1, &everywhere}, even = {1, &rows[FLAT]};
    assert_int_equal(rg_cave_best(&alone), RG_CAVE_OTHER_SIDE);
    assert_int_equal(rg_cave_best(&even), RG_CAVE_AS_IT_IS);
}

// Neither light from everywhere nor pictures without a factor count, and two are too few.
static void brightness_is_that_of_single_lights(void **state)
{
    (void)state;
    int pictures = -1;
    assert_below(fabs(rg_cave_brightness(&all, &pictures) - 3 / sqrt(2 * 14 / 3.0)), 1e-12);
    assert_int_equal(pictures, 3);
    const struct rg_cave_comparison two = {2, rows};
    assert_true(isnan(rg_cave_brightness(&two, &pictures)));
    assert_int_equal(pictures, 2);
}

// --- printed ---

// Prints a comparison, and returns the text, which stays until the next call.
static const char *printed(const struct rg_cave_comparison *comparison, bool json)
{
    const struct rg_atlas atlas = {.hash = 0xabcdef};
    printed_begin();
    rg_cave_print(comparison, &atlas, "/db", json);
    return printed_end();
}

// The same with a blank for each run of them.
static const char *squeezed(const struct rg_cave_comparison *comparison)
{
    static char text[1 << 14];
    char *to = text;
    for (const char *from = printed(comparison, false); *from; from++)
        if (*from != ' ' || from[1] != ' ')
            *to++ = *from;
    *to = 0;
    return text;
}

static void the_text_has_all_figures(void **state)
{
    (void)state;
    assert_string_equal(
        squeezed(&all),
        "11 pictures of /db beside ours, correlation of all pixels\n"
        "\nsingle lights pictures median above 0.9 worst\n"
        "as they are 9 0.300 0.0 % -0.200 i.png\n"
        "mirrored 9 0.700 33.3 % 0.200 i.png\n"
        "light on the other side 9 0.700 33.3 % 0.200 i.png\n"
        "drop swings to the other side 9 0.600 0.0 % 0.100 i.png\n"
        "\nmirrored pictures median above 0.9 worst\n"
        "view at 0 degrees 5 0.700 40.0 % 0.300 e.png\n"
        "view at 60 degrees 4 0.750 25.0 % 0.200 i.png\n"
        "light from everywhere 1 0.600 0.0 % 0.600 j.png\n"
        "\nleast alike: i.png 0.200, e.png 0.300, c.png 0.500, j.png 0.600, g.png 0.650, d.png "
        "0.700, f.png 0.850, b.png 0.910\n"
        "mean brightness: correlation of the logarithms 0.982, 3 pictures\n"
        "1 pictures are even, theirs or ours, and have no correlation\n");
    const struct rg_cave_comparison two = {2, rows}, even = {1, &rows[FLAT]};
    assert_non_null(strstr(squeezed(&two),
                           "\nleast alike: b.png 0.910, a.png 0.950\nmean brightness: not "
                           "compared; the factors are in dcam00_point_max.txt and so on\n"));
    assert_null(strstr(squeezed(&two), "are even"));
    assert_null(strstr(squeezed(&even), "least alike"));
}

static void expect_figures(const json_t *array, size_t at, const char *key, const char *name,
                           const char *worst)
{
    const char *named, *picture;
    double median, above, least;
    json_int_t pictures;
    assert_int_equal(0, json_unpack(json_array_get(array, at), "{ss, sI, sF, sF, sF, ss!}", key,
                                    &named, "pictures", &pictures, "median", &median, "above_0_9",
                                    &above, "worst", &least, "worst_picture", &picture));
    assert_string_equal(named, name);
    assert_string_equal(picture, worst);
}

static void expect_picture(const json_t *picture, const char *name, int view_deg, bool has_factor)
{
    const char *named;
    json_int_t width, oscillation, view, light, phi;
    assert_int_equal(0, json_unpack((json_t *)picture, "{ss, sI, sI, sI, sI, sI}", "picture",
                                    &named, "width", &width, "oscillation", &oscillation,
                                    "view_deg", &view, "light_deg", &light, "phi_deg", &phi));
    assert_string_equal(named, name);
    assert_equals(width, 16);
    assert_equals(oscillation, *name - 'a');
    assert_equals(view, view_deg);
    assert_equals(light, 20 * 7 - 90);
    assert_equals(phi, 20 * 4 + 10);
    const double mean = json_real_value(json_object_get(picture, "ours")),
                 other = json_real_value(json_object_get(picture, "theirs"));
    assert_equals(mean, has_factor ? ours[*name - 'a'] : 0);
    assert_equals(other, has_factor ? theirs[*name - 'a'] : 0);
    assert_int_equal(json_is_null(json_object_get(picture, "ours")), !has_factor);
    assert_int_equal(json_is_null(json_object_get(picture, "theirs")), !has_factor);
}

static void expect_correlations(const json_t *picture, int row)
{
    static const char *const ways[RG_CAVE_WAYS] = {"as_it_is", "mirrored", "other_side",
                                                   "other_drop"};
    const json_t *correlation = json_object_get(picture, "correlation");
    for (int way = 0; way < RG_CAVE_WAYS; way++) {
        const json_t *value = json_object_get(correlation, ways[way]);
        assert_int_equal(json_is_null(value), row == FLAT);
        assert_below(fabs(json_real_value(value) - rows[row].correlation[way] * (row != FLAT)),
                     1e-8);
    }
}

static void json_has_all_pictures(void **state)
{
    (void)state;
    const char *folder, *hash, *best;
    json_t *ways, *sets, *pictures, *json = json_loads(printed(&all, true), 0, NULL);
    json_int_t format, flat, compared;
    double brightness;
    assert_int_equal(0,
                     json_unpack(json, "{sI, ss, ss, so, ss, so, sI, s{sI, sF}, so!}", "format",
                                 &format, "folder", &folder, "hash", &hash, "ways", &ways, "best",
                                 &best, "sets", &sets, "flat", &flat, "brightness", "pictures",
                                 &compared, "correlation", &brightness, "pictures", &pictures));
    assert_string_equal(folder, "/db");
    assert_string_equal(hash, "0000000000abcdef");
    assert_string_equal(best, "mirrored");
    assert_equals(flat, 1);
    assert_equals(compared, 3);
    assert_below(fabs(brightness - 3 / sqrt(2 * 14 / 3.0)), 1e-8);
    assert_int_equal(json_array_size(ways), RG_CAVE_WAYS);
    expect_figures(ways, 3, "way", "other_drop", "i.png");
    assert_int_equal(json_array_size(sets), 3);
    expect_figures(sets, 0, "set", "view 0", "e.png");
    expect_figures(sets, 1, "set", "view 60", "i.png");
    expect_figures(sets, 2, "set", "everywhere", "j.png");
    assert_int_equal(json_array_size(pictures), PICTURES);
    expect_picture(json_array_get(pictures, 2), "c.png", 0, true);
    expect_picture(json_array_get(pictures, 5), "f.png", 60, false);
    assert_true(json_is_null(json_object_get(json_array_get(pictures, ENV), "light_deg")));
    assert_true(json_is_null(json_object_get(json_array_get(pictures, ENV), "phi_deg")));
    for (int i = 0; i < PICTURES; i++)
        expect_correlations(json_array_get(pictures, (size_t)i), i);
    json_decref(json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_are_of_a_set),
        cmocka_unit_test(the_best_way_is_the_first_of_equals),
        cmocka_unit_test(brightness_is_that_of_single_lights),
        cmocka_unit_test(the_text_has_all_figures),
        cmocka_unit_test(json_has_all_pictures),
    };
    return cmocka_run_group_tests(tests, make_rows, NULL);
}
