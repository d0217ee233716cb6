// Journals of gates. What one keeps is taken whole or not at all, in one line at most, and each
// launch that is taken can be one. A checksum is mended first.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/run/kept.h"
#include "harness/record/disk/seal.h"
#include "tests/fuzz/heard.h"

static bool launch_none(int number, void *user)
{
    (void)number;
    (void)user;
    return false;
}

static bool take_none(int row, bool b_first, struct rg_quads *quads, void *user)
{
    (void)row;
    (void)b_first;
    (void)quads;
    (void)user;
    return false;
}

// What a course is given of a row, without anything that measures.
static void check_row(struct rg_kept_times *kept, const char *name)
{
    const struct rg_quad_source none = {.launch = launch_none, .take = take_none};
    const struct rg_quad_source source = rg_kept_times_source(kept, &none, &name);
    for (int number = 0; number < 4; number++) {
        struct rg_quads quads;
        if (!source.launch(number, source.user))
            fuzz_complain("a launch that is kept cannot be had");
        if (!source.take(0, false, &quads, source.user))
            continue;
        if (!isfinite(quads.log) || !(quads.a_ms >= 0) || !(quads.b_ms > 0))
            fuzz_complain("taken, and no time");
    }
}

static void check(struct rg_kept_times *kept, const json_t *document)
{
    const char *name;
    json_t *row;
    json_object_foreach(json_object_get(document, "rows"), name, row)
    {
        check_row(kept, name);
    }
    char *csv = rg_kept_times_csv(kept);
    int lines = 0;
    for (const char *c = csv; c && *c; c++)
        lines += *c == '\n';
    if (!csv || lines < rg_kept_times_count(kept))
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
    struct rg_kept_times *kept =
        rg_kept_times_open(folder, key ? json_incref(key) : json_object(), false);
    fuzz_judge_lines(kept, 1);
    check(kept, document);
    rg_kept_times_close(kept, true);
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
