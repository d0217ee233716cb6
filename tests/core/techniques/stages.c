// Stages and assets are bound by name; opening refuses a wrong name.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/techniques/technique.h"
#include "kernels/probe/copy_params.h"

enum { WORDS = 64 };

// A technique of one kernel, which copies words and flips some of their bits.
struct copier {
    struct rg_instance base;
    struct probe_copy_params copy, again;
};

static void open_copier(struct copier *c)
{
    uint32_t words[WORDS];
    for (uint32_t i = 0; i < WORDS; i++)
        words[i] = i * 3;
    *c = (struct copier){.base.device = rg_device_open("cpu:reference"),
                         .copy = {WORDS, 1, 0},
                         .again = {WORDS, 1, 7}};
    assert_non_null(c->base.device);
    assert_non_null(rg_add_buf(&c->base, "source", WORDS, words));
    assert_non_null(rg_add_buf(&c->base, "copied", WORDS, NULL));
    assert_non_null(rg_add_buf(&c->base, "kept", WORDS, NULL));
    assert_non_null(rg_add_image(&c->base, "picture", RG_RGBA8, 4, 4));
}

static void close_copier(struct copier *c)
{
    rg_stages_free(&c->base);
    rg_assets_free(&c->base);
    assert_true(rg_device_close(c->base.device)); // nothing is left
}

static void read(struct copier *c, const char *name, uint32_t words[WORDS])
{
    assert_true(rg_buf_read(rg_asset_find(&c->base, name)->buf, 0, words, WORDS * 4));
}

#define AT(field) offsetof(struct copier, field)

// Opens one row, which must be refused in one line that holds both words.
static void expect_refused(const struct rg_stage *row, const char *one, const char *two)
{
    struct copier c;
    open_copier(&c);
    assert_int_equal(rg_open_stages(&c.base, row, 1, &c, NULL), -1);
    assert_non_null(strstr(rg_last_error(), one));
    assert_non_null(strstr(rg_last_error(), two));
    assert_null(rg_add_buf(&c.base, "more", WORDS, NULL)); // after a failure nothing is added
    close_copier(&c);
}

static void wrong_names_are_refused(void **state)
{
    (void)state;
    expect_refused(
        &(struct rg_stage){"probe_copy", .named = {{"source", "sauce"}, {"target", "copied"}}},
        "'probe_copy'", "'sauce'");
    expect_refused(&(struct rg_stage){"probe_copy", .over = "source"}, "'probe_copy'", "'target'");
    expect_refused(
        &(struct rg_stage){"probe_copy", .named = {{"target", "copied"}, {"two", "kept"}}},
        "'probe_copy'", "'two'");
    expect_refused(
        &(struct rg_stage){"probe_copy", .named = {{"source", "picture"}, {"target", "copied"}}},
        "wants a buffer", "'picture'");
    expect_refused(
        &(struct rg_stage){"probe_copy", .over = "nothing", .named = {{"target", "copied"}}},
        "'probe_copy'", "'nothing'");
    expect_refused(&(struct rg_stage){.kernel = "no_such_kernel"}, "'no_such_kernel'", "unknown");
}

static void an_image_of_another_format_is_refused(void **state)
{
    (void)state;
    expect_refused(&(struct rg_stage){"test_image_copy",
                                      .named = {{"source", "picture"}, {"target", "picture"}}},
                   "'test_image_copy'", "RGBA8");
}

static bool never(const struct rg_instance *instance)
{
    (void)instance;
    return false;
}

static int told;
static void count(const struct rg_opened_stage *stage, void *user)
{
    assert_string_equal(stage->row.kernel, "probe_copy");
    assert_ptr_equal(user, &told);
    told++;
}

static void stages_run_what_their_rows_say(void **state)
{
    (void)state;
    const struct rg_stage rows[] = {
        {"probe_copy", .params = AT(copy), .over = "source", .named = {{"target", "copied"}}},
        {"probe_copy", never, .params = AT(copy), .over = "source",
         .named = {{"source", "no such asset"}}},
        {"probe_copy", .params = AT(again), .over = "source",
         .named = {{"source", "copied"}, {"target", "kept"}}},
    };
    struct copier c;
    uint32_t source[WORDS], copied[WORDS], kept[WORDS];
    open_copier(&c);
    assert_int_equal(rg_open_stages(&c.base, rows, 3, &c, NULL), 0);
    assert_ptr_equal(c.base.stages[0].pass, c.base.stages[2].pass); // one kernel, one pass
    c.base.after_stage = count;
    c.base.user = &told;
    told = 0;
    assert_true(rg_stage(&c.base, 0) && rg_stage(&c.base, 1) && rg_stage(&c.base, 2));
    assert_int_equal(told, 2);
    assert_false(rg_stage_runs(&c.base, 1));
    read(&c, "source", source);
    read(&c, "copied", copied);
    read(&c, "kept", kept);
    for (uint32_t i = 0; i < WORDS; i++) {
        assert_int_equal(source[i], i * 3);
        assert_int_equal(copied[i], i * 3);
        assert_int_equal(kept[i], (i * 3) ^ 7); // of other parameters
    }
    assert_true(rg_stage_wrote(&c.base.stages[2], rg_asset_find(&c.base, "kept")));
    assert_false(rg_stage_wrote(&c.base.stages[2], rg_asset_find(&c.base, "copied")));
    close_copier(&c);
}

static void swapped_assets_are_each_other(void **state)
{
    (void)state;
    const struct rg_stage row = {"probe_copy", .params = AT(copy), .over = "source",
                                 .named = {{"target", "copied"}}};
    struct copier c;
    uint32_t before[WORDS], copied[WORDS], kept[WORDS];
    open_copier(&c);
    assert_int_equal(rg_open_stages(&c.base, &row, 1, &c, NULL), 0);
    assert_true(rg_stage(&c.base, 0));
    read(&c, "copied", before);
    rg_swap(rg_asset_find(&c.base, "copied"), rg_asset_find(&c.base, "kept"));
    read(&c, "kept", kept);
    assert_memory_equal(kept, before, sizeof(kept));
    c.copy.salt = 1; // the stage writes the asset that has the name now
    assert_true(rg_stage(&c.base, 0));
    read(&c, "copied", copied);
    read(&c, "kept", kept);
    assert_memory_equal(kept, before, sizeof(kept));
    assert_memory_not_equal(copied, before, sizeof(copied));
    close_copier(&c);
}

static void a_scope_comes_first(void **state)
{
    (void)state;
    const struct rg_stage row = {"probe_copy", .params = AT(copy), .over = "source",
                                 .named = {{"target", "copied"}}};
    struct copier c;
    uint32_t words[WORDS];
    open_copier(&c);
    assert_non_null(rg_add_buf(&c.base, "mine.copied", WORDS, NULL));
    assert_int_equal(rg_open_stages(&c.base, &row, 1, &c, "mine"), 0);
    assert_true(rg_stage(&c.base, 0));
    read(&c, "copied", words);
    for (int i = 0; i < WORDS; i++)
        assert_int_equal(words[i], 0);
    read(&c, "mine.copied", words);
    assert_int_not_equal(words[WORDS - 1], 0);
    close_copier(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_names_are_refused),
        cmocka_unit_test(an_image_of_another_format_is_refused),
        cmocka_unit_test(stages_run_what_their_rows_say),
        cmocka_unit_test(swapped_assets_are_each_other),
        cmocka_unit_test(a_scope_comes_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
