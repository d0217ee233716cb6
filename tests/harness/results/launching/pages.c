// The page of claims, and its document: sentence, totals, rows and notes of outcomes that no device
// gave. A letter stands for each outcome.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/console/terminal.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/claims/json.h"
#include "harness/tables/claims/text.h"
#include "tests/tools/expect.h"

static bool has_colours;

bool rg_has_colours(FILE *out)
{
    assert_ptr_equal(out, stdout);
    return has_colours;
}

static const struct rg_claim claims[] = {
    {.table = "creus-5.4",
     .variant = "full",
     .source = RG_CLAIM_SAID,
     .where = "5.2.2",
     .words = "Small is fast",
     .test = RG_CLAIM_FALLS,
     .first = 1,
     .last = 8},
    {.table = "creus-5.4",
     .variant = "full",
     .source = RG_CLAIM_PRINTED,
     .where = "5.2.3",
     .words = "1,000 cost 2 to 3 times as much",
     .part = "at first",
     .test = RG_CLAIM_TIMES,
     .first = 1,
     .last = 5,
     .least = 2,
     .most = 3,
     .is_ours = true},
    {.table = "feng-1",
     .variant = "gooch",
     .other = "outlines",
     .source = RG_CLAIM_PRINTED,
     .where = "6",
     .words = "lines cross",
     .test = RG_CLAIM_CROSSES,
     .first = 2,
     .last = 7,
     .knee = 4},
    {.table = "feng-2",
     .variant = "full",
     .source = RG_CLAIM_SAID,
     .where = "7",
     .words = "six are best",
     .test = RG_CLAIM_OPTIMUM,
     .first = 1,
     .last = 5,
     .knee = 2,
     .until = 3},
    {.table = "ye-1",
     .variant = "state",
     .other = "heap",
     .source = RG_CLAIM_SAID,
     .where = "III",
     .words = "faster",
     .test = RG_CLAIM_FASTER,
     .first = 1,
     .last = 5,
     .least = 1.2},
};
static const char *const devices[] = {"cpu", "cpu:reference", "gl", "vulkan"};

// --- outcomes ---

// "y": reproduced, "n": not, "b": at the bound, "o": open, "w": other work, "u": not seen; of one
// launch "f": fits, "m": misses, "k": near, "s": not seen.
static struct rg_judgement judgement_of(char letter)
{
    static const char letters[] = "ynbowufmks";
    const int i = (int)(strchr(letters, letter) - letters);
    struct rg_judgement j = {
        .verdict = (enum rg_claim_verdict)(i < RG_CLAIM_ONE_LAUNCH ? i : RG_CLAIM_ONE_LAUNCH),
        .figures = (enum rg_claim_figures)(i < RG_CLAIM_ONE_LAUNCH ? RG_FIGURES_NONE
                                                                   : i - RG_CLAIM_ONE_LAUNCH),
        .rows = 5,
        .rows_needed = 5};
    snprintf(j.why, sizeof(j.why), "for %c", letter);
    return j;
}

// Adds the outcomes of a claim on a machine: a letter a device, '-' for none.
static void add(struct rg_claim_outcomes *o, int claim, int origin, const char *letters)
{
    for (int d = 0; letters[d]; d++) {
        if (letters[d] == '-')
            continue;
        struct rg_claim_outcome *outcome = &o->outcomes[o->count++];
        *outcome = (struct rg_claim_outcome){
            .claim = &claims[claim], .origin = origin, .judgement = judgement_of(letters[d])};
        snprintf(outcome->device, sizeof(outcome->device), "%s", devices[d]);
        snprintf(outcome->length, sizeof(outcome->length), "%s", claim % 3 ? "full" : "quick");
    }
}

static void add_origin(struct rg_claim_outcomes *o, const char *cpu, int cores)
{
    json_t *passport =
        json_pack("{s{sssi}s[]}", "machine", "cpu", cpu, "cores_allowed", cores, "devices");
    const int found = rg_origins_find(&o->origins, passport);
    assert_int_equal(found, o->origins.count - 1);
    json_decref(passport);
}

static void begin(struct rg_claim_outcomes *o)
{
    *o = (struct rg_claim_outcomes){.outcomes = calloc(64, sizeof(*o->outcomes)),
                                    .tables = json_pack("[{ss}]", "table", "creus-5.4")};
    assert_non_null(o->outcomes);
    add_origin(o, "First CPU", 2);
}

// Five claims on four devices of one machine, with another number of each verdict.
static void make(struct rg_claim_outcomes *o)
{
    begin(o);
    add(o, 0, 0, "yyno");
    add(o, 1, 0, "ynbw");
    add(o, 2, 0, "yyno");
    add(o, 3, 0, "fnuk");
    add(o, 4, 0, "yof-");
}

// Two of three machines: the one without outcomes is neither named nor counted.
static void make_several(struct rg_claim_outcomes *o)
{
    begin(o);
    add_origin(o, "Second CPU", 4);
    add_origin(o, "Third CPU", 4);
    add(o, 0, 1, "y-n");
    add(o, 0, 2, "n-n");
    add(o, 1, 1, "y-f");
    add(o, 1, 2, "u-f");
    add(o, 3, 1, "s-m");
    add(o, 3, 2, "f-m");
}

// --- the page ---

static void expect_notes(const struct rg_sheet *sheet, const char *const *due)
{
    int count = 0;
    for (; due[count]; count++)
        if (count < sheet->note_count)
            assert_string_equal(sheet->notes[count], due[count]);
    assert_int_equal(sheet->note_count, count);
}

// Columns and rows as text, a line each.
static void expect_cells(const struct rg_sheet *sheet, const char *due)
{
    char text[4096] = "";
    size_t used = 0;
    for (int row = -1; row < sheet->row_count; row++)
        for (int c = 0; c < sheet->column_count; c++)
            used += (size_t)snprintf(text + used, sizeof(text) - used, "%s%s",
                                     row < 0 ? sheet->columns[c] : sheet->cells[row][c],
                                     c + 1 < sheet->column_count ? "|" : "\n");
    assert_string_equal(text, due);
}

static void a_page_counts_explains_and_lists(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    make(&o);
    o.outcomes[4].judgement.rows = 3;  // of the second claim on cpu, which is decided
    o.outcomes[5].judgement.rows = 2;  // and on another device, which is not told again
    o.outcomes[15].judgement.rows = 1; // of the fourth on vulkan, which is not
    o.outcomes[16].judgement.rows = 2;
    for (int i = 8; i < 16; i++)
        o.outcomes[i].judgement.print_contradicts = true;
    rg_claims_sheet(&o, false, &sheet);
    expect_cells(&sheet, "table|claim|cpu|ref|gl|vulkan\n"
                         "creus-5.4|\"Small is fast\"|yes|yes|no|open\n"
                         "creus-5.4|1,000 cost 2 to 3 times as much, at first|yes|no|bound|other\n"
                         "feng-1|lines cross|yes|yes|no|open\n"
                         "feng-2|\"six are best\"|(yes)|no|unseen|(near)\n"
                         "ye-1|\"faster\"|yes|open|(yes)|\n");
    static const char *const due[] = {
        "5 claims on 4 devices: 6 hold, 4 do not, 3 are open, 1 at the bound; 2 are not judged.",
        "Holds: 6 (cpu 4, cpu:reference 2).",
        "Does not hold: 4 (cpu:reference 2, gl 2).",
        "Open: 3 (cpu:reference 1, vulkan 2).",
        "One launch, no verdict: 2 fit the claim, 0 do not, 1 lie near the bound; `raingauge "
        "claims` decides.",
        "yes: reproduced; no: not reproduced; bound: at the bound; open: undecided; other: other "
        "work; unseen: not seen; in (): one launch; why: `--wide`.",
        "quick: creus-5.4, feng-2.",
        "full: creus-5.4, feng-1, ye-1.",
        "Judged by some of the rows: creus-5.4, 1,000 cost 2 to 3 times as much, at first, by 3 of "
        "5; ye-1, \"faster\", by 2 of 5.",
        "The paper's own table contradicts: feng-1, lines cross; feng-2, \"six are best\".",
        NULL};
    expect_notes(&sheet, due);
    assert_int_equal(sheet.lead_count, 5);
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

// A narrow page has a width and breaks its notes; a wide one has neither. Colours come with a
// terminal, for marks and words alike.
static void pages_have_a_width_and_colours(void **state)
{
    (void)state;
    static const struct {
        const char *mark, *word, *colour;
    } cells[] = {{"yes", "reproduced", RG_GREEN},      {"no", "not reproduced", RG_RED},
                 {"bound", "at the bound", RG_YELLOW}, {"open", "undecided", RG_YELLOW},
                 {"other", "other work", RG_YELLOW},   {"unseen", "not seen", NULL},
                 {"(yes)", "one launch: fits", NULL}};
    struct rg_claim_outcomes o;
    make(&o);
    for (int wide = 0; wide < 2; wide++) {
        struct rg_sheet sheet = {0};
        has_colours = wide;
        rg_claims_sheet(&o, wide, &sheet);
        assert_string_equal(sheet.title, "claims");
        assert_int_equal(sheet.width_step, !wide);
        assert_int_equal(sheet.note_width, wide ? 0 : RG_PAGE_WIDTH);
        assert_int_equal(sheet.paint != NULL, wide);
        for (size_t i = 0; wide && i < sizeof(cells) / sizeof(cells[0]); i++) {
            const char *found[] = {sheet.paint(cells[i].mark), sheet.paint(cells[i].word)};
            for (int f = 0; f < 2; f++)
                assert_string_equal(found[f] ? found[f] : "",
                                    cells[i].colour ? cells[i].colour : "");
        }
        rg_sheet_free(&sheet);
    }
    has_colours = false;
    rg_claims_free(&o);
    assert_true(!o.count && !o.outcomes && !o.tables);
}

static void a_page_without_claims_counts_none(void **state)
{
    (void)state;
    static const char *const due[] = {
        "0 claims on 0 devices: 0 hold, 0 do not, 0 are open, 0 at the bound; 0 are not judged.",
        "Holds: 0.",
        "Does not hold: 0.",
        "Open: 0.",
        "why: `--wide`.",
        NULL};
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    begin(&o);
    rg_claims_sheet(&o, false, &sheet);
    expect_cells(&sheet, "table|claim\n");
    expect_notes(&sheet, due);
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

static void one_claim_is_told_as_one(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    begin(&o);
    add(&o, 0, 0, "y");
    rg_claims_sheet(&o, false, &sheet);
    assert_string_equal(sheet.notes[0], "1 claim on 1 device: 1 hold, 0 do not, 0 are open, 0 at "
                                        "the bound; 0 are not judged.");
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

// A reason is told once for all devices that have it, and apart for those that have another.
static void a_wide_page_has_words_and_reasons(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    begin(&o);
    add(&o, 0, 0, "yyyn");
    add(&o, 3, 0, "yb-k");
    snprintf(o.outcomes[1].judgement.why, RG_REASON_SIZE, "for another");
    rg_claims_sheet(&o, true, &sheet);
    expect_cells(&sheet, "table|section|claim|cpu|cpu:reference|gl|vulkan\n"
                         "creus-5.4|5.2.2|\"Small is fast\"|reproduced|reproduced|reproduced|not "
                         "reproduced\n"
                         "feng-2|7|\"six are best\"|reproduced|at the bound||one launch: near the "
                         "bound\n");
    static const char *const due[] = {
        "2 claims on 4 devices: 4 hold, 1 do not, 0 are open, 1 at the bound; 0 are not judged.",
        "Holds: 4 (cpu 2, cpu:reference 1, gl 1).",
        "Does not hold: 1 (vulkan 1).",
        "Open: 0.",
        "One launch, no verdict: 0 fit the claim, 0 do not, 1 lie near the bound; `raingauge "
        "claims` decides.",
        "quick: creus-5.4, feng-2.",
        "creus-5.4, \"Small is fast\", reproduced on cpu, gl: for y.",
        "creus-5.4, \"Small is fast\", reproduced on cpu:reference: for another.",
        "creus-5.4, \"Small is fast\", not reproduced on vulkan: for n.",
        "feng-2, \"six are best\", reproduced on cpu: for y.",
        "feng-2, \"six are best\", at the bound on cpu:reference: for b.",
        "feng-2, \"six are best\", one launch: near the bound on vulkan: for k.",
        NULL};
    expect_notes(&sheet, due);
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

// --- several machines ---

// A row for each machine; verdicts that are not seen on one are compared with no other.
static void machines_stand_side_by_side(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    char machines[2][512];
    make_several(&o);
    rg_claims_sheet(&o, false, &sheet);
    expect_cells(&sheet, "table|claim|on|cpu|gl\n"
                         "creus-5.4|\"Small is fast\"|B|yes|no\n"
                         "creus-5.4|\"Small is fast\"|C|no|no\n"
                         "creus-5.4|1,000 cost 2 to 3 times as much, at first|B|yes|(yes)\n"
                         "creus-5.4|1,000 cost 2 to 3 times as much, at first|C|unseen|(yes)\n"
                         "feng-2|\"six are best\"|B|unseen|(no)\n"
                         "feng-2|\"six are best\"|C|(yes)|(no)\n");
    snprintf(machines[0], sizeof(machines[0]), "B: Second CPU, 4 cores, key %s.",
             o.origins.all[1].key);
    snprintf(machines[1], sizeof(machines[1]),
             "C: Third CPU, 4 cores, key %s; not as B: cpu Third CPU and not Second CPU.",
             o.origins.all[2].key);
    const char *const due[] = {
        "3 claims on 2 devices of 2 machines: 2 hold, 3 do not, 0 are open, 0 at the bound; 1 are "
        "not judged.",
        "Holds: 2 (cpu 2 of 3 on B, 0 of 3 on C).",
        "Does not hold: 3 (cpu 0 of 3 on B, 1 of 3 on C; gl 1 of 3 on B, 1 of 3 on C).",
        "Open: 0.",
        "One launch, no verdict: 3 fit the claim (cpu 0 of 3 on B, 1 of 3 on C; gl 1 of 3 on B, 1 "
        "of 3 on C), 2 do not, 0 lie near the bound; `raingauge claims` decides.",
        "yes: reproduced; no: not reproduced; unseen: not seen; in (): one launch; why: `--wide`.",
        machines[0],
        machines[1],
        "4 verdicts compared between machines: 1 differs.",
        "Differs: creus-5.4, \"Small is fast\" on cpu: yes on B, no on C.",
        "quick: creus-5.4, feng-2.",
        "full: creus-5.4.",
        NULL};
    expect_notes(&sheet, due);
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

static void places_name_a_machine_among_several(void **state)
{
    (void)state;
    struct rg_claim_outcomes one, several;
    char place[RG_CLAIM_PLACE];
    make(&one);
    make_several(&several);
    rg_claim_place(&one, &one.outcomes[1], place);
    assert_string_equal(place, "cpu:reference");
    rg_claim_place(&several, &several.outcomes[3], place);
    assert_string_equal(place, "gl of C");
    rg_claims_free(&one);
    rg_claims_free(&several);
}

// Today's figures beside kept verdicts: how many agree, and which differ.
static void kept_verdicts_are_told_beside_today(void **state)
{
    (void)state;
    static const enum rg_claim_agreement agreements[] = {
        RG_AGREEMENT_AGREES,   RG_AGREEMENT_AGREES,   RG_AGREEMENT_AGREES, RG_AGREEMENT_DIFFERS,
        RG_AGREEMENT_NOT_SEEN, RG_AGREEMENT_NOT_SEEN, RG_AGREEMENT_NONE};
    struct rg_claim_outcomes o;
    struct rg_sheet sheet = {0};
    begin(&o);
    add(&o, 0, 0, "yyyy");
    add(&o, 3, 0, "yyy");
    for (int i = 0; i < o.count; i++) {
        o.outcomes[i].is_kept = i < 6;
        o.outcomes[i].agreement = agreements[i];
        snprintf(o.outcomes[i].machine, RG_TITLE_SIZE, i < 6 ? "Kept CPU" : "Today's CPU");
    }
    rg_claims_sheet(&o, false, &sheet);
    assert_int_equal(sheet.note_count, 8);
    assert_string_equal(sheet.notes[5],
                        "Verdicts are of kept records, from Kept CPU. Today's figures of one "
                        "launch agree with 3 of them and differ from 1; 2 are not seen today.");
    assert_string_equal(sheet.notes[6], "Today differs: creus-5.4, \"Small is fast\" on vulkan.");
    rg_sheet_free(&sheet);
    rg_claims_free(&o);
}

// --- the document ---

static void expect_json(json_t *found, const char *due)
{
    char *text = json_dumps(found, JSON_COMPACT | JSON_ENCODE_ANY);
    assert_string_equal(text, due);
    free(text);
}

static const char *const told[] = {
    "{\"id\":\"creus-5.4/1000-cost-2-to-3-times-as-much-at-first\",\"table\":\"creus-5.4\","
    "\"paper\":\"creus\",\"section\":\"5.2.3\",\"source\":\"printed\",\"words\":\"1,000 cost 2 "
    "to 3 times as much\",\"part\":\"at first\",\"test\":\"times\",\"variant\":\"full\","
    "\"other_variant\":null,\"rows\":[1,5],\"knee_rows\":null,\"least\":2,\"most\":3,"
    "\"is_ours\":true,\"print_contradicts\":true,\"verdicts\":[{\"device\":\"cpu\","
    "\"machine\":\"B\",\"verdict\":\"undecided\",\"why\":\"for o\",\"probability\":null,"
    "\"rows_judged\":3,\"rows_needed\":5,\"figures\":null,\"launches\":24,"
    "\"launches_disturbed\":2,\"launches_needed\":72,\"hours_needed\":1.5,\"kept\":true,"
    "\"today\":\"differs\"},{\"device\":\"gl\",\"machine\":\"B\",\"verdict\":\"one launch\","
    "\"why\":\"for m\",\"probability\":null,\"rows_judged\":5,\"rows_needed\":5,"
    "\"figures\":\"misses\",\"launches\":0,\"launches_disturbed\":0,\"launches_needed\":0,"
    "\"hours_needed\":0,\"kept\":false,\"today\":null}]}",
    "{\"id\":\"feng-2/six-are-best\",\"table\":\"feng-2\",\"paper\":\"feng\",\"section\":\"7\","
    "\"source\":\"said\",\"words\":\"six are best\",\"part\":null,\"test\":\"optimum\","
    "\"variant\":\"full\",\"other_variant\":null,\"rows\":[1,5],\"knee_rows\":[2,3],"
    "\"least\":null,\"most\":null,\"is_ours\":false,\"print_contradicts\":false,"
    "\"verdicts\":[{\"device\":\"cpu\",\"machine\":\"A\",\"verdict\":\"one launch\","
    "\"why\":\"for f\",\"probability\":null,\"rows_judged\":5,\"rows_needed\":5,"
    "\"figures\":\"fits\",\"launches\":0,\"launches_disturbed\":0,\"launches_needed\":0,"
    "\"hours_needed\":0,\"kept\":false,\"today\":null}]}"};

// Each claim once, with its test and a verdict for each device and machine.
static void programs_are_told_claims_and_verdicts(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    begin(&o);
    add_origin(&o, "Second CPU", 2);
    add(&o, 1, 1, "o-m");
    add(&o, 3, 0, "f");
    struct rg_judgement *j = &o.outcomes[0].judgement;
    assert_int_equal(o.count, 3);
    j->rows = 3;
    j->launches = 24;
    j->disturbed = 2;
    j->needed = 96;
    j->launch_s = 75;
    j->print_contradicts = true;
    o.outcomes[1].judgement.launch_s = 9;
    o.outcomes[0].is_kept = true;
    o.outcomes[0].agreement = RG_AGREEMENT_DIFFERS;
    json_t *json = rg_claims_json(&o), *all = json_object_get(json, "claims");
    assert_int_equal(json_array_size(all), 2);
    for (size_t i = 0; i < 2; i++)
        expect_json(json_array_get(all, i), told[i]);
    expect_json(json_object_get(json, "tables"), "[{\"table\":\"creus-5.4\"}]");
    assert_int_equal(json_object_size(json), 4);
    assert_int_equal(json_integer_value(json_object_get(json, "format")), RG_FORMAT_VERSION);
    assert_int_equal(json_array_size(json_object_get(json, "machines")), 2);
    json_decref(json);
    rg_claims_free(&o);
}

static void programs_are_told_machines(void **state)
{
    (void)state;
    struct rg_claim_outcomes o;
    char due[1024];
    begin(&o);
    add_origin(&o, "Second CPU", 2);
    json_t *machines = rg_claims_machines_json(&o.origins);
    snprintf(due, sizeof(due),
             "[{\"name\":\"A\",\"key\":\"%s\",\"text\":\"First CPU, 2 cores\",\"differs\":null},"
             "{\"name\":\"B\",\"key\":\"%s\",\"text\":\"Second CPU, 2 cores\",\"differs\":\"cpu "
             "Second CPU and not First CPU\"}]",
             o.origins.all[0].key, o.origins.all[1].key);
    expect_json(machines, due);
    json_decref(machines);
    rg_claims_free(&o);
}

// --- ids ---

// Words are joined by one sign, and numbers stay together; an id that is too long is cut.
static void ids_are_of_letters_and_digits(void **state)
{
    (void)state;
    static const struct {
        enum rg_claim_source source;
        const char *words, *part, *id;
    } rows[] = {
        {RG_CLAIM_SAID, "complex models ... 25% slower", NULL, "t/complex-models-25-slower"},
        {RG_CLAIM_PRINTED, "20,000 Drops", "at least", "t/20000-drops-at-least"},
        {RG_CLAIM_SAID, "...a", NULL, "t/a"},
        {RG_CLAIM_PRINTED, "(x) y!", NULL, "t/x-y"}};
    char id[RG_CLAIM_ID], table[RG_CLAIM_ID + 8];
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_claim claim = {
            .table = "t", .source = rows[i].source, .words = rows[i].words, .part = rows[i].part};
        rg_claim_id(&claim, id);
        assert_string_equal(id, rows[i].id);
    }
    memset(table, 't', RG_CLAIM_ID - 4);
    table[RG_CLAIM_ID - 4] = 0;
    rg_claim_id(&(struct rg_claim){.table = table, .words = "long"}, id);
    assert_at_most(strlen(id), RG_CLAIM_ID - 1);
    assert_string_equal(id + RG_CLAIM_ID - 4, "/l");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_page_counts_explains_and_lists),
        cmocka_unit_test(pages_have_a_width_and_colours),
        cmocka_unit_test(a_page_without_claims_counts_none),
        cmocka_unit_test(one_claim_is_told_as_one),
        cmocka_unit_test(a_wide_page_has_words_and_reasons),
        cmocka_unit_test(machines_stand_side_by_side),
        cmocka_unit_test(places_name_a_machine_among_several),
        cmocka_unit_test(kept_verdicts_are_told_beside_today),
        cmocka_unit_test(programs_are_told_claims_and_verdicts),
        cmocka_unit_test(programs_are_told_machines),
        cmocka_unit_test(ids_are_of_letters_and_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
