// Figures: each has its own name, a caption, and settings that its technique takes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/figures/figures.h"
#include "tests/tools/expect.h"

// The figures to be drawn anew, without the letters of their parts.
static const char *const wanted[] = {
    "creus-4.1",     "creus-4.3",     "creus-4.4",     "creus-4.5",
    "creus-4.10",    "creus-4.11",    "creus-4.12",    "creus-4.13",
    "creus-4.14",    "creus-4.15",    "creus-4.16",    "creus-5.1",
    "creus-5.2",     "creus-5.3",     "creus-5.4",     "creus-5.5",
    "creus-5.6",     "creus-5.7",     "creus-5.8",     "stuppacher-4",
    "stuppacher-14", "stuppacher-15", "stuppacher-17", "stuppacher-18",
    "stuppacher-19", "stuppacher-20", "stuppacher-21", "chin-2",
    "chin-3",        "chin-4",        "chin-5",        "chin-6",
    "chin-7",        "feng-6",        "ye-3",          NULL};

static void test_settings_are_taken(void **state)
{
    (void)state;
    const struct rg_figure *figure;
    int count = 0;
    for (; (figure = rg_figure_at(count)); count++) {
        const struct rg_technique *technique = rg_technique_find(figure->technique);
        assert_ptr_equal(rg_figure_find(figure->id), figure);
        assert_non_null(technique);
        void *settings = rg_settings_create(technique);
        assert_true(rg_params_set_all(technique->params, settings, figure->settings));
        free(settings);
        assert_above(strlen(figure->caption), 15);
        assert_above(strlen(figure->printed), 15);
        assert_equals(!figure->parameter, !figure->ending);
        assert_equals(!figure->parameter, !(figure->text || figure->greys));
    }
    assert_above(count, 0);
    assert_null(rg_figure_find("creus-0.0"));
    assert_null(rg_figure_find("chin-4")); // a part of a name is none
    assert_null(rg_figure_find("chin-4aa"));
}

// Captions say how long after the one before a figure is.
static void test_later_figures_are_later(void **state)
{
    (void)state;
    static const struct later {
        const char *before, *after;
        int steps;
    } all[] = {{"chin-4a", "chin-4b", 30}, {"chin-6a", "chin-6b", 1}};
    for (int i = 0; i < 2; i++)
        assert_int_equal(rg_figure_find(all[i].after)->frame - rg_figure_find(all[i].before)->frame,
                         all[i].steps);
}

static void test_all_figures_are_there(void **state)
{
    (void)state;
    for (int i = 0; wanted[i]; i++) {
        const struct rg_figure *figure;
        const size_t length = strlen(wanted[i]);
        int found = 0;
        for (int k = 0; (figure = rg_figure_at(k)); k++) {
            const char *part = figure->id + length;
            found += !strncmp(figure->id, wanted[i], length) &&
                     (!*part || (*part >= 'a' && *part <= 'z' && !part[1]));
        }
        if (!found)
            fail_msg("figure %s is not there", wanted[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_settings_are_taken),
        cmocka_unit_test(test_all_figures_are_there),
        cmocka_unit_test(test_later_figures_are_later),
    };
    return cmocka_run_group_tests_name("figures", tests, NULL, NULL);
}
