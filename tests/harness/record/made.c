#include "tests/harness/record/made.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/print.h"

static void tell_row(struct rg_record *record, struct rg_place at)
{
    rg_named_set_text(&record->row[record->row_count++], "scene", at.row ? "a \"b\", c" : "übung");
    rg_named_set_number(&record->row[record->row_count++], "height_m", 2.5 + at.row);
    rg_named_set_number(&record->published[record->published_count++], "fps", 3.25);
    rg_named_set_number(&record->published[record->published_count++], "particles", 12345678901.0);
    rg_named_set_number(&record->published[record->published_count++], "unknown", NAN);
}

static void tell_measured(struct rg_record *record, struct rg_place at)
{
    record->create_ms = 1.0 / 3;
    record->first_frame_ms = 28;
    record->api_over_wall = 0.987654321987;
    record->frames_a_sample = 3;
    record->calibration_begin_ms = at.row ? 2 : 2.123456789123;
    record->calibration_end_ms = at.row ? 2.5 : 1.0 / 3;
    record->is_watched = at.device == 0;
    record->retaken = 3 * record->is_watched;
    for (int i = 0; i < 7; i++) {
        record->taken[i] = record->is_watched ? i / 70.0 : 0;
        record->samples_ms[record->sample_count++] = 20.123456789123 + 0.7 * i * (at.variant + 1);
    }
    record->pass_frames = 2;
    record->pass_count = 2;
    rg_text_copy(record->passes[0].name, RG_NAME_SIZE, "flow_move");
    rg_text_copy(record->passes[1].name, RG_NAME_SIZE, "flow_light");
    record->passes[0].ms = 1e-7 / 3;
    record->passes[1].ms = 100;
    record->has_tally = at.row == 1;
    record->tally = (struct rg_tally){.runs = 3,
                                      .dispatches = 5,
                                      .items = INT64_MAX,
                                      .records = 7,
                                      .fragments_kept = -1,
                                      .texels_fetched = 9};
    rg_text_copy(record->counters[0].name, RG_NAME_SIZE, "drops");
    record->counters[0].value = INT64_MAX;
    record->counter_count = 1;
    rg_text_copy(record->counted[0].name, RG_NAME_SIZE, "drops");
    record->counted[0].value = 700 + at.row;
    record->counted_count = 1;
    rg_named_set_number(&record->facts[record->fact_count++], "particles", 4e9 + at.device);
    rg_named_set_text(&record->facts[record->fact_count++], "model", "bunny, no UTF-8: \xff");
    rg_named_set_number(&record->facts[record->fact_count++], "share", 2.0 / 3);
    record->truth_error.flip_mask_mean = 0.123456789123;
    record->truth_error.max_codes = 255;
}

static void fill(struct rg_result *result, struct rg_place at)
{
    struct rg_record *record = rg_result_at(result, at);
    memcpy(record->technique, result->technique, RG_NAME_SIZE);
    memcpy(record->variant, result->variants[at.variant], RG_NAME_SIZE);
    memcpy(record->work, result->works[at.work].name, RG_NAME_SIZE);
    record->device = result->devices[at.device];
    snprintf(record->set, sizeof(record->set), "a=%d b=2", at.row);
    tell_row(record, at);
    if (at.variant == 1 && at.device == 1) {
        rg_record_end(record, RG_CRASH, "the driver's process ended");
        record->truth_error = (struct rg_truth_error){.outcome = RG_ERROR, .detail = "no picture"};
    } else {
        tell_measured(record, at);
    }
    rg_record_settle(record);
}

static void name_devices(struct rg_result *result)
{
    json_t *devices = json_array();
    for (int d = 0; d < 2; d++) {
        struct rg_device_info *info = &result->devices[result->device_count++];
        snprintf(info->name, sizeof(info->name), "%s", d ? "gl" : "cpu:reference");
        memcpy(info->full, info->name, sizeof(info->full));
        snprintf(info->driver, sizeof(info->driver), "a driver, 1.%d", d);
        json_array_append_new(devices,
                              json_pack("{sssssssssb}", "name", info->name, "api", "", "device", "",
                                        "driver", info->driver, "software", info->software));
    }
    result->passport = json_pack("{soss}", "devices", devices, "else", "is kept");
}

struct rg_result make_result(void)
{
    struct rg_result result = {.table = "test-1.2",
                               .technique = "flow",
                               .hardware = "a paper's",
                               .truth = "limits=off",
                               .quick = "atlas=small",
                               .note = "Ende.",
                               .width = 640,
                               .height = 480,
                               .check_frames = 2,
                               .first_row = 1,
                               .last_row = 3,
                               .resumed_rows = 1,
                               .work_count = 2,
                               .works = {{"paper", ""}, {"ours", "less"}},
                               .variant_count = 2,
                               .variants = {"full", "bare"},
                               .missing_count = 1,
                               .missing = {"vulkan: none"}};
    name_devices(&result);
    assert_true(rg_result_add_row(&result, 1) && rg_result_add_row(&result, 3));
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        fill(&result, at);
    return result;
}

char *print_result(const struct rg_result *result, int format)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_true(rg_result_print(result, format, out));
    fclose(out);
    return text;
}

void assert_prints_same(const struct rg_result *a, const struct rg_result *b)
{
    for (int format = 0; rg_result_formats[format]; format++) {
        char *text_a = print_result(a, format), *text_b = print_result(b, format);
        assert_string_equal(text_a, text_b);
        free(text_a);
        free(text_b);
    }
}
