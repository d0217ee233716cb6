// The search for the smallest run: on two devices that are made up, so that it is known where a
// difference ends.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "tests/harness/verifying/shrinking/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// What a search found, and how it ended.
static struct rg_case found;
static struct rg_blame blame;
static int tried;

static int search(const char *assignments, int frames, int seconds)
{
    void *defaults = rg_settings_create(&made_technique);
    void *settings = rg_settings_copy(&made_technique, defaults, assignments);
    assert_non_null(settings);
    const struct rg_shrink_request request = {.run = {{&made_technique, settings, 96, 40}, frames},
                                              .device = &made_device,
                                              .truth = &made_truth,
                                              .seconds = seconds,
                                              .folder = folder};
    log_forget();
    rg_log_listen(log_last, NULL);
    const int exit = rg_shrink_case(&request, &found, &blame, &tried);
    rg_log_listen(NULL, NULL);
    assert_int_equal(made_open, 0); // every session was closed
    free(settings);
    free(defaults);
    return exit;
}

static void expect_settings(int view, int drops, int seed, double amount, double light)
{
    const struct made_settings *s = found.run.subject.settings;
    assert_int_equal(s->view, view);
    assert_int_equal(s->drops, drops);
    assert_int_equal(s->seed, seed);
    assert_equals(s->amount, amount);
    assert_equals(s->light, light);
}

enum { BOX, PANE, JAR };
static const char BEGIN[] = "view=jar drops=90 seed=77 amount=7 light=33";

// --- the smallest run ---

static int64_t work_of_all(const struct rg_digest_run *run)
{
    static const int views[] = {500, 100, 300};
    const struct made_settings *s = run->subject.settings;
    return 10 * s->drops + views[s->view] + s->seed + (int64_t)(16 * s->amount) +
           run->subject.width * run->subject.height / 16;
}

static enum made_way off_from_there(const struct rg_digest_run *run)
{
    const struct made_settings *s = run->subject.settings;
    const bool is = s->view != BOX && s->drops >= 37 && s->seed >= 50 && s->amount >= 2 &&
                    s->light >= 2 && run->subject.width >= 20 && run->subject.height >= 10;
    return is ? MADE_OFF : MADE_SAME;
}

// Frames end with the first that differs. Sides are halved, counts bisected, and amounts halved
// towards their least; what weighs nothing is halved towards its default, at most four times. A
// seed is no amount.
static void each_part_gets_as_small_as_it_can(void **state)
{
    (void)state;
    made_way = off_from_there;
    made_work = work_of_all;
    made_frame = 3;
    assert_int_equal(search(BEGIN, 5, 1000), RG_EXIT_PASS);
    expect_settings(PANE, 37, 77, 2.5, 3);
    assert_int_equal(found.run.frames, 3);
    assert_int_equal(found.run.subject.width, 24);
    assert_int_equal(found.run.subject.height, 10);
    assert_int_equal(found.stages_run, 5);
    assert_string_equal(found.stage, "rain_step");
    assert_string_equal(found.asset, "water");
    assert_int_equal(found.difference, RG_DIFFERENCE_LAST_BITS);
    assert_int_equal(found.fall.outcome, RG_OK);
    assert_int_equal(found.expected, 3005);
    assert_int_equal(found.found, 3006);
    assert_string_equal(found.device, "doubtful@A=1");
    assert_string_equal(found.truth, "trusted@B=2");
    assert_non_null(strstr(blame.text, "frame 3, stage rain_step: water[5] is 18.0000019"));
    assert_int_equal(tried, made_takes - 3); // of 1, 2 and 4 frames, before anything was tried
    assert_int_equal(logged_lines, 0);
    rg_case_free(&found);
}

static enum made_way off(const struct rg_digest_run *run)
{
    (void)run;
    return MADE_OFF;
}

static void a_picture_may_have_one_pixel(void **state)
{
    (void)state;
    made_way = off;
    assert_int_equal(search("", 1, 1000), RG_EXIT_PASS);
    expect_settings(BOX, 0, 1, 4, 1); // only drops weigh
    assert_int_equal(found.run.subject.width, 1);
    assert_int_equal(found.run.subject.height, 1);
    rg_case_free(&found);
}

// Smaller runs that end otherwise.
static enum made_way otherwise(const struct rg_digest_run *run)
{
    const struct made_settings *s = run->subject.settings;
    return s->drops < 37    ? MADE_OTHER
           : s->view != JAR ? MADE_TEXEL
           : s->amount < 2  ? MADE_FEWER
           : s->light < 2   ? MADE_REFUSED
                            : off_from_there(run);
}

// Another kind of difference, another stage, an asset that one writes alone, and settings that are
// refused are not what is searched for.
static void the_difference_stays_the_same(void **state)
{
    (void)state;
    made_way = otherwise;
    made_work = work_of_all;
    made_frame = 3;
    assert_int_equal(search(BEGIN, 5, 1000), RG_EXIT_PASS);
    expect_settings(JAR, 37, 77, 2.5, 3);
    assert_int_equal(found.difference, RG_DIFFERENCE_LAST_BITS);
    assert_int_equal(logged_lines, 0);
    rg_case_free(&found);
}

// --- ends ---

static enum made_way tired_after_ten(const struct rg_digest_run *run)
{
    return made_takes > 10 ? MADE_TIRED : off_from_there(run);
}

// A device that fails later ends the search, which keeps what it has.
static void a_device_that_fails_later_ends_it(void **state)
{
    (void)state;
    made_way = tired_after_ten;
    made_work = work_of_all;
    made_frame = 3;
    assert_int_equal(search(BEGIN, 5, 1000), RG_EXIT_PASS);
    assert_string_equal(logged, "shrink: kernel 'rain_step': its driver is tired; the least until "
                                "then is taken");
    assert_int_equal(tried, 8); // the eleventh run of the device failed
    assert_int_equal(found.run.frames, 3);
    assert_int_equal(found.run.subject.width, 24);
    rg_case_free(&found);
}

// A search of 8 s whose runs take 1 s each: three to begin, and five more.
static void time_ends_it(void **state)
{
    (void)state;
    made_way = off_from_there;
    made_work = work_of_all;
    made_frame = 3;
    made_run_ms = 1000;
    assert_int_equal(search(BEGIN, 5, 8), RG_EXIT_PASS);
    assert_int_equal(tried, 5);
    rg_case_free(&found);
}

static enum made_way fewer(const struct rg_digest_run *run)
{
    (void)run;
    return MADE_FEWER;
}

static enum made_way refused(const struct rg_digest_run *run)
{
    (void)run;
    return MADE_REFUSED;
}

static enum made_way tired(const struct rg_digest_run *run)
{
    (void)run;
    return MADE_TIRED;
}

// Without a difference to shrink there is no case, and the status says whose doing it is.
static void what_cannot_be_shrunk_is_told(void **state)
{
    (void)state;
    static const char same[] = "shrink: doubtful leaves the same bits as trusted after every "
                               "stage; give another frame, size or setting";
    static const struct {
        enum made_way (*way)(const struct rg_digest_run *run);
        int exit;
        const char *says;
    } cases[] = {{NULL, RG_EXIT_FAIL, same},
                 {fewer, RG_EXIT_FAIL,
                  "shrink: frame 1, stage rain_draw: target is written by one of the two alone, "
                  "which no smaller run explains; give another frame, size or setting"},
                 {refused, RG_EXIT_USAGE, "view and map exclude each other"},
                 {tired, RG_EXIT_FAIL, "kernel 'rain_step': its driver is tired"}};
    made_has_worker = false; // a failure in raingauge's own process is none to be shrunk
    for (int i = 0; i < 4; i++) {
        made_way = cases[i].way;
        assert_int_equal(search("", 2, 1000), cases[i].exit);
        assert_string_equal(logged, cases[i].says);
        assert_int_equal(logged_lines, 1);
        assert_int_equal(tried, 0);
        rg_case_free(&found);
    }
}

// --- a device that fails ---

static enum made_way crash_with_many_drops(const struct rg_digest_run *run)
{
    const struct made_settings *s = run->subject.settings;
    return s->drops >= 37 ? MADE_CRASH : MADE_TIRED;
}

static int64_t work_of_none(const struct rg_digest_run *run)
{
    (void)run;
    return 5;
}

// A failure is shrunk like a difference. Another failure is not the same. It is about the first
// stage with its kernel, whatever the truth left there.
static void a_failure_is_shrunk(void **state)
{
    (void)state;
    made_way = crash_with_many_drops;
    made_work = work_of_all;
    made_frame = 3;
    assert_int_equal(search("view=jar drops=90", 5, 1000), RG_EXIT_PASS);
    expect_settings(PANE, 37, 1, 1, 1);
    assert_int_equal(found.run.frames, 4); // of 1, 2 and 4 the first number at which it fails
    assert_int_equal(found.fall.outcome, RG_CRASH);
    assert_string_equal(found.fall.what, "while running kernel 'rain_step'");
    assert_int_equal(found.difference, RG_DIFFERENCE_NONE);
    assert_string_equal(found.stage, "rain_step");
    assert_int_equal(found.stages_run, 1);
    assert_int_equal(found.expected, 1001);
    assert_int_equal(found.found, 0);
    assert_string_equal(blame.text, "doubtful: its driver ended its process");
    assert_above(made_renewals, 1); // for each run that failed
    assert_int_equal(logged_lines, 0);
    rg_case_free(&found);
    made_work = work_of_none; // settings become the defaults where that is no more work
    assert_int_equal(search("view=jar drops=90", 5, 1000), RG_EXIT_PASS);
    expect_settings(BOX, 50, 1, 4, 1);
    rg_case_free(&found);
}

// --- files ---

static bool has_word(const char *path, const char *word)
{
    char text[1024] = "";
    FILE *file = fopen(path, "r");
    if (file) {
        text[fread(text, 1, sizeof(text) - 1, file)] = 0;
        fclose(file);
    }
    return strstr(text, word) != NULL;
}

static enum made_way off_with_both_words(const struct rg_digest_run *run)
{
    const struct made_settings *s = run->subject.settings;
    return has_word(s->map, "bad") && has_word(s->map, "worse") ? MADE_OFF : MADE_SAME;
}

// Writes a text, shrinks it, and returns what is left, which the caller frees.
static char *shrink_file(const char *name, const char *text)
{
    char path[128], assignment[160];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    snprintf(assignment, sizeof(assignment), "map=%s", path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    made_way = off_with_both_words;
    assert_int_equal(search(assignment, 1, 1000), RG_EXIT_PASS);
    const char *left = ((const struct made_settings *)found.run.subject.settings)->map;
    char *all = calloc(1, 1024);
    assert_non_null(all);
    file = fopen(left, "r");
    assert_non_null(file);
    assert_above(fread(all, 1, 1023, file), 0);
    fclose(file);
    assert_string_equal(strrchr(left, '.'), strrchr(name, '.'));
    rg_case_free(&found);
    return all;
}

static void lines_that_do_not_matter_go(void **state)
{
    (void)state;
    char *left = shrink_file("a.txt", "one\nbad\ntwo\nthree\nworse\nfour\nfive");
    assert_string_equal(left, "bad\nworse\n");
    free(left);
    left = shrink_file("b.txt", "bad\nworse"); // nothing can go
    assert_string_equal(left, "bad\nworse");
    free(left);
}

static void elements_that_do_not_matter_go(void **state)
{
    (void)state;
    char *left =
        shrink_file("a.json", "{\"note\": 1, \"lights\": [1, \"bad\", 2, 3, 4, \"worse\"]}");
    json_t *json = json_loads(left, 0, NULL),
           *due = json_pack("{si s[ss]}", "note", 1, "lights", "bad", "worse");
    assert_true(json_equal(json, due));
    json_decref(json);
    json_decref(due);
    free(left);
}

// Files of attempts that failed were removed: those that are left have the difference.
static void attempts_leave_no_files(void **state)
{
    (void)state;
    int count = 0;
    DIR *all = opendir(folder);
    assert_non_null(all);
    for (struct dirent *entry; (entry = readdir(all));) {
        char path[512];
        snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
        if (*entry->d_name == '.')
            continue;
        assert_true(has_word(path, "bad") && has_word(path, "worse"));
        count++;
    }
    closedir(all);
    assert_above(count, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_part_gets_as_small_as_it_can, made_reset),
        cmocka_unit_test_setup(a_picture_may_have_one_pixel, made_reset),
        cmocka_unit_test_setup(the_difference_stays_the_same, made_reset),
        cmocka_unit_test_setup(a_device_that_fails_later_ends_it, made_reset),
        cmocka_unit_test_setup(time_ends_it, made_reset),
        cmocka_unit_test_setup(what_cannot_be_shrunk_is_told, made_reset),
        cmocka_unit_test_setup(a_failure_is_shrunk, made_reset),
        cmocka_unit_test_setup(lines_that_do_not_matter_go, made_reset),
        cmocka_unit_test_setup(elements_that_do_not_matter_go, made_reset),
        cmocka_unit_test(attempts_leave_no_files),
    };
    return cmocka_run_group_tests_name("searches", tests, make_folder, remove_whole_folder);
}
