// Journals of gates. A journal is taken whole or not at all, in one line at most, and each launch
// that is taken is possible. A checksum is corrected first.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/sides/journal.h"
#include "harness/record/disk/seal.h"
#include "tests/fuzz/heard.h"

// Checks the launches of a row that a course gets. Returns their number.
static int check_row(const struct rg_gate_journal *journal, const char *name)
{
    int count = 0;
    for (int number = 0; number < 4; number++) {
        struct rg_quads quads;
        if (!rg_gate_journal_find(journal, name, number, &quads))
            continue;
        if (!isfinite(quads.log) || !(quads.a_ms >= 0) || !(quads.b_ms > 0))
            fuzz_complain("taken, and no time");
        count++;
    }
    return count;
}

static void check(struct rg_gate_journal *journal, const json_t *document)
{
    const char *name;
    json_t *row;
    int lines = 0, launches = 0;
    json_object_foreach(json_object_get(document, "rows"), name, row)
    {
        launches += check_row(journal, name);
    }
    char *csv = rg_gate_journal_csv(journal);
    for (const char *c = csv; c && *c; c++)
        lines += *c == '\n';
    if (!csv || lines < launches)
        fuzz_complain("taken, and cannot be printed");
    free(csv);
}

static void read_journal(const char *text, size_t size, const json_t *document)
{
    const char *path = fuzz_write(RG_GATE_JOURNAL, (const uint8_t *)text, size);
    char folder[128];
    snprintf(folder, sizeof(folder), "%.*s", (int)(strrchr(path, '/') - path), path);
    json_t *key = json_object_get(document, "key");
    fuzz_listen();
    struct rg_gate_journal *journal =
        rg_gate_journal_open(folder, key ? json_incref(key) : json_object(), false);
    fuzz_judge_lines(journal, 1);
    check(journal, document);
    rg_gate_journal_close(journal, false);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    json_t *document = json_loadb((const char *)data, size, 0, NULL);
    read_journal((const char *)data, size, document);
    char *text = json_is_object(document) && rg_seal(document) ? json_dumps(document, 0) : NULL;
    if (text)
        read_journal(text, strlen(text), document);
    free(text);
    json_decref(document);
    return 0;
}
