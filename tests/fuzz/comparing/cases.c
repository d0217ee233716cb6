// Cases of shrink. A case that is taken is written and taken again: both texts must be the same.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/shrink/case.h"
#include "tests/fuzz/heard.h"

static char *text_of(const char *path)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "rb");
    if (!file || getdelim(&text, &size, 0, file) < 0 || fclose(file))
        fuzz_complain("written, and cannot be read");
    return text;
}

// A case's text, from the file to which it was written.
static char *write_case(const struct rg_case *found)
{
    const char *path = fuzz_write("written.txt", (const uint8_t *)"", 0);
    fuzz_listen();
    if (!rg_case_write(found, "a note", path))
        fuzz_complain("taken, and cannot be written");
    fuzz_judge_lines(true, 0);
    return text_of(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct rg_case found, again;
    const char *path = fuzz_write("fuzz.txt", data, size);
    fuzz_listen();
    const bool taken = rg_case_read(path, &found);
    fuzz_judge_lines(taken, 0);
    if (taken) {
        char *first = write_case(&found);
        path = fuzz_write("again.txt", (const uint8_t *)first, strlen(first));
        if (!rg_case_read(path, &again))
            fuzz_complain("taken, written, and refused");
        char *second = write_case(&again);
        if (strcmp(first, second) != 0)
            fuzz_complain("taken, written and taken as another");
        rg_case_free(&again);
        free(second);
        free(first);
    }
    rg_case_free(&found);
    return 0;
}
