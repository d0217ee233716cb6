// Baselines of gates. A baseline that is taken is written and taken again: both must say the same.
// A checksum is corrected first.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/record/disk/seal.h"
#include "tests/fuzz/heard.h"

// Checks that one line says so if the baseline is not of these cells.
static void check_fits(const struct rg_baseline *baseline)
{
    struct rg_gate_cells cells;
    if (!rg_gate_cells_read(NULL, &cells))
        fuzz_complain("the built-in cells cannot be read");
    fuzz_listen();
    fuzz_judge_lines(rg_baseline_fits(baseline, "fuzz.json", &cells, "built-in cells", NULL), 0);
    rg_gate_cells_free(&cells);
}

static void check(const struct rg_baseline *baseline)
{
    struct rg_baseline again = {.count = 0};
    const char *path = fuzz_write("again.json", NULL, 0);
    fuzz_listen();
    if (!rg_baseline_write(baseline, path) || !rg_baseline_read(&again, path))
        fuzz_complain("taken, written, and refused");
    if (again.count != baseline->count || rg_baseline_print_changes(baseline, &again, stderr))
        fuzz_complain("taken, written and taken as another");
    rg_baseline_free(&again);
    check_fits(baseline);
}

static void read_baseline(const char *text, size_t size)
{
    struct rg_baseline baseline = {.count = 0};
    const char *path = fuzz_write("fuzz.json", (const uint8_t *)text, size);
    fuzz_listen();
    const bool taken = rg_baseline_read(&baseline, path);
    fuzz_judge_lines(taken, 0);
    if (taken)
        check(&baseline);
    rg_baseline_free(&baseline);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_baseline((const char *)data, size);
    json_t *document = json_loadb((const char *)data, size, 0, NULL);
    char *text = json_is_object(document) && rg_seal(document) ? json_dumps(document, 0) : NULL;
    if (text)
        read_baseline(text, strlen(text));
    free(text);
    json_decref(document);
    return 0;
}
