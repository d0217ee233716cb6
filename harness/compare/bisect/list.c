#include "harness/compare/bisect/list.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/plain.h"

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
    bool ok = rg_lines_read(path, &candidates->lines);
    for (int64_t i = 0; ok && i < candidates->lines.count; i++) {
        const struct rg_line *line = &candidates->lines.lines[i];
        ok = rg_line_is_empty(line) || rg_candidates_add(rg_line_skip(line->text), candidates);
    }
    return ok && (candidates->count ||
                  rg_error("%s: names no candidate; write one a line, in order", path));
}

// --- between the ends ---

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool has_each_once(const struct rg_candidates *candidates)
{
    const size_t size = sizeof(*candidates->names);
    const char **sorted = rg_alloc((size_t)candidates->count, size, "candidates");
    bool ok = sorted != NULL;
    if (ok && candidates->count) {
        memcpy(sorted, candidates->names, (size_t)candidates->count * size);
        qsort(sorted, (size_t)candidates->count, size, compare_names);
    }
    for (int64_t i = 1; ok && i < candidates->count; i++)
        ok = strcmp(sorted[i - 1], sorted[i]) ||
             rg_error("bisect: the candidate '%s' is there twice; name each once", sorted[i]);
    free(sorted);
    return ok;
}

static int64_t place_of(const char *name, const struct rg_candidates *candidates)
{
    for (int64_t i = 0; i < candidates->count; i++)
        if (!strcmp(candidates->names[i], name))
            return i;
    return -1;
}

// Puts the ends before and after the candidates.
static bool put_around(const char *good, const char *bad, struct rg_candidates *candidates)
{
    if (!rg_candidates_add(good, candidates) || !rg_candidates_add(bad, candidates))
        return false;
    memmove(candidates->names + 1, candidates->names,
            (size_t)(candidates->count - 2) * sizeof(*candidates->names));
    candidates->names[0] = good;
    return true;
}

static void turn_around(struct rg_candidates *candidates)
{
    for (int64_t i = 0, j = candidates->count - 1; i < j; i++, j--) {
        const char *name = candidates->names[i];
        candidates->names[i] = candidates->names[j];
        candidates->names[j] = name;
    }
}

static void cut(int64_t first, int64_t last, struct rg_candidates *candidates)
{
    candidates->count = last - first + 1;
    memmove(candidates->names, candidates->names + first,
            (size_t)candidates->count * sizeof(*candidates->names));
}

bool rg_candidates_between(const char *good, const char *bad, struct rg_candidates *candidates)
{
    const int64_t from = place_of(good, candidates), to = place_of(bad, candidates);
    if (!strcmp(good, bad))
        return rg_error("--good and --bad are both '%s'; name two candidates", good);
    if (!has_each_once(candidates))
        return false;
    if (from < 0 && to < 0)
        return put_around(good, bad, candidates);
    if (from < 0 || to < 0)
        return rg_error("--%s '%s' is not among the candidates, and the other end is; write it as "
                        "they have it",
                        from < 0 ? "good" : "bad", from < 0 ? good : bad);
    cut(from < to ? from : to, from < to ? to : from, candidates);
    if (from > to)
        turn_around(candidates);
    return true;
}

void rg_candidates_free(struct rg_candidates *candidates)
{
    free(candidates->names);
    rg_lines_free(&candidates->lines);
    *candidates = (struct rg_candidates){.count = 0};
}
