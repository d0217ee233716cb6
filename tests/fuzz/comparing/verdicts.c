// Journals of bisects. What is taken is written and taken again: the two must say the same, and
// each verdict must be one that the bisect could have come to. Key and checksum are mended first.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/bisect/kept.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "tests/fuzz/heard.h"

enum { COUNT = 4 };

static const char *names[COUNT] = {"a", "b", "c", "d"};
static const struct rg_candidates candidates = {.count = COUNT, .names = names};
static const struct rg_judging judging = {.line = "true", .budget_s = 60, .tries = 3};

// A bisect with nothing judged, and room for it.
struct judged {
    struct rg_judged judged[COUNT];
    int64_t order[COUNT];
    struct rg_bisect bisect;
};

static void begin(struct judged *j)
{
    *j = (struct judged){.bisect = {.candidates = &candidates, .judging = &judging}};
    j->bisect.judged = j->judged;
    j->bisect.order = j->order;
}

static struct rg_bisect_kept place(const char *path)
{
    struct rg_bisect_kept kept;
    const char *slash = strrchr(path, '/');
    snprintf(kept.folder, sizeof(kept.folder), "%.*s", (int)(slash - path), path);
    snprintf(kept.name, sizeof(kept.name), "%s", slash + 1);
    return kept;
}

static void check(const struct judged *j)
{
    if (j->bisect.order_count < 0 || j->bisect.order_count > COUNT)
        fuzz_complain("more verdicts than candidates");
    if (j->bisect.order_count && j->judged[0].verdict == RG_JUDGED_NONE)
        fuzz_complain("taken without the good end");
    for (int64_t i = 0; i < j->bisect.order_count; i++) {
        const struct rg_judged *one = &j->judged[j->order[i]];
        if (one->verdict < RG_JUDGED_GOOD || one->verdict > RG_JUDGED_SKIP || one->tries < 1 ||
            one->tries > judging.tries || !(one->seconds >= 0))
            fuzz_complain("a verdict that cannot be");
    }
}

static void check_again(const struct judged *j)
{
    struct judged again;
    const struct rg_bisect_kept kept = place(fuzz_write("again.journal", NULL, 0));
    begin(&again);
    fuzz_listen();
    if (!rg_bisect_kept_write(&kept, &j->bisect))
        fuzz_complain("taken, and cannot be written");
    rg_bisect_kept_take(&kept, &again.bisect);
    fuzz_judge_lines(true, 0);
    if (again.bisect.order_count != j->bisect.order_count ||
        memcmp(again.order, j->order, sizeof(j->order)) != 0)
        fuzz_complain("taken, written and taken as another");
}

static void read_journal(const char *text, size_t size)
{
    struct judged j;
    const struct rg_bisect_kept kept =
        place(fuzz_write("bisect.journal", (const uint8_t *)text, size));
    begin(&j);
    fuzz_listen();
    rg_bisect_kept_take(&kept, &j.bisect);
    fuzz_judge_lines(true, COUNT + 1); // a candidate each that has changed
    check(&j);
    if (j.bisect.order_count)
        check_again(&j);
}

// The key of this bisect, from what it writes; released by the caller.
static json_t *key(void)
{
    char why[RG_WHY_SIZE];
    struct judged j;
    const char *path = fuzz_write("key.journal", NULL, 0);
    const struct rg_bisect_kept kept = place(path);
    begin(&j);
    if (!rg_bisect_kept_write(&kept, &j.bisect))
        fuzz_complain("nothing is judged, and that cannot be written");
    json_t *document = rg_document_read(path, "", why);
    json_t *found = json_incref(json_object_get(document, "key"));
    json_decref(document);
    return found;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_journal((const char *)data, size);
    json_t *document = json_loadb((const char *)data, size, 0, NULL);
    if (json_is_object(document))
        json_object_set_new(document, "key", key());
    char *text = json_is_object(document) && rg_seal(document) ? json_dumps(document, 0) : NULL;
    if (text)
        read_journal(text, strlen(text));
    free(text);
    json_decref(document);
    return 0;
}
