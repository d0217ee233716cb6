// Sizes of textures, as a device tells them, without a device.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/kept.h"
#include "harness/tables/measuring/batch.h"

// --- stand-ins ---

static int opened;
static struct rg_image_desc told;
static int first_level;

const void *rg_batch_settings(struct rg_batch *batch, struct rg_place at)
{
    (void)at;
    return batch->table;
}

struct rg_device *rg_batch_device(const struct rg_batch *batch, int device)
{
    (void)batch;
    (void)device;
    return NULL;
}

struct rg_session *rg_kept_open(struct rg_kept *kept, struct rg_device *device,
                                const struct rg_subject *subject)
{
    (void)kept;
    (void)device;
    (void)subject;
    return opened ? (struct rg_session *)&opened : NULL;
}

bool rg_session_texture(const struct rg_session *session, const char *name,
                        struct rg_image_desc *desc, int *first)
{
    assert_ptr_equal(session, &opened);
    *desc = told;
    *first = first_level;
    return !strcmp(name, "tones");
}

// --- the test ---

static const struct rg_table levels_table = {
    .id = "levels",
    .technique = "cartoon",
    .hardware = "",
    .note = "",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"", "", NULL}},
    .works = {{"paper", "", ""}},
    .row_count = 3,
    .rows =
        (const struct rg_table_row[]){{"", {0}, "tones"}, {"", {3}, "tones"}, {"", {0}, "others"}},
};

// What a row says, until the next call.
static const char *told_of(int row)
{
    static char text[256];
    struct rg_device device = {.info = {.name = "gl"}};
    const struct rg_devices devices = {.count = 1, .devices = {&device}};
    const struct rg_table_part all = {.last_row = 2};
    struct rg_result result = {0};
    rg_table_begin(&result, &levels_table, &all, &devices);
    for (int r = 0; r < levels_table.row_count; r++)
        assert_true(rg_table_add_row(&result, &levels_table, r));
    struct rg_batch batch = {.result = &result, .table = &levels_table};
    const struct rg_place at = {.row = row};
    rg_batch_tell_texture(&batch, at);
    const struct rg_record *record = rg_result_at(&result, at);
    snprintf(text, sizeof(text), "%s%s%s", rg_outcome_name(record->outcome),
             *record->detail ? ": " : "", record->detail);
    for (int i = 0; i < record->fact_count; i++)
        snprintf(text + strlen(text), sizeof(text) - strlen(text), ", %s %g", record->facts[i].name,
                 record->facts[i].number);
    rg_result_free(&result);
    return text;
}

static void a_texture_tells_its_levels(void **state)
{
    (void)state;
    static const struct {
        int row, width, height, levels, first;
        const char *due;
    } rows[] = {
        {0, 64, 16, 7, 0, "ok, width_px 64, height_px 16"},
        {1, 64, 16, 7, 0, "ok, width_px 8, height_px 2"},
        {1, 16, 64, 7, 0, "ok, width_px 2, height_px 8"},
        {1, 16, 64, 7, 2, "ok, width_px 8, height_px 32"},
        {1, 16, 64, 4, 0, "ok, width_px 2, height_px 8"},
        {1, 16, 64, 3, 0, "fail: the texture ends with level 2"},
        {1, 16, 64, 2, 1, "fail: the texture ends with level 2"},
        {0, 64, 16, 7, 1, "unsupported: the texture is reduced, and begins with level 1"},
        {2, 64, 16, 7, 0, "error: cartoon has no texture 'others'"},
    };
    opened = 1;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        told = (struct rg_image_desc){
            .width = rows[i].width, .height = rows[i].height, .levels = rows[i].levels};
        first_level = rows[i].first;
        assert_string_equal(told_of(rows[i].row), rows[i].due);
    }
}

static void a_session_that_fails_ends_the_record(void **state)
{
    (void)state;
    rg_log_hold(true);
    opened = 0;
    rg_driver_error("it fell");
    assert_string_equal(told_of(0), "error: it fell");
    rg_log_hold(false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_texture_tells_its_levels),
        cmocka_unit_test(a_session_that_fails_ends_the_record),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
