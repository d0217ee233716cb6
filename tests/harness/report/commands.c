// The records and files that `raingauge report` asks for, what it prints, and its exit status.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/output.h"
#include "harness/report/page.h"
#include "tests/harness/cli/asked.h"

// --- stand-ins ---

static const char *broken; // the step that fails

static bool does(const char *step, const char *path)
{
    return !broken || strcmp(broken, step) != 0 || rg_error("%s: %s fails", path, step);
}

bool rg_stored_read(struct rg_stored *stored, const char *path)
{
    asked_note("kept %s; ", path);
    stored->count = 3;
    return does("kept", path);
}

void rg_stored_free(struct rg_stored *stored)
{
    asked_note("%s%d kept are freed", *asked_seen ? "; " : "", stored->count);
}

bool rg_page_add(struct rg_page *page, const char *path)
{
    asked_note("add %s%s; ", path, page->kept ? "" : " of before");
    if (page->kept && strstr(asked_seen, "kept "))
        assert_int_equal(page->kept->count, 3);
    if (!page->records)
        page->records = json_array();
    json_array_append_new(page->records, json_string(path));
    return does(page->kept ? "add" : "before", path);
}

bool rg_page_write(const struct rg_page *page, const struct rg_page *before, const char *path)
{
    asked_note("write %zu, before %zu to %s", json_array_size(page->records),
               before ? json_array_size(before->records) : 99, path);
    return does("write", path);
}

char *rg_page_markdown(const struct rg_page *page)
{
    asked_note("markdown of %zu", json_array_size(page->records));
    return does("markdown", "memory") ? strdup("# text\n") : NULL;
}

char *rg_page_badge(const struct rg_page *page)
{
    asked_note("badge of %zu", json_array_size(page->records));
    return does("badge", "memory") ? strdup("<svg/>\n") : NULL;
}

bool rg_output_write_file(const char *path, const char *text)
{
    asked_note(", %.6s to %s", text, path);
    return does("output", path);
}

// --- tests ---

static const struct {
    const char *line, *seen, *printed;
} asked[] = {
    {"report a.json", "memory 0; add a.json; write 1, before 99 to report.html; 0 kept are freed",
     "report.html: 1 record; open it in a browser\n"},
    {"report a.json b -o c.html --against d --kept e --memory 1K",
     "memory 1024; kept e; add a.json; add b; add d of before; write 2, before 1 to c.html; 3 kept "
     "are freed",
     "c.html: 2 records; open it in a browser\n"},
    {"report a --format md", "memory 0; add a; markdown of 1; 0 kept are freed", "# text\n"},
    {"report a b --format md -o c.md",
     "memory 0; add a; add b; markdown of 2, # text to c.md; 0 kept are freed", ""},
    {"report a --format badge", "memory 0; add a; badge of 1; 0 kept are freed", "<svg/>\n"},
    {"report a --format badge -o c.svg",
     "memory 0; add a; badge of 1, <svg/> to c.svg; 0 kept are freed", ""},
};

static void records_become_pages_and_short_forms(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(asked) / sizeof(asked[0]); i++) {
        asked_expect(asked[i].line, asked[i].seen, RG_EXIT_PASS);
        assert_string_equal(asked_printed, asked[i].printed);
        assert_string_equal(asked_logged, "");
    }
}

#define WHOLE "report a b --against d --kept e "

// The first step that fails ends the command, which then has a status of 2 and prints nothing.
static void a_step_that_fails_ends_the_report(void **state)
{
    (void)state;
    static const struct {
        const char *broken, *line, *seen, *logged;
    } cases[] = {
        {"kept", WHOLE, "memory 0; kept e; ; 3 kept are freed", "e: kept fails"},
        {"add", WHOLE, "memory 0; kept e; add a; ; 3 kept are freed", "a: add fails"},
        {"before", WHOLE, "memory 0; kept e; add a; add b; add d of before; ; 3 kept are freed",
         "d: before fails"},
        {"write", WHOLE,
         "memory 0; kept e; add a; add b; add d of before; write 2, before 1 to report.html; 3 "
         "kept "
         "are freed",
         "report.html: write fails"},
        {"markdown", "report a --format md", "memory 0; add a; markdown of 1; 0 kept are freed",
         "memory: markdown fails"},
        {"badge", "report a --format badge -o c", "memory 0; add a; badge of 1; 0 kept are freed",
         "memory: badge fails"},
        {"output", "report a --format md -o c",
         "memory 0; add a; markdown of 1, # text to c; 0 kept are freed", "c: output fails"},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        broken = cases[i].broken;
        asked_expect(cases[i].line, cases[i].seen, RG_EXIT_USAGE);
        assert_string_equal(asked_printed, "");
        assert_string_equal(asked_logged, cases[i].logged);
    }
    broken = NULL;
    asked_run("report");
    assert_string_equal(asked_logged, "report: names no records; name files or folders, such as "
                                      "results/tables");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(records_become_pages_and_short_forms, asked_setup,
                                        asked_teardown),
        cmocka_unit_test_setup_teardown(a_step_that_fails_ends_the_report, asked_setup,
                                        asked_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
