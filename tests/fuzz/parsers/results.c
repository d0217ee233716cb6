// Results and journals. A file that is taken is written and taken again: both must say the same, or
// a stored record is not the measured one. It is printed in every format. Checksums of cells and of
// journals are corrected first.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/disk/cells.h"
#include "harness/record/disk/seal.h"
#include "harness/record/disk/stored.h"
#include "harness/tables/print.h"
#include "tests/fuzz/heard.h"

static void check_again(const struct rg_result *result)
{
    char why[RG_WHY_SIZE] = "";
    struct rg_result again = {0};
    json_t *document = rg_result_json(result);
    if (!document)
        fuzz_complain("taken, and cannot be written");
    if (!rg_result_from_json(document, "again", &again, why)) {
        fputs(why, stderr);
        fuzz_complain("taken, written, and refused");
    }
    json_t *written = rg_result_json(&again);
    if (!json_equal(document, written))
        fuzz_complain("taken, written and taken as another");
    json_decref(written);
    json_decref(document);
    rg_result_free(&again);
}

// Checks that --from takes the printed JSON.
static void check_sealed(const char *text)
{
    char why[RG_WHY_SIZE] = "";
    json_t *document = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    if (!document || !rg_cells_are_whole("printed", document, why)) {
        fputs(why, stderr);
        fuzz_complain("printed with a wrong checksum");
    }
    json_decref(document);
}

// Prints in every format, without characters that control a terminal; JSON is for programs, and
// keeps DEL.
static void check_printed(const struct rg_result *result)
{
    for (int format = RG_RESULT_WIDE; format <= RG_RESULT_TEX; format++) {
        char *text = NULL;
        size_t size;
        FILE *out = open_memstream(&text, &size);
        fuzz_listen();
        if (!out || !rg_result_print(result, format, out) || fclose(out))
            fuzz_complain("taken, and cannot be printed");
        fuzz_judge_lines(true, 0);
        for (const unsigned char *c = (const unsigned char *)text; *c; c++)
            if ((*c < ' ' && *c != '\n') || (*c == 127 && format != RG_RESULT_JSON))
                fuzz_complain("a control character is printed");
        if (format == RG_RESULT_JSON)
            check_sealed(text);
        free(text);
    }
}

static void check(const struct rg_result *result)
{
    check_again(result);
    check_printed(result);
}

static void read_results(const uint8_t *data, size_t size)
{
    struct rg_stored stored = {0};
    const char *path = fuzz_write("fuzz.json", data, size);
    fuzz_listen();
    const bool taken = rg_stored_read(&stored, path);
    fuzz_judge_lines(taken, 0);
    for (int i = 0; taken && i < stored.count; i++)
        check(&stored.results[i]);
    rg_stored_free(&stored);
}

static void read_journal(const char *text, size_t size)
{
    char why[RG_WHY_SIZE] = "";
    struct rg_result result = {0};
    const char *path = fuzz_write("fuzz.journal", (const uint8_t *)text, size);
    fuzz_listen();
    const bool taken = rg_stored_read_one(path, &result, why);
    fuzz_judge_lines(true, 0);
    if (!taken && !*why)
        fuzz_complain("refused without a word");
    if (taken)
        check(&result);
    rg_result_free(&result);
}

// Reads with correct checksums of the cells, if there are any.
static void read_sealed(json_t *document)
{
    char *text = json_is_array(json_object_get(document, "cells")) && rg_cells_seal(document)
                     ? json_dumps(document, 0)
                     : NULL;
    if (text)
        read_results((const uint8_t *)text, strlen(text));
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_results(data, size);
    json_t *document = json_loadb((const char *)data, size, JSON_DISABLE_EOF_CHECK, NULL);
    read_sealed(document);
    char *text = json_is_object(document) && rg_seal(document) ? json_dumps(document, 0) : NULL;
    if (text)
        read_journal(text, strlen(text));
    else
        read_journal((const char *)data, size);
    free(text);
    json_decref(document);
    return 0;
}
