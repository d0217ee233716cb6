#include "harness/compare/bisect/kept.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "core/base/log.h"
#include "harness/record/disk/hold.h"
#include "harness/record/output.h"

static uint64_t hash_text(const char *text, uint64_t seed)
{
    return XXH3_64bits_withSeed(text, strlen(text) + 1, seed);
}

void rg_bisect_kept_find(const struct rg_bisect *bisect, struct rg_bisect_kept *kept)
{
    const struct rg_judging *j = bisect->judging;
    char settings[64];
    snprintf(settings, sizeof(settings), "%.9g %d %d", j->budget_s, j->tries, j->crash_is_bad);
    uint64_t hash = hash_text(settings, hash_text(j->line, 0));
    for (int64_t i = 0; i < bisect->candidates->count; i++)
        hash = hash_text(bisect->candidates->names[i], hash);
    rg_state_folder(kept->folder, sizeof(kept->folder));
    snprintf(kept->name, sizeof(kept->name), "bisect-%016" PRIx64 ".txt", hash);
}

static bool path_of(const struct rg_bisect_kept *kept, char *path, size_t size)
{
    return *kept->folder && snprintf(path, size, "%s/%s", kept->folder, kept->name) < (int)size;
}

// --- reading ---

static enum rg_judgement verdict_named(const char *name)
{
    for (int v = RG_JUDGED_GOOD; v <= RG_JUDGED_SKIP; v++)
        if (!strcmp(rg_judgement_name((enum rg_judgement)v), name))
            return (enum rg_judgement)v;
    return RG_JUDGED_NONE;
}

// Takes "good 3 0 1 12.5 NAME": the verdict, the candidate's number, the command's status, tries,
// seconds.
static bool take_line(const char *text, struct rg_bisect *b)
{
    char word[8];
    long long at;
    int used = 0;
    struct rg_judged judged;
    if (sscanf(text, "%7s %lld %d %d %lf %n", word, &at, &judged.status, &judged.tries,
               &judged.seconds, &used) != 5 ||
        at < 0 || at >= b->candidates->count || strcmp(text + used, b->candidates->names[at]))
        return false;
    judged.verdict = verdict_named(word);
    if (judged.verdict == RG_JUDGED_NONE || b->judged[at].verdict != RG_JUDGED_NONE)
        return false;
    b->judged[at] = judged;
    b->order[b->order_count++] = at;
    return true;
}

static void forget(struct rg_bisect *b)
{
    memset(b->judged, 0, (size_t)b->candidates->count * sizeof(*b->judged));
    b->order_count = 0;
}

int64_t rg_bisect_kept_take(const struct rg_bisect_kept *kept, struct rg_bisect *bisect)
{
    char path[sizeof(kept->folder) + sizeof(kept->name)];
    struct rg_lines lines = {.count = 0};
    if (!path_of(kept, path, sizeof(path)) || access(path, F_OK) != 0)
        return 0;
    bool ok = rg_lines_read(path, &lines);
    for (int64_t i = 0; ok && i < lines.count; i++)
        ok = rg_line_is_empty(&lines.lines[i]) || take_line(lines.lines[i].text, bisect);
    rg_lines_free(&lines);
    if (!ok) {
        forget(bisect);
        rg_warning("%s: is damaged; the bisect begins anew", path);
    }
    return bisect->order_count;
}

// --- writing ---

static void print(const struct rg_bisect *b, FILE *out)
{
    fprintf(out, "# raingauge bisect: verdicts so far; the same command goes on from them\n");
    for (int64_t i = 0; i < b->order_count; i++) {
        const int64_t at = b->order[i];
        const struct rg_judged *judged = &b->judged[at];
        fprintf(out, "%s %lld %d %d %.3f %s\n", rg_judgement_name(judged->verdict), (long long)at,
                judged->status, judged->tries, judged->seconds, b->candidates->names[at]);
    }
}

bool rg_bisect_kept_write(const struct rg_bisect_kept *kept, const struct rg_bisect *bisect)
{
    if (!*kept->folder)
        return true;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out)
        print(bisect, out);
    const bool is_made = out && !ferror(out);
    const bool ok = out && fclose(out) == 0 && is_made
                        ? rg_output_write(kept->folder, kept->name, text)
                        : rg_error("bisect: no memory for the verdicts; close other programs");
    free(text);
    return ok;
}

void rg_bisect_kept_remove(const struct rg_bisect_kept *kept)
{
    char path[sizeof(kept->folder) + sizeof(kept->name)];
    if (path_of(kept, path, sizeof(path)))
        unlink(path);
}
