// The text below a brief table: claims by their verdicts, and up to five lines of notes.
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "harness/console/terminal.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/sheet/below.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

static const struct rg_table rates = {
    .id = "rates",
    .technique = "flow",
    .hardware = "an old machine",
    .columns = {"radius_m", "particles", "fps"},
    .key_count = 1,
    .variants = {{"full", "", "fps"}},
    .row_count = 3,
    .rows = (const struct rg_table_row[]){{"", {5, 1000, 40}, NULL},
                                          {"", {10, 1000, 20}, NULL},
                                          {"", {20, 1000, 10}, NULL}},
    .note = "a note",
};

static const struct rg_claim *papers;
static const struct rg_claim none[] = {{.table = NULL}};

static int keep_claims(void **state)
{
    (void)state;
    papers = rg_claims;
    rg_claims = none;
    return 0;
}

static int restore_claims(void **state)
{
    (void)state;
    rg_claims = papers;
    return 0;
}

// The text below a result, until the next call; a note or a claim is one line, however it is
// broken.
static const char *below(const struct rg_result *result)
{
    static char text[1 << 14];
    memset(text, 0, sizeof(text));
    FILE *out = fmemopen(text, sizeof(text), "w");
    assert_non_null(out);
    rg_brief_below(result, out);
    assert_int_equal(fclose(out), 0);
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1)
        assert_between(strcspn(line, "\n"), 0, RG_PAGE_WIDTH);
    for (char *at = text; (at = strstr(at, "\n  "));) {
        *at = ' ';
        memmove(at + 1, at + 3, strlen(at + 3) + 1);
    }
    return text;
}

static void expect_begin(const struct rg_result *result, const char *due)
{
    const char *found = below(result);
    if (strncmp(found, due, strlen(due)) != 0)
        fail_msg("%s\nbegins not so: %s", found, due);
}

// --- claims ---

#define LONG_WORDS                                                                                 \
    "a claim whose words are so long that it stands in a line of its own, with its verdicts below"

static const struct rg_claim claims[] = {{.table = "others",
                                          .variant = "full",
                                          .where = "1",
                                          .words = "no claim of this table",
                                          .test = RG_CLAIM_RATE,
                                          .first = 1,
                                          .last = 3,
                                          .least = 1},
                                         {.table = "rates",
                                          .variant = "full",
                                          .where = "5.1",
                                          .words = "runs well",
                                          .source = RG_CLAIM_SAID,
                                          .test = RG_CLAIM_RATE,
                                          .first = 1,
                                          .last = 3,
                                          .least = 15},
                                         {.table = "rates",
                                          .variant = "full",
                                          .where = "6",
                                          .words = LONG_WORDS,
                                          .source = RG_CLAIM_PRINTED,
                                          .test = RG_CLAIM_RATIO,
                                          .first = 1,
                                          .last = 2,
                                          .least = 1},
                                         {.table = NULL}};

// Devices of one verdict stand together, in the order of the first of each; "all devices" are more
// than one.
static void verdicts_are_told_by_devices(void **state)
{
    (void)state;
    struct rig rig;
    rg_claims = claims;
    sheet_measure_on(&rig, &rates, (double[]){40, 40, 40, 40, 30, 30, 10, 30, 20, 5, 20, 5}, 4);
    expect_begin(&rig.result,
                 "- \"runs well\" (5.1): one launch: fits on cpu; one launch: misses on "
                 "cpu:reference, gl, vulkan\n"
                 "- " LONG_WORDS " (6): one launch: fits on all devices\n\n- In print");
    rig.result.is_part = true;
    expect_begin(&rig.result, "- In print");
    rg_result_free(&rig.result);
    sheet_measure(&rig, &rates, (double[]){40, 30, 20});
    expect_begin(&rig.result, "- \"runs well\" (5.1): one launch: fits on cpu\n");
    rg_result_free(&rig.result);
    sheet_measure_on(&rig, &rates, (double[]){40, 40, 40, 30, 30, 30, 20, 5, 20}, 3);
    expect_begin(&rig.result, "- \"runs well\" (5.1): one launch: fits on cpu, gl; one launch: "
                              "misses on cpu:reference\n");
    rg_result_free(&rig.result);
    rg_claims = none;
}

// Gives a cell launches that take about as long as its samples.
static void launch(struct rg_record *record)
{
    for (; record->launch_count < 24; record->launch_count++)
        record->launches[record->launch_count] = (struct rg_launch){
            .number = record->launch_count + 1,
            .ms = record->frame_ms.median * (1 + 1e-4 * (record->launch_count * 7 % 12)),
            .seconds = 1};
}

// A claim that launches decide by fewer rows, since one draws too many particles, says so.
static void fewer_rows_are_told(void **state)
{
    (void)state;
    struct rig rig;
    rg_claims = claims;
    sheet_measure(&rig, &rates, (double[]){40, 30, 20});
    for (int row = 0; row < 3; row++)
        launch(sheet_record_at(&rig, row, 0));
    expect_begin(&rig.result, "- \"runs well\" (5.1): reproduced on cpu\n");
    sheet_tell(sheet_record_at(&rig, 1, 0), "particles", 2000);
    expect_begin(&rig.result, "- \"runs well\" (5.1, by 2 of 3 rows): reproduced on cpu\n");
    rg_result_free(&rig.result);
    rg_claims = none;
}

// --- notes ---

// A change of a measured result of four rows, and the notes that it gives.
struct noted {
    void (*change)(const struct rig *rig, struct rg_result *result);
    const char *notes;
};

#define PRINT "- In print on an old machine. "
#define CLOCK "Medians of 11 samples by wall clock, "
#define QUICK PRINT CLOCK "quick.\n"
#define NOTE  "- a note\n"

static void change_nothing(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    (void)result;
}

static void measure_in_full(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    result->full = true;
    snprintf(result->quick, sizeof(result->quick), "atlas=small");
}

static void set_quick(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    snprintf(result->quick, sizeof(result->quick), "atlas=small");
}

static void forget_print(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    *result->hardware = 0;
    *result->note = 0;
}

static void take_fewer(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    sheet_record_at(rig, 1, 0)->sample_count = 7;
}

static void let_fail(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    for (int row = 1; row <= 2; row++)
        rg_record_end(sheet_record_at(rig, row, 0), RG_FAIL, row == 1 ? "too dark" : "too bright");
}

static void draw_more(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    sheet_tell(sheet_record_at(rig, 0, 0), "particles", 1201);
    sheet_tell(sheet_record_at(rig, 1, 0), "particles", 1199);
    sheet_tell(sheet_record_at(rig, 2, 0), "particles", 800);
}

static void set_seed(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    snprintf(result->changed, sizeof(result->changed), "seed=2");
}

static void leave_out(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    result->budget_s = 240;
    result->size_divisor = 4;
    result->left_out[1] = true;
    rg_result_drop_row(result, 1);
}

static void halve(const struct rig *rig, struct rg_result *result)
{
    leave_out(rig, result);
    result->size_divisor = 2;
    *result->hardware = 0;
    *result->note = 0;
}

static void measure_all_in_time(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    result->budget_s = 3600;
    result->size_divisor = 1;
}

static void interrupt(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    rg_result_drop_row(result, 1);
    rg_result_drop_row(result, 2);
}

static void drift(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    for (int row = 0; row < 3; row++) {
        struct rg_record *record = sheet_record_at(rig, row, 0);
        record->calibration_begin_ms = record->calibration_end_ms = row ? 2 : 2.25;
    }
}

static void disturb(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    sheet_record_at(rig, 1, 0)->taken[2] = 0.5;
}

// Two calm launches of each cell, and a disturbed one of the first; the last cell has but one.
static void time_in_launches(const struct rig *rig, struct rg_result *result)
{
    (void)result;
    for (int row = 0; row < 3; row++) {
        struct rg_record *record = sheet_record_at(rig, row, 0);
        record->launch_count = row < 2 ? 2 : 1;
        for (int i = 0; i < record->launch_count; i++)
            record->launches[i] = (struct rg_launch){.number = i + 1, .ms = 50};
        if (!row)
            record->launches[record->launch_count++] =
                (struct rg_launch){.number = 3, .ms = 90, .others = 0.5};
        record->taken[2] = row < 2 ? 0.5 : 0; // of samples that no number comes from
        rg_record_settle(record);
    }
}

static void hold_textures(const struct rig *rig, struct rg_result *result)
{
    (void)rig;
    result->is_of_textures = true;
}

static void notes_tell_how_it_was_measured(void **state)
{
    (void)state;
    static const struct noted cases[] = {
        {change_nothing, QUICK NOTE},
        {measure_in_full, PRINT CLOCK "full.\n" NOTE},
        {set_quick, PRINT CLOCK "quick: atlas=small.\n" NOTE},
        {forget_print, "- " CLOCK "quick.\n- The time of a frame goes with radius_m to the power: "
                       "cpu 0.50 (0.50 to 0.50).\n"},
        {take_fewer, PRINT "Medians of 7 to 11 samples by wall clock, quick.\n" NOTE},
        {let_fail, "- 2 cells have no number; the first, on cpu: too dark\n" QUICK NOTE},
        {draw_more, "- Other work: rows 1, 3 draw 1.2 times the particles in print or more, or as "
                    "few; no verdict is about them.\n" QUICK NOTE},
        {set_seed, "- All cells have seed=2: not what was printed.\n" QUICK NOTE},
        {leave_out, "- Within a budget of 240 s: 2 of 3 rows, pictures of a fourth of the width "
                    "and height: not what was printed.\n" QUICK NOTE},
        {halve, "- Within a budget of 240 s: 2 of 3 rows, pictures of half the width and "
                "height.\n- " CLOCK "quick.\n- The time of a frame goes with radius_m to the "
                "power: cpu 0.50 (0.50 to 0.50).\n"},
        {measure_all_in_time, "- Within a budget of 3600 s: 3 of 3 rows.\n" QUICK NOTE},
        {interrupt, "- Rows are missing from 2 on: the run was interrupted.\n" QUICK NOTE},
        {drift, PRINT CLOCK "quick. The machine drifted by 12.5 %.\n" NOTE},
        {disturb, PRINT CLOCK "quick. In 1 of 3 others took over 5 % of the processors (busy, "
                              "!; up to 50 %).\n" NOTE},
        {time_in_launches,
         PRINT "Medians of 2 launches or 11 samples by wall clock, quick.\n" NOTE},
        {hold_textures, NOTE}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rig rig;
        sheet_measure(&rig, &rates, (double[]){40, 1000 / 35.35533906, 20});
        cases[i].change(&rig, &rig.result);
        assert_string_equal(below(&rig.result), cases[i].notes);
        rg_result_free(&rig.result);
    }
}

// Notes that have no room in five lines are said to stand elsewhere.
static void notes_end_after_five_lines(void **state)
{
    (void)state;
    static const char more[] = " ... (`raingauge table --wide`, csv and json have all of it)\n";
    struct rig rig;
    sheet_measure(&rig, &rates, (double[]){40, 30, 20});
    let_fail(&rig, &rig.result);
    set_seed(&rig, &rig.result);
    measure_all_in_time(&rig, &rig.result);
    assert_null(strstr(below(&rig.result), "a note"));
    assert_string_equal(below(&rig.result),
                        "- 2 cells have no number; the first, on cpu: too dark\n"
                        "- All cells have seed=2: not what was printed.\n"
                        "- Within a budget of 3600 s: 3 of 3 rows.\n" PRINT CLOCK
                        "quick. ... (`raingauge table --wide`, csv and json have all of it)\n");
    rig.result.budget_s = 0;
    assert_null(strstr(below(&rig.result), more));
    rg_result_free(&rig.result);
}

// The growth of each variant on each device, of the first work; without an interval where samples
// are few.
static void growth_is_told_of_the_first_work(void **state)
{
    (void)state;
    struct rg_table grown = rates;
    struct rig rig;
    grown.hardware = NULL;
    grown.variants[1] = (struct rg_table_variant){"bare", "", NULL};
    grown.works[0] = (struct rg_table_work){.name = "paper", .set = "", .saves = ""};
    grown.works[1] = (struct rg_table_work){.name = "ours", .set = "", .saves = "all"};
    grown.row_count = 2; // from 5 to 10
    sheet_measure_on(&rig, &grown, (double[]){8, 8, 8, 8, 9, 9, 9, 9, 4, 2, 16, 4, 1, 1, 1, 1}, 2);
    if (!strstr(below(&rig.result),
                "- The time of a frame of work paper goes with radius_m to the power: full on cpu "
                "1.00 (1.00 to 1.00), full on cpu:reference 2.00 (2.00 to 2.00), bare on cpu -1.00 "
                "(-1.00 to -1.00), bare on cpu:reference 1.00 (1.00 to 1.00)."))
        fail_msg("%s", below(&rig.result));
    rg_result_free(&rig.result);
    struct rg_table one = rates;
    one.hardware = NULL;
    sheet_measure_few(&rig, &one, (double[]){40, 20, 10}, 5);
    if (!strstr(below(&rig.result),
                "- The time of a frame goes with radius_m to the power: cpu 1.00.\n"))
        fail_msg("%s", below(&rig.result));
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdicts_are_told_by_devices),
        cmocka_unit_test(fewer_rows_are_told),
        cmocka_unit_test(notes_tell_how_it_was_measured),
        cmocka_unit_test(notes_end_after_five_lines),
        cmocka_unit_test(growth_is_told_of_the_first_work),
    };
    return cmocka_run_group_tests(tests, keep_claims, restore_claims);
}
