// Figures: each has its own name, a caption, and settings that its technique takes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/figures/figures.h"
#include "tests/tools/expect.h"

// The figures to be drawn anew.
static const char *const creus[] = {"4.1", "4.4", "4.11", "4.13", "4.14", "4.15", "4.16", "5.2",
                                    "5.3", "5.4", "5.5",  "5.6",  "5.7",  "5.8",  NULL};

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
        assert_above(strlen(figure->caption), 20);
        assert_equals(!figure->parameter, !figure->ending);
        assert_equals(!figure->parameter, !(figure->text || figure->greys));
    }
    assert_above(count, 0);
    assert_null(rg_figure_find("creus-0.0"));
}

static void test_all_figures_are_there(void **state)
{
    (void)state;
    for (int i = 0; creus[i]; i++) {
        const struct rg_figure *figure;
        const size_t length = strlen(creus[i]);
        int found = 0;
        for (int k = 0; (figure = rg_figure_at(k)); k++) {
            const char *number = figure->id + strlen("creus-");
            found += !strncmp(figure->id, "creus-", strlen("creus-")) &&
                     !strncmp(number, creus[i], length) && strlen(number + length) <= 1 &&
                     !strchr("0123456789", number[length] ? number[length] : 'a');
        }
        if (!found)
            fail_msg("figure %s is not there", creus[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_settings_are_taken),
        cmocka_unit_test(test_all_figures_are_there),
    };
    return cmocka_run_group_tests_name("figures", tests, NULL, NULL);
}
