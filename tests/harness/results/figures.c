// Figures: each has its own name, a caption, and settings that its technique takes. They are drawn
// as the page beside them says.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/techniques/drops/drops.h"
#include "harness/devices/frames/frame.h"
#include "harness/tables/figures/figures.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

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

// By default drops leave beads. The paper's drops leave trails, which several captions tell of.
static void test_papers_trails_are_drawn(void **state)
{
    (void)state;
    const struct rg_figure *figure;
    int count = 0;
    for (int i = 0; (figure = rg_figure_at(i)); i++) {
        struct drops_settings settings;
        if (strcmp(figure->technique, "drops") != 0)
            continue;
        rg_params_reset(&drops_param_table, &settings);
        assert_int_equal(settings.trail, DROPS_TRAIL_BEADS);
        assert_true(rg_params_set_all(&drops_param_table, &settings, figure->settings));
        assert_int_equal(settings.trail, DROPS_HEMISPHERES);
        count++;
    }
    assert_int_equal(count, 13);
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

// --- drawing ---

// A model that mirrors do not show, so that any file will do.
#define CHEAP                                                                                      \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 "                   \
    "resolution_px=64 drops=40"

enum { SIDE = 4 };
static const float greys[SIDE * SIDE] = {0,    0.25f, 0.5f, 1, 0.125f, 0, 1,     1,
                                         0.5f, 0.5f,  0,    0, 1,      0, 0.25f, 0.75f};
static const struct rg_figure drawn[] = {{.id = "test-1",
                                          .technique = "flow",
                                          .settings = CHEAP,
                                          .frame = 3,
                                          .exposure = 2,
                                          .caption = "What is seen.",
                                          .printed = "In print"},
                                         {.id = "test-2b",
                                          .technique = "flow",
                                          .settings = CHEAP " seed=2",
                                          .frame = 1,
                                          .parameter = "model",
                                          .ending = ".exr",
                                          .greys = greys,
                                          .side_px = SIDE,
                                          .caption = "The same with other drops.",
                                          .printed = "Also in print"},
                                         {.id = "test-3",
                                          .technique = "flow",
                                          .settings = CHEAP,
                                          .frame = 2,
                                          .parameter = "model",
                                          .ending = ".obj",
                                          .text = "a text\n",
                                          .caption = "The same earlier.",
                                          .printed = "In print, too"}};

// The content of a file in the folder; the caller frees it.
static char *read_file(const char *name, size_t *size)
{
    char path[128], *text = calloc(1, 1 << 18);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    assert_true(text && file);
    *size = fread(text, 1, (1 << 18) - 1, file);
    fclose(file);
    return text;
}

// Draws a figure's frame by itself, and compares the files.
static void expect_picture(struct rg_device *device, const struct rg_figure *figure)
{
    const struct rg_technique *technique = rg_technique_find(figure->technique);
    void *settings = rg_settings_create(technique);
    char path[128], name[64];
    size_t size, due_size;
    assert_true(rg_params_set_all(technique->params, settings, figure->settings));
    const struct rg_subject subject = {technique, settings, 32, 16};
    struct rg_session *session = rg_session_run(device, &subject, figure->frame);
    snprintf(path, sizeof(path), "%s/due.png", folder);
    assert_non_null(session);
    assert_true(rg_frame_write(session, path, figure->exposure > 0 ? figure->exposure : 1));
    rg_session_close(session);
    free(settings);
    snprintf(name, sizeof(name), "%s.png", figure->id);
    char *found = read_file(name, &size), *due = read_file("due.png", &due_size);
    assert_int_equal(size, due_size);
    assert_memory_equal(found, due, size);
    free(found);
    free(due);
    unlink(path);
}

static void expect_text(const char *name, const char *due)
{
    size_t size;
    char *text = read_file(name, &size);
    assert_string_equal(text, due);
    free(text);
}

#define COMMAND(frame)                                                                             \
    "    raingauge render flow --frame " frame                                                     \
    " --size 32x16 --set view=pane --set panes=mirror --set environment=sky --set "                \
    "environment_px=16 --set reflection_px=16 --set resolution_px=64 --set drops=40 "
static const char page[] =
    "# Figures\n\nDrawn by raingauge on cpu. The scenes are not the papers'. Below each figure "
    "stand what is to be seen, and the paper's caption.\n"
    "\n![test-1](test-1.png)\n\n**test-1.** What is seen.\n\n> In print\n\n" COMMAND("3") //
    "--exposure 2 -o test-1.png\n"
    "\n![test-2b](test-2b.png)\n\n**test-2b.** The same with other drops.\n\n> Also in "
    "print\n\n" COMMAND("1") "--set seed=2 --set model=test-2b.exr -o test-2b.png\n"
                             "\n![test-3](test-3.png)\n\n**test-3.** The same earlier.\n\n> In "
                             "print, too\n\n" COMMAND("2") //
    "--set model=test-3.obj -o test-3.png\n";

static void expect_greys(void)
{
    char path[128];
    struct rg_picture picture;
    snprintf(path, sizeof(path), "%s/test-2b.exr", folder);
    assert_true(rg_picture_read(path, &picture));
    assert_int_equal(picture.width, SIDE);
    assert_int_equal(picture.height, SIDE);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_float_equal(picture.texels[i * picture.channels], greys[i], 0);
    rg_picture_destroy(&picture);
}

// Pictures are those that the page's commands draw, with the files that figures need.
static void test_drawn(void **state)
{
    (void)state;
    static const char *const names[] = {"test-1.png", "test-2b.png", "test-2b.exr",
                                        "test-3.png", "test-3.obj",  "figures.md"};
    const struct rg_figure *const figures[] = {&drawn[0], &drawn[1], &drawn[2]};
    struct rg_device *cpu = rg_device_open("cpu");
    assert_int_equal(make_folder(state), 0);
    const struct rg_figure_run run = {
        .device = cpu, .width = 32, .height = 16, .folder = folder, .figures = figures, .count = 3};
    assert_true(rg_figures_draw(&run));
    expect_text("figures.md", page);
    expect_text("test-3.obj", "a text\n");
    expect_greys();
    for (int i = 0; i < 3; i++)
        expect_picture(cpu, figures[i]);
    for (int i = 0; i < 6; i++) {
        char path[128];
        snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(remove_folder(state), 0);
    assert_true(rg_device_close(cpu));
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    snprintf(user, 512, "%s", line);
}

// A figure that cannot be drawn ends them all, and no page is written.
static void test_not_drawn(void **state)
{
    (void)state;
    struct rg_figure broken = drawn[0];
    const struct rg_figure *const figures[] = {&broken, &drawn[1]};
    struct rg_device *cpu = rg_device_open("cpu");
    char heard[512] = "";
    broken.settings = "nonsense=1";
    assert_int_equal(make_folder(state), 0);
    const struct rg_figure_run run = {
        .device = cpu, .width = 32, .height = 16, .folder = folder, .figures = figures, .count = 2};
    rg_log_listen(hear, heard);
    assert_false(rg_figures_draw(&run));
    rg_log_listen(NULL, NULL);
    assert_non_null(strstr(heard, "'nonsense'"));
    assert_int_equal(remove_folder(state), 0); // empty
    assert_true(rg_device_close(cpu));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_settings_are_taken),
        cmocka_unit_test(test_all_figures_are_there),
        cmocka_unit_test(test_papers_trails_are_drawn),
        cmocka_unit_test(test_later_figures_are_later),
        cmocka_unit_test(test_drawn),
        cmocka_unit_test(test_not_drawn),
    };
    return cmocka_run_group_tests_name("figures", tests, NULL, NULL);
}
