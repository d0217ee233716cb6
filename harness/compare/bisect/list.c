// The candidates of a bisect, and which of them is judged next.
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "harness/compare/bisect/bisect.h"

enum { MOST_BYTES = 1 << 16 }; // half of the system's limit for a variable

bool rg_candidates_add(const char *name, struct rg_candidates *candidates)
{
    for (const char *c = name; *c; c++)
        if (rg_control_at(c) >= 0)
            return rg_error("bisect: a candidate has a control character 0x%02x; rename it",
                            (unsigned)rg_control_at(c));
    if (!*name)
        return rg_error("bisect: a candidate has no name; leave it out");
    if (strlen(name) > MOST_BYTES)
        return rg_error("bisect: the candidate '%.40s...' has more than %d bytes; rename it", name,
                        MOST_BYTES);
    if (!rg_array_fit(&candidates->names, &candidates->room, candidates->count + 1,
                      sizeof(*candidates->names), "candidates"))
        return false;
    candidates->names[candidates->count++] = name;
    return true;
}

bool rg_candidates_read(const char *path, struct rg_candidates *candidates)
{
    const int64_t before = candidates->count;
    bool ok = rg_lines_read(path, &candidates->lines);
    for (int64_t i = 0; ok && i < candidates->lines.count; i++) {
        const struct rg_line *line = &candidates->lines.lines[i];
        ok = rg_line_is_empty(line) || rg_candidates_add(rg_line_skip(line->text), candidates);
    }
    return ok && (candidates->count > before ||
                  rg_error("%s: names no candidate; write one a line, in order", path));
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool has_each_once(const char *const *names, int64_t count)
{
    const char **sorted = rg_alloc((size_t)count, sizeof(*names), "candidates");
    for (int64_t i = 0; sorted && i < count; i++)
        sorted[i] = names[i];
    if (sorted)
        qsort(sorted, (size_t)count, sizeof(*names), compare_names);
    bool ok = sorted != NULL;
    for (int64_t i = 1; ok && i < count; i++)
        ok = strcmp(sorted[i - 1], sorted[i]) ||
             rg_error("bisect: the candidate '%s' is there twice; name each once", sorted[i]);
    free(sorted);
    return ok;
}

// The place of a name between the ends; 0: it is not there.
static int64_t place_of(const char *name, const struct rg_candidates *candidates)
{
    int64_t at = candidates->count - 2;
    while (at > 0 && strcmp(candidates->names[at], name) != 0)
        at--;
    return at;
}

// Keeps `from` to `to`, in this order.
static void cut(int64_t from, int64_t to, struct rg_candidates *candidates)
{
    const char **names = candidates->names;
    for (int64_t i = 0, j = candidates->count - 1; from > to && i < j; i++, j--) {
        const char *name = names[i];
        names[i] = names[j];
        names[j] = name;
    }
    const int64_t first = from > to ? candidates->count - 1 - from : from;
    candidates->count = llabs(to - from) + 1;
    memmove(names, names + first, (size_t)candidates->count * sizeof(*names));
}

bool rg_candidates_between(struct rg_candidates *candidates)
{
    const char *good = candidates->names[0], *bad = candidates->names[candidates->count - 1];
    const int64_t from = place_of(good, candidates), to = place_of(bad, candidates);
    if (!strcmp(good, bad))
        return rg_error("--good and --bad are both '%s'; name two candidates", good);
    if (!has_each_once(candidates->names + 1, candidates->count - 2))
        return false;
    if (!from != !to)
        return rg_error("--%s '%s' is not among the candidates, and the other end is; write it as "
                        "they have it",
                        from ? "bad" : "good", from ? bad : good);
    if (from)
        cut(from, to, candidates);
    return true;
}

void rg_candidates_free(struct rg_candidates *candidates)
{
    free(candidates->names);
    rg_lines_free(&candidates->lines);
    *candidates = (struct rg_candidates){.count = 0};
}

struct rg_search rg_search_of(const enum rg_judgement *verdicts, int64_t count)
{
    struct rg_search s = {.next = -1};
    int64_t longest = 0, nearest = 0;
    for (; s.bad < count - 1 && verdicts[s.bad] != RG_JUDGED_BAD; s.bad++)
        s.good = verdicts[s.bad] == RG_JUDGED_GOOD ? s.bad : s.good;
    for (int64_t first = s.good + 1, end; first < s.bad; first = end + 1) {
        for (end = first; end < s.bad && verdicts[end] == RG_JUDGED_NONE;)
            end++;
        const int64_t length = end - first, middle = first + (length - 1) / 2;
        const int64_t distance = llabs(2 * middle - s.good - s.bad);
        if (length > longest || (length == longest && length > 0 && distance < nearest)) {
            s.next = middle;
            longest = length;
            nearest = distance;
        }
        s.left += length;
    }
    for (int64_t left = s.left; left > 0; left /= 2)
        s.steps++;
    return s;
}
