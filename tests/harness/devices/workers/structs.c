// What devices, sessions and runs tell of themselves passes between processes whole: every struct
// of a message comes out as it was put in.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/device/pass.h"
#include "harness/devices/frames/messages.h"
#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/serving/messages.h"
#include "harness/devices/measure/timer_audit.h"
#include "harness/devices/workers/device.h"
#include "tests/tools/expect.h"

// Puts a struct and takes it into another one, which is zeroed before.
static void pass(const struct rg_field *fields, const void *put, void *taken, size_t size)
{
    struct rg_message message = {0};
    memset(taken, 0, size);
    rg_put_fields(&message, fields, put);
    assert_true(rg_take_fields(&message, fields, taken));
    assert_int_equal(message.at, message.size);
    rg_message_free(&message);
}

// The same for a struct without pointers, all of which comes out.
#define PASSES(fields, put, taken)                                                                 \
    do {                                                                                           \
        pass(fields, &(put), &(taken), sizeof(taken));                                             \
        assert_memory_equal(&(put), &(taken), sizeof(taken));                                      \
    } while (0)

// --- devices ---

static void fill_limits(struct rg_limits *limits)
{
    limits->max_objects = 11;
    limits->max_buffer_bytes = INT64_C(12) << 32;
    limits->max_image_px = 13;
    limits->max_image_layers = 14;
    for (int i = 0; i < 3; i++)
        limits->max_groups[i] = 15 + i;
    limits->group_items = 18;
    for (int i = 0; i < RG_FORMAT_COUNT; i++) {
        struct rg_format_limits *format = &limits->formats[i];
        format->uses = 100u + (unsigned)i;
        format->max_px = 200 + i;
        format->max_layers = 300 + i;
        format->max_levels = 400 + i;
        format->max_bytes = (INT64_C(1) << 40) + i;
    }
    limits->slot_count = (struct rg_slot_limits){21, 22, 23};
    limits->slot_end = (struct rg_slot_limits){24, 25, 26};
    strcpy(limits->no_draws, "has no queue");
    limits->has_clock = true;
    limits->has_queries = true;
    strcpy(limits->no_native, "lacks a shader");
}

static void fill_info(struct rg_device_info *info)
{
    strcpy(info->name, "new");
    strcpy(info->full, "gl@A=1");
    strcpy(info->device, "a device");
    strcpy(info->driver, "a driver");
    strcpy(info->api, "an API");
    for (int i = 0; i < RG_DRIVER_LIBRARIES; i++) {
        struct rg_library *library = &info->libraries[i];
        library->path[0] = library->build[0] = (char)('a' + i);
        library->device = UINT64_MAX - (uint64_t)i;
        library->inode = UINT64_MAX / 2 + (uint64_t)i;
    }
    info->software = true;
    info->native = true;
    info->features = RG_FEATURE_ALL;
    info->tier = RG_T2;
    fill_limits(&info->limits);
}

static void a_device_tells_all_of_itself(void **state)
{
    (void)state;
    static struct rg_told_device put, taken;
    fill_info(&put.info);
    put.backend = 3;
    PASSES(rg_told_device_fields, put, taken);
}

static void a_list_tells_each_device_or_why_there_is_none(void **state)
{
    (void)state;
    static struct rg_told_list put, taken;
    put.count = 2;
    for (int i = 0; i < 2; i++) {
        fill_info(&put.infos[i]);
        put.infos[i].name[0] = (char)('0' + i);
    }
    PASSES(rg_told_list_fields, put, taken);
    memset(&put, 0, sizeof(put));
    put.outcome = RG_SETUP;
    strcpy(put.why, "no driver");
    PASSES(rg_told_list_fields, put, taken);
}

static void measurements_pass_but_what_follows_from_them(void **state)
{
    (void)state;
    const struct rg_drawing drawing = {
        .count = 2, .formats = {{RG_RGBA8, 5}, {RG_RGBA32F, 6}}, .ms = 7};
    const struct rg_ceilings ceilings = {1, 2, 3};
    struct rg_timer_audit audit, of_audit;
    struct rg_drawing of_drawing;
    struct rg_ceilings of_ceilings;
    memset(&audit, 0, sizeof(audit));
    audit.passes = 1;
    audit.wall_ms = 2;
    audit.has_timer = true;
    audit.api_ms = -3;
    audit.ratio = -4;
    audit.sync_us = 5;
    audit.dispatch_us = 6;
    audit.round_trip_us = 7;
    PASSES(rg_audit_fields, audit, of_audit);
    pass(rg_drawing_fields, &drawing, &of_drawing, sizeof(of_drawing));
    assert_int_equal(of_drawing.count, 2);
    assert_memory_equal(of_drawing.formats, drawing.formats, sizeof(drawing.formats));
    assert_equals(of_drawing.ms, 7);
    PASSES(rg_ceilings_fields, ceilings, of_ceilings);
}

// --- sessions ---

static void a_session_tells_its_numbers(void **state)
{
    (void)state;
    const struct rg_told_session session = {7, 3};
    const struct rg_tally tally = {1, 2, 3, 4, -1, 6, 7, 8, 9, 10};
    const double ms = 0.5;
    const int64_t time = INT64_MIN;
    struct rg_told_session of_session;
    struct rg_tally of_tally;
    double of_ms;
    int64_t of_time;
    PASSES(rg_told_session_fields, session, of_session);
    PASSES(rg_told_tally_fields, tally, of_tally);
    PASSES(rg_ms_fields, ms, of_ms);
    PASSES(rg_time_fields, time, of_time);
    struct rg_session_code code, of_code;
    memset(&code, 0, sizeof(code));
    strcpy(code.program, "0123");
    code.libraries = UINT64_MAX;
    code.passes.hash = UINT64_MAX - 1;
    code.passes.bytes = 12;
    PASSES(rg_told_code_fields, code, of_code);
    struct rg_told_law law, of_law;
    memset(&law, 0, sizeof(law));
    law.holds = true;
    strcpy(law.detail, "it holds");
    PASSES(rg_told_law_fields, law, of_law);
    struct rg_told_texture texture, of_texture;
    memset(&texture, 0, sizeof(texture));
    texture.is_found = true;
    texture.desc = (struct rg_image_desc){RG_R16F, 8, 4, 6, 3};
    texture.first_level = 2;
    PASSES(rg_told_texture_fields, texture, of_texture);
}

static void an_account_and_stages_keep_their_names(void **state)
{
    (void)state;
    struct rg_told_stage rows[] = {{"stir", 1.5}, {"show", 2.5}};
    const struct rg_told_stages stages = {.count = 2, .rows = rows};
    struct rg_told_stages of_stages;
    static struct rg_account account, of_account;
    account.frame = -1;
    account.counter_count = 1;
    account.counters[0] = (struct rg_counter){"drops", INT64_MIN};
    account.fact_count = 2;
    account.facts[0] = (struct rg_fact){.name = "model", .text = "bunny"};
    account.facts[1] = (struct rg_fact){.name = "faces", .number = 0.25};
    pass(rg_told_stages_fields, &stages, &of_stages, sizeof(of_stages));
    assert_int_equal(of_stages.count, 2);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(of_stages.rows[i].kernel, rows[i].kernel);
        assert_equals(of_stages.rows[i].ms, rows[i].ms);
    }
    rg_free_fields(rg_told_stages_fields, &of_stages);
    pass(rg_told_account_fields, &account, &of_account, sizeof(of_account));
    assert_int_equal(of_account.frame, -1);
    assert_int_equal(of_account.counter_count, 1);
    assert_string_equal(of_account.counters[0].name, "drops");
    assert_true(of_account.counters[0].value == INT64_MIN);
    assert_int_equal(of_account.fact_count, 2);
    assert_string_equal(of_account.facts[0].name, "model");
    assert_string_equal(of_account.facts[0].text, "bunny");
    assert_string_equal(of_account.facts[1].name, "faces");
    assert_equals(of_account.facts[1].number, 0.25);
}

// --- contents ---

static void bytes_and_contents_have_their_layout(void **state)
{
    (void)state;
    static unsigned char texels[2 * 3 * 2 * 4] = {1, 2, 3};
    const struct rg_state layout = {.name = "water", .row = 5, .margin = 1, .words = "fui"};
    const struct rg_told_bytes bytes = {.bytes = texels, .size = 7, .layout = layout};
    const struct rg_told_contents contents = {
        .contents = {{RG_RGBA8, 2, 3, 2, 1}, sizeof(texels), texels}, .state = layout};
    struct rg_told_bytes of_bytes;
    struct rg_told_contents of_contents;
    pass(rg_told_bytes_fields, &bytes, &of_bytes, sizeof(of_bytes));
    pass(rg_told_contents_fields, &contents, &of_contents, sizeof(of_contents));
    assert_int_equal(of_bytes.size, 7);
    assert_memory_equal(of_bytes.bytes, texels, 7);
    assert_int_equal(of_contents.contents.size, sizeof(texels));
    assert_memory_equal(of_contents.contents.bytes, texels, sizeof(texels));
    assert_memory_equal(&of_contents.contents.desc, &contents.contents.desc,
                        sizeof(contents.contents.desc));
    const struct rg_state *const told[] = {&of_bytes.layout, &of_contents.state};
    for (int i = 0; i < 2; i++) {
        assert_string_equal(told[i]->name, "water");
        assert_string_equal(told[i]->words, "fui");
        assert_int_equal(told[i]->row, 5);
        assert_int_equal(told[i]->margin, 1);
    }
    rg_free_fields(rg_told_bytes_fields, &of_bytes);
    rg_free_fields(rg_told_contents_fields, &of_contents);
}

static void digests_pass_row_by_row(void **state)
{
    (void)state;
    struct rg_digest rows[2];
    memset(rows, 0, sizeof(rows));
    for (int i = 0; i < 2; i++) {
        rows[i].frame = 10 + i;
        rows[i].stages_run = 20 + i;
        rows[i].stage[0] = (char)('s' + i);
        rows[i].asset[0] = (char)('a' + i);
        rows[i].hash = UINT64_MAX - (uint64_t)i;
        rows[i].weight = 30 + i;
    }
    const struct rg_digests digests = {.count = 2, .rows = rows};
    struct rg_digests taken;
    pass(rg_told_digests_fields, &digests, &taken, sizeof(taken));
    assert_int_equal(taken.count, 2);
    assert_memory_equal(taken.rows, rows, sizeof(rows));
    rg_digests_free(&taken);
}

// --- requests and dispatches ---

static void a_run_is_asked_for_with_its_row(void **state)
{
    (void)state;
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = rg_settings_create(technique);
    const struct rg_asked_run run = {{{technique, settings, 48, 32}, 7}, 5};
    struct rg_asked_run of_run;
    pass(rg_asked_run_fields, &run, &of_run, sizeof(of_run));
    assert_ptr_equal(of_run.run.subject.technique, technique);
    assert_int_equal(of_run.run.subject.width, 48);
    assert_int_equal(of_run.run.subject.height, 32);
    assert_int_equal(of_run.run.frames, 7);
    assert_int_equal(of_run.row, 5);
    rg_free_fields(rg_asked_run_fields, &of_run);
    free(settings);
    static const struct rg_asked all[] = {{"a name", 4}, {NULL, 9}};
    for (int i = 0; i < 2; i++) {
        struct rg_asked asked;
        pass(rg_asked_fields, &all[i], &asked, sizeof(asked));
        assert_int_equal(asked.number, all[i].number);
        assert_int_equal(!asked.name, !all[i].name);
        if (all[i].name)
            assert_string_equal(asked.name, all[i].name);
    }
}

static struct rg_contents buffer_of(unsigned char *bytes, size_t size, unsigned char value)
{
    memset(bytes, value, size);
    return (struct rg_contents){.size = size, .bytes = bytes};
}

static void expect_bytes(const struct rg_contents *contents, size_t size, unsigned char value)
{
    assert_int_equal(contents->size, size);
    for (size_t i = 0; i < size; i++)
        assert_int_equal(((unsigned char *)contents->bytes)[i], value);
}

// Only a slot that is written has contents after the run.
static void a_dispatch_passes_with_the_contents_of_its_slots(void **state)
{
    (void)state;
    static struct rg_dispatched row, taken;
    unsigned char source[8], target[12], after[16];
    row.kernel = rg_kernel_find("probe_copy"); // source 1, target 2
    row.was_kept = true;
    memset(row.params, 0x5a, sizeof(row.params));
    row.origin = (struct rg_extent){1, 2, 3};
    row.extent = (struct rg_extent){4, 5, 6};
    row.before[1] = buffer_of(source, sizeof(source), 7);
    row.before[2] = buffer_of(target, sizeof(target), 8);
    row.after[2] = buffer_of(after, sizeof(after), 9);
    const struct rg_dispatches all = {.count = 1, .rows = &row};
    struct rg_dispatches of_all;
    pass(rg_told_dispatches_fields, &all, &of_all, sizeof(of_all));
    assert_int_equal(of_all.count, 1);
    const struct rg_dispatched *got = &of_all.rows[0];
    assert_ptr_equal(got->kernel, row.kernel);
    assert_true(got->was_kept);
    assert_memory_equal(got->params, row.params, sizeof(row.params));
    assert_memory_equal(&got->origin, &row.origin, sizeof(row.origin));
    assert_memory_equal(&got->extent, &row.extent, sizeof(row.extent));
    expect_bytes(&got->before[1], sizeof(source), 7);
    expect_bytes(&got->before[2], sizeof(target), 8);
    assert_null(got->after[1].bytes);
    expect_bytes(&got->after[2], sizeof(after), 9);
    rg_free_fields(rg_told_dispatches_fields, &of_all);
    // A request has what was before, and its reply goes into the same struct.
    pass(rg_asked_dispatched_fields, &row, &taken, sizeof(taken));
    expect_bytes(&taken.before[2], sizeof(target), 8);
    assert_null(taken.after[2].bytes);
    struct rg_message reply = {0};
    rg_put_fields(&reply, rg_told_dispatched_fields, &row);
    assert_true(rg_take_fields(&reply, rg_told_dispatched_fields, &taken));
    expect_bytes(&taken.after[2], sizeof(after), 9);
    expect_bytes(&taken.before[1], sizeof(source), 7);
    rg_message_free(&reply);
    rg_dispatched_free(&taken);
    row.was_kept = false; // its slots are not sent
    pass(rg_asked_dispatched_fields, &row, &taken, sizeof(taken));
    assert_null(taken.before[1].bytes);
}

static void a_draw_passes_with_its_targets(void **state)
{
    (void)state;
    static struct rg_dispatched row, taken;
    unsigned char colour[8], depth[12], drawn[8];
    row.kernel = rg_kernel_find("layer_meet");
    row.was_kept = row.has_colour = row.has_depth = true;
    row.layer = 2;
    row.level = 3;
    row.before[RG_SLOT_COLOUR] = buffer_of(colour, sizeof(colour), 7);
    row.before[RG_SLOT_DEPTH] = buffer_of(depth, sizeof(depth), 8);
    row.after[RG_SLOT_COLOUR] = buffer_of(drawn, sizeof(drawn), 9);
    pass(rg_asked_dispatched_fields, &row, &taken, sizeof(taken));
    assert_true(taken.has_colour && taken.has_depth && taken.layer == 2 && taken.level == 3);
    expect_bytes(&taken.before[RG_SLOT_COLOUR], sizeof(colour), 7);
    expect_bytes(&taken.before[RG_SLOT_DEPTH], sizeof(depth), 8);
    struct rg_message reply = {0}; // depth is not written
    rg_put_fields(&reply, rg_told_dispatched_fields, &row);
    assert_true(rg_take_fields(&reply, rg_told_dispatched_fields, &taken));
    expect_bytes(&taken.after[RG_SLOT_COLOUR], sizeof(drawn), 9);
    assert_null(taken.after[RG_SLOT_DEPTH].bytes);
    rg_message_free(&reply);
    rg_dispatched_free(&taken);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_device_tells_all_of_itself),
        cmocka_unit_test(a_list_tells_each_device_or_why_there_is_none),
        cmocka_unit_test(measurements_pass_but_what_follows_from_them),
        cmocka_unit_test(a_session_tells_its_numbers),
        cmocka_unit_test(an_account_and_stages_keep_their_names),
        cmocka_unit_test(bytes_and_contents_have_their_layout),
        cmocka_unit_test(digests_pass_row_by_row),
        cmocka_unit_test(a_run_is_asked_for_with_its_row),
        cmocka_unit_test(a_dispatch_passes_with_the_contents_of_its_slots),
        cmocka_unit_test(a_draw_passes_with_its_targets),
    };
    return cmocka_run_group_tests_name("structs in messages", tests, NULL, NULL);
}
