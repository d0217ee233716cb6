// Files of expectations: ours, and Mesa's three. A file that is taken is asked about some cells,
// and then mended.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/expected/expected.h"
#include "tests/fuzz/heard.h"

enum { TODAY = 20780 }; // 2026-11-23

static const struct rg_known_result results[] = {
    {"streaks/rain", "vulkan", "Mesa 22.3.6", RG_FAIL, 12, 3, false},
    {"flow/pane", "gl", "Mesa 22.3.6", RG_OK, 0, 0, false},
    {"drops/pane", "vulkan@VK_DRIVER_FILES=new.json", "Mesa 25.0", RG_CRASH, NAN, NAN, false},
};
enum { RESULTS = sizeof(results) / sizeof(results[0]) };

static void ask(const struct rg_known *known)
{
    for (int i = 0; i < RESULTS; i++) {
        const int64_t row =
            rg_known_row(known, results[i].cell, results[i].device, results[i].driver, TODAY);
        if (row < -1 || row >= known->count)
            fuzz_complain("a row that is not there");
        const struct rg_judged judged =
            rg_known_judge(known, row, &results[i], rg_ending_of(results[i].outcome), TODAY);
        if (judged.applies != (row >= 0) || judged.applies != (*rg_judged_word(&judged) != 0))
            fuzz_complain("a verdict that cannot be");
        rg_known_skips(known, row, TODAY);
    }
}

static void search(const struct rg_known *known)
{
    fuzz_listen();
    bool can = true;
    for (int i = 0; can && i < RESULTS; i++)
        can = rg_known_can_search(known, results[i].cell);
    fuzz_judge_lines(can, 0);
}

// Checks that a mended file can be read.
static void mend(const struct rg_known *known)
{
    char *text;
    struct rg_known again = {.count = 0};
    fuzz_listen();
    if (!rg_known_mend(known, 0, results, RESULTS, TODAY, true, &text) ||
        (text && !rg_known_add_text(&again, "mended", text, strlen(text), known->files[0].form)))
        fuzz_complain("taken, and cannot be mended");
    fuzz_judge_lines(true, 0);
    rg_known_free(&again);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_write("fuzz.txt", data, size);
    for (int form = RG_FORM_OWN; form <= RG_FORM_SKIPS; form++) {
        struct rg_known known = {.count = 0};
        fuzz_listen();
        const bool taken = rg_known_add(&known, path, (enum rg_known_form)form);
        fuzz_judge_lines(taken, 0);
        if (taken) {
            search(&known);
            ask(&known);
        }
        if (taken)
            mend(&known);
        rg_known_free(&known);
    }
    return 0;
}
