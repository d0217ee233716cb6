// Draws of fixed functions in the report of `raingauge doctor`, and kernels that are compiled: the
// rows of devices, their digests in a passport, and the lines for people.
#include "harness/compare/doctor/fixed.h"

#include "core/base/log.h"
#include "harness/compare/doctor/compile.h"
#include "harness/console/exit.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

static int begin(void **state)
{
    (void)state;
    log_forget();
    return 0;
}

// --- rows of devices ---

// A device that draws and one that has nothing to draw with.
static json_t *make_rows(void)
{
    json_t *rows = json_loads(
        "[{\"name\": \"new\", \"status\": \"fail\", \"why\": \"1 draw fails\", \"ms\": 12.4,"
        "  \"draws\": [{\"feature\": \"linear\", \"status\": \"ok\", \"digest\": \"00aa\","
        "               \"bounds\": \"within\"},"
        "              {\"feature\": \"stencil\", \"status\": \"unsupported\", \"why\": \"lacks "
        "x\"},"
        "              {\"feature\": \"mips\", \"status\": \"fail\", \"why\": \"is wrong\","
        "               \"digest\": \"00bb\"},"
        "              {\"feature\": \"blend\", \"status\": \"ok\", \"digest\": \"00cc\","
        "               \"bounds\": \"none\"},"
        "              {\"feature\": \"samples\", \"status\": \"ok\", \"digest\": \"00dd\","
        "               \"bounds\": \"beyond\", \"known\": \"it errs\"},"
        "              {\"feature\": \"lines\", \"status\": \"error\", \"why\": \"no room\","
        "               \"fault\": \"harness\"}],"
        "  \"closed\": [{\"feature\": \"linear\", \"status\": \"ok\", \"why\": \"\"},"
        "               {\"feature\": \"mips\", \"status\": \"fail\", \"why\": \"does not "
        "hold\"}]},"
        " {\"name\": \"old\", \"status\": \"unsupported\", \"why\": \"has no fixed functions\","
        "  \"draws\": [], \"closed\": []}]",
        0, NULL);
    assert_non_null(rows);
    return rows;
}

static void rows_are_printed_with_what_fails(void **state)
{
    (void)state;
    json_t *rows = make_rows();
    printed_begin();
    rg_doctor_fixed_print(rows);
    assert_string_equal(printed_end(),
                        "new: 6 draws of fixed functions, 1 unsupported, 1 fail, 1 not drawn by a "
                        "lack of raingauge's own, 1 known fault; 1 of 2 closed cases hold; in 12 "
                        "ms\n"
                        "  linear                     00aa  within bounds\n"
                        "  stencil                    unsupported: lacks x\n"
                        "  mips                       fail: is wrong\n"
                        "  blend                      00cc  no bounds\n"
                        "  samples                    00dd  known fault: it errs\n"
                        "  lines                      error: no room\n"
                        "  mips                       fail: does not hold\n"
                        "old: unsupported: has no fixed functions\n");
    json_decref(rows);
}

static void a_passport_keeps_the_digests_that_are_ok(void **state)
{
    (void)state;
    const struct rg_device_info infos[2] = {{.name = "old"}, {.name = "new"}};
    json_t *rows = make_rows(), *passport = rg_doctor_fixed_passport(rows, infos, 2);
    const json_t *kept = rg_fixed_kept(passport, "new");
    assert_int_equal(json_object_size(kept), 3);
    assert_string_equal(json_string_value(json_object_get(kept, "linear")), "00aa");
    assert_string_equal(json_string_value(json_object_get(kept, "blend")), "00cc");
    assert_null(rg_fixed_kept(passport, "old"));
    assert_null(rg_fixed_kept(passport, "none"));
    json_decref(passport);
    json_decref(rows);
    json_t *hash = rg_fixed_hash(0xab);
    assert_string_equal(json_string_value(hash), "00000000000000ab");
    json_decref(hash);
}

static void a_device_without_fixed_functions_says_so(void **state)
{
    (void)state;
    struct rg_device_info info = {.name = ""};
    json_t *rows = json_array();
    assert_int_equal(rg_doctor_fixed("cpu", &info, rows), RG_EXIT_UNSUPPORTED);
    assert_string_equal(info.name, "cpu");
    assert_int_equal(rg_doctor_fixed("none", &info, rows), RG_EXIT_USAGE);
    static const char *const due[2][3] = {{"cpu", "unsupported", "has no fixed functions"},
                                          {"none", "error", NULL}};
    assert_int_equal(json_array_size(rows), 2);
    for (size_t i = 0; i < 2; i++) {
        const json_t *row = json_array_get(rows, i);
        assert_string_equal(json_string_value(json_object_get(row, "name")), due[i][0]);
        assert_string_equal(json_string_value(json_object_get(row, "status")), due[i][1]);
        assert_string_equal(json_string_value(json_object_get(row, "why")),
                            due[i][2] ? due[i][2] : logged);
        assert_int_equal(json_array_size(json_object_get(row, "draws")), 0);
        assert_int_equal(json_array_size(json_object_get(row, "closed")), 0);
    }
    assert_int_equal(logged_lines, 1);
    json_decref(rows);
}

// --- pairs ---

static void expect_why(int row, struct rg_fixed_told told, enum rg_outcome outcome, const char *due)
{
    char why[RG_FIXED_WHY];
    assert_int_equal(rg_fixed_judge(row, &told, why), outcome);
    assert_string_equal(why, due);
}

static void a_pair_is_judged_with_its_reason(void **state)
{
    (void)state;
    char due[RG_FIXED_WHY];
    const int draws = rg_fixed_count(), last = rg_fixed_closed_count() - 1;
    assert_int_equal(rg_fixed_pairs(), draws + last + 1);
    expect_why(0, (struct rg_fixed_told){.lacks = "samples", .is_constant = true}, RG_UNSUPPORTED,
               "lacks samples");
    expect_why(0, (struct rg_fixed_told){.digest = 1, .is_constant = true}, RG_FAIL,
               "leaves a picture that is the same everywhere");
    expect_why(1, (struct rg_fixed_told){.digest = 1, .other = 2}, RG_OK, "");
    struct rg_fixed_told beyond = {.digest = 1, .other = 2, .is_bounded = true};
    beyond.beyond = (struct rg_fixed_beyond){2, "stencil", 0, 5, 6, 0, 3, 1, 2};
    expect_why(1, beyond, RG_FAIL,
               "stencil at x 5, y 6, layer 0, channel 0 is 3, not from 1 to 2, and 1 more");
    snprintf(beyond.known, sizeof(beyond.known), "known");
    expect_why(1, beyond, RG_OK, "");
    snprintf(due, sizeof(due), "leaves what its neighbour does, whose %s is %d",
             rg_fixed_draws[1].field, rg_fixed_draws[1].to);
    expect_why(1, (struct rg_fixed_told){.digest = 2, .other = 2}, RG_FAIL, due);
    expect_why(draws + last, (struct rg_fixed_told){.digest = 2, .other = 2}, RG_OK, "");
    snprintf(due, sizeof(due), "does not hold: %s", rg_fixed_closed[last].about);
    expect_why(draws + last, (struct rg_fixed_told){.digest = 1, .other = 2}, RG_FAIL, due);
}

static void a_device_that_fails_twice_draws_no_more(void **state)
{
    (void)state;
    const struct rg_device device = {.info.name = "new"};
    assert_true(rg_fixed_goes_on(&device, 0, 5));
    assert_true(rg_fixed_goes_on(&device, 1, 5));
    assert_true(rg_fixed_goes_on(&device, 2, 0));
    assert_int_equal(logged_lines, 0);
    assert_false(rg_fixed_goes_on(&device, 2, 5));
    assert_string_equal(
        logged, "device 'new': 2 draws of fixed functions failed, and 5 more are not tried");
    assert_false(rg_fixed_goes_on(&device, 3, 1));
}

// --- kernels ---

static void kernels_are_known_by_their_whole_names(void **state)
{
    (void)state;
    static const struct {
        const char *names, *unknown;
    } rows[] = {{"all", NULL},       {"probe_copy", NULL},        {"probe_copy,raster_quads", NULL},
                {"probe", "probe"},  {"probe_copy,none", "none"}, {"none,probe_copy", "none"},
                {"probe_copy,", ""}, {"all,probe_copy", "all"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char due[100];
        *logged = 0;
        assert_int_equal(rg_doctor_knows_kernels(rows[i].names), !rows[i].unknown);
        snprintf(due, sizeof(due), "--kernels: there is no kernel '%s'; ",
                 rows[i].unknown ? rows[i].unknown : "");
        assert_int_equal(!strncmp(logged, due, strlen(due)), rows[i].unknown != NULL);
    }
}

static void expect_count(const json_t *row, const char *key, int due)
{
    assert_int_equal(json_integer_value(json_object_get(row, key)), due);
}

// A kernel's name may begin with another kernel's whole name, and the two are not confused.
static void a_kernel_s_name_is_no_beginning(void **state)
{
    (void)state;
    json_t *report = json_array();
    assert_int_equal(rg_doctor_compile("cpu", "streaks_city_shade", report), RG_EXIT_PASS);
    expect_count(json_array_get(report, 0), "compiled", 1);
    expect_count(json_array_get(report, 0), "ran", 0);
    json_decref(report);
}

// A kernel that draws is compiled, and not run.
static void the_named_kernels_are_compiled(void **state)
{
    (void)state;
    static const struct {
        const char *names;
        int compiled, ran;
    } rows[] = {{"probe_copy", 1, 1}, {"probe_copy,raster_quads,probe_ops", 3, 2}};
    for (size_t i = 0; i < 2; i++) {
        json_t *report = json_array();
        assert_int_equal(rg_doctor_compile("cpu", rows[i].names, report), RG_EXIT_PASS);
        assert_int_equal(json_array_size(report), 1);
        const json_t *row = json_array_get(report, 0);
        assert_string_equal(json_string_value(json_object_get(row, "device")), "cpu");
        expect_count(row, "compiled", rows[i].compiled);
        expect_count(row, "ran", rows[i].ran);
        assert_int_equal(json_array_size(json_object_get(row, "failed")), 0);
        json_decref(report);
    }
    assert_int_equal(logged_lines, 0);
    json_t *report = json_array();
    assert_int_equal(rg_doctor_compile("none", "probe_copy", report), RG_EXIT_USAGE);
    assert_int_equal(json_array_size(report), 0);
    assert_int_equal(logged_lines, 1);
    json_decref(report);
}

static void what_compiles_is_counted_for_people(void **state)
{
    (void)state;
    printed_begin();
    assert_int_equal(rg_doctor_compile("cpu", "raster_quads,probe_copy", NULL), RG_EXIT_PASS);
    assert_string_equal(printed_end(),
                        "cpu: 2 kernels compile, an item of 1 of them was run, and 0 fail\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(rows_are_printed_with_what_fails, begin),
        cmocka_unit_test_setup(a_passport_keeps_the_digests_that_are_ok, begin),
        cmocka_unit_test_setup(a_device_without_fixed_functions_says_so, begin),
        cmocka_unit_test_setup(a_pair_is_judged_with_its_reason, begin),
        cmocka_unit_test_setup(a_device_that_fails_twice_draws_no_more, begin),
        cmocka_unit_test_setup(kernels_are_known_by_their_whole_names, begin),
        cmocka_unit_test_setup(a_kernel_s_name_is_no_beginning, begin),
        cmocka_unit_test_setup(the_named_kernels_are_compiled, begin),
        cmocka_unit_test_setup(what_compiles_is_counted_for_people, begin),
    };
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests_name("features in doctor", tests, NULL, NULL);
}
