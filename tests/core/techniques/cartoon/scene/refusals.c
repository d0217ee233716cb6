// Scenes that cannot be drawn are refused in one line that says how to mend them. An open mesh can
// be drawn.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/core/techniques/cartoon/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"
#include "tests/tools/process/folder.h"

static int lines;

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)line;
    (void)user;
    lines += level == RG_LOG_ERROR;
}

static void expect_refused(struct rg_device *device, const char *settings, const char *why)
{
    void *set = settings_of("cartoon", "", settings);
    lines = 0;
    rg_log_listen(count_line, NULL);
    struct rg_instance *instance =
        rg_instance_open(rg_technique_find("cartoon"), device, set, 32, 32);
    rg_log_listen(NULL, NULL);
    assert_null(instance);
    assert_int_equal(lines, 1);
    if (!strstr(rg_last_error(), why))
        fail_msg("%s: \"%s\" does not say \"%s\"", settings, rg_last_error(), why);
    free(set);
}

static void cameras_are_refused(void **state)
{
    expect_refused(*state, "rise_deg=-60", "below the ground; raise rise_deg");
    expect_refused(*state, "scene=car zoom=12", "inside of something in the scene");
    expect_refused(*state, "scene=house1 zoom=9", "inside of something in the scene");
    expect_refused(*state, "scene=park1 rise_deg=71", "not along its up");
}

// Colours and shades are 0 to 1, by their parameters' rows; the message names the row.
static void colours_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"ink_r",   "ink_g",   "ink_b",      "paper_r",
                                        "paper_g", "paper_b", "glint_from", "shadow_blue"};
    const struct rg_technique *technique = rg_technique_find("cartoon");
    void *settings = rg_settings_create(technique);
    char text[64];
    for (int i = 0; i < 8; i++) {
        snprintf(text, sizeof(text), "%s=1.01", names[i]);
        assert_false(rg_params_set(technique->params, settings, text));
        assert_non_null(strstr(rg_last_error(), names[i]));
        assert_non_null(strstr(rg_last_error(), "out of range"));
        snprintf(text, sizeof(text), "%s=-0.01", names[i]);
        assert_false(rg_params_set(technique->params, settings, text));
    }
    assert_false(rg_params_set(technique->params, settings, "hatch_lit=2.1"));
    free(settings);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_at_least(fputs(text, file), 0);
    assert_int_equal(fclose(file), 0);
}

static void meshes_are_refused(void **state)
{
    char settings[400];
    expect_refused(*state, "scene=mesh mesh=", "no model is named");
    expect_refused(*state, "scene=mesh mesh=no/such.obj", "No such file");
    const char *path = in_folder("points.obj");
    snprintf(settings, sizeof(settings), "scene=mesh mesh=%s", path);
    write_text(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expect_refused(*state, settings, "points.obj");
    assert_int_equal(unlink(path), 0);
}

static void an_open_mesh_is_drawn(void **state)
{
    char settings[400];
    const char *path = in_folder("open.obj");
    snprintf(settings, sizeof(settings), "scene=mesh style=cartoon_outlines mesh=%s", path);
    write_text(path, "v -1 0 0\nv 1 0 0\nv 0 1 0\nv 0 2 1\nf 1 2 3\nf 3 2 4\n");
    struct cartoon *c = rig_draw(*state, settings, 64, 64);
    float *inks = rig_asset(c, "ink"), *normals = rig_asset(c, "normal_map");
    int inked = 0, seen = 0;
    for (int i = 0; i < 64 * 64; i++) {
        inked += inks[i] < 0.5f;
        seen += normals[4 * i + 3] > 0;
    }
    assert_above(inked, 60);
    assert_above(seen, 64 * 64 / 4);
    free(inks);
    free(normals);
    rig_close(c);
    assert_int_equal(unlink(path), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_are_refused),
        cmocka_unit_test(colours_are_refused),
        cmocka_unit_test(meshes_are_refused),
        cmocka_unit_test(an_open_mesh_is_drawn),
    };
    if (make_folder(NULL))
        return 1;
    const int status = rig_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    return remove_folder(NULL) ? 1 : status;
}
