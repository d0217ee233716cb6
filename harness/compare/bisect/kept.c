#include "harness/compare/bisect/kept.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include "core/base/log.h"
#include "harness/compare/bisect/stamp.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/hold.h"
#include "harness/record/disk/seal.h"
#include "harness/record/named.h"
#include "harness/record/output.h"
#include "harness/record/passport/passport.h"

enum { FORMAT = 1, STAMP_SIZE = 17 };

static uint64_t hash_text(const char *text, uint64_t seed)
{
    return XXH3_64bits_withSeed(text, strlen(text) + 1, seed);
}

// Candidates and commands have names that hang on where they stand.
static void current_folder(char folder[PATH_MAX])
{
    if (!getcwd(folder, PATH_MAX))
        *folder = 0;
}

void rg_bisect_kept_find(const struct rg_bisect *bisect, struct rg_bisect_kept *kept)
{
    const struct rg_judging *j = bisect->judging;
    char settings[64], current[PATH_MAX];
    current_folder(current);
    snprintf(settings, sizeof(settings), "%.9g %d %d", j->budget_s, j->tries, j->crash_is_bad);
    uint64_t hash = hash_text(current, hash_text(settings, hash_text(j->line, 0)));
    for (int64_t i = 0; i < bisect->candidates->count; i++)
        hash = hash_text(bisect->candidates->names[i], hash);
    rg_state_folder(kept->folder, sizeof(kept->folder));
    snprintf(kept->name, sizeof(kept->name), "bisect-%016" PRIx64 ".journal", hash);
}

static bool path_of(const struct rg_bisect_kept *kept, char *path, size_t size)
{
    return *kept->folder && snprintf(path, size, "%s/%s", kept->folder, kept->name) < (int)size;
}

// What decides the verdicts, as a document: the caller owns it.
static json_t *key_of(const struct rg_bisect *b)
{
    const struct rg_judging *j = b->judging;
    json_t *names = json_array();
    char current[PATH_MAX];
    current_folder(current);
    for (int64_t i = 0; i < b->candidates->count; i++)
        json_array_append_new(names, rg_json_text(b->candidates->names[i]));
    return json_pack("{so so so so si sb so}", "passport", rg_passport_json(NULL, 0), "folder",
                     rg_json_text(current), "command", rg_json_text(j->line), "budget_s",
                     rg_number_json(rg_number_kept(j->budget_s)), "tries", j->tries, "crash_is_bad",
                     j->crash_is_bad, "candidates", names);
}

static void stamp_text(uint64_t stamp, char text[STAMP_SIZE])
{
    snprintf(text, STAMP_SIZE, "%016" PRIx64, stamp);
}

// --- reading ---

static enum rg_judgement verdict_named(const char *name)
{
    for (int v = RG_JUDGED_GOOD; v <= RG_JUDGED_SKIP; v++)
        if (!strcmp(rg_judgement_name((enum rg_judgement)v), name))
            return (enum rg_judgement)v;
    return RG_JUDGED_NONE;
}

// Whether a verdict is what its status says, within what the bisect tries.
static bool can_be(const struct rg_judged *judged, const struct rg_judging *judging)
{
    const enum rg_judgement said = rg_judgement_of(judged->status, judging->crash_is_bad);
    return judged->status >= 0 && judged->status <= 255 && judged->tries >= 1 &&
           judged->tries <= judging->tries && judged->seconds >= 0 && isfinite(judged->seconds) &&
           judged->verdict == (said == RG_JUDGED_AGAIN ? RG_JUDGED_SKIP : said);
}

// Takes a verdict of the document, unless its candidate has changed since. False where it cannot
// be.
static bool take_verdict(json_t *verdict, struct rg_bisect *b)
{
    json_int_t at;
    const char *word, *stamp;
    char now[STAMP_SIZE];
    struct rg_judged judged;
    if (json_unpack(verdict, "{sI ss si si sF ss}", "at", &at, "verdict", &word, "status",
                    &judged.status, "tries", &judged.tries, "seconds", &judged.seconds, "stamp",
                    &stamp) ||
        at < 0 || at >= b->candidates->count || b->judged[at].verdict != RG_JUDGED_NONE)
        return false;
    judged.verdict = verdict_named(word);
    if (!can_be(&judged, b->judging))
        return false;
    judged.stamp = rg_candidate_stamp(b->candidates->names[at]);
    stamp_text(judged.stamp, now);
    if (strcmp(stamp, now) != 0) {
        rg_info("%s: has changed since it was judged; it is judged anew", b->candidates->names[at]);
        return true;
    }
    b->judged[at] = judged;
    b->order[b->order_count++] = at;
    return true;
}

static void forget(struct rg_bisect *b)
{
    memset(b->judged, 0, (size_t)b->candidates->count * sizeof(*b->judged));
    b->order_count = 0;
}

static bool take_verdicts(json_t *document, struct rg_bisect *b)
{
    json_t *verdicts = json_object_get(document, "verdicts"), *verdict;
    bool ok = json_is_array(verdicts);
    size_t i;
    json_array_foreach(verdicts, i, verdict)
    {
        ok = ok && take_verdict(verdict, b);
    }
    // A command may hold each candidate against the good end, which is judged first.
    if (!ok || b->judged[0].verdict == RG_JUDGED_NONE)
        forget(b);
    return ok;
}

static void take_document(json_t *document, const char *path, struct rg_bisect *bisect)
{
    json_t *key = key_of(bisect);
    const json_t *format = json_object_get(document, "format");
    if (json_is_integer(format) && json_integer_value(format) != FORMAT)
        rg_info("%s: has format %" JSON_INTEGER_FORMAT
                " of a bisect's journal, and this is %d; the "
                "bisect begins anew",
                path, json_integer_value(format), FORMAT);
    else if (!json_equal(json_object_get(document, "key"), key))
        rg_info("%s: is of another raingauge, machine or environment; the bisect begins anew",
                path);
    else if (!take_verdicts(document, bisect))
        rg_warning("%s: has a verdict that cannot be; the bisect begins anew", path);
    json_decref(key);
}

int64_t rg_bisect_kept_take(const struct rg_bisect_kept *kept, struct rg_bisect *bisect)
{
    char path[sizeof(kept->folder) + sizeof(kept->name)], why[RG_WHY_SIZE];
    if (!path_of(kept, path, sizeof(path)) || access(path, F_OK) != 0)
        return 0;
    json_t *document = rg_document_read(path, "remove it", why);
    if (document)
        take_document(document, path, bisect);
    else
        rg_warning("%s; the bisect begins anew", why);
    json_decref(document);
    return bisect->order_count;
}

// --- writing ---

static json_t *verdicts_of(const struct rg_bisect *b)
{
    json_t *all = json_array();
    for (int64_t i = 0; i < b->order_count; i++) {
        const int64_t at = b->order[i];
        const struct rg_judged *judged = &b->judged[at];
        char stamp[STAMP_SIZE];
        stamp_text(judged->stamp, stamp);
        json_array_append_new(all, json_pack("{sI ss si si so ss}", "at", (json_int_t)at, "verdict",
                                             rg_judgement_name(judged->verdict), "status",
                                             judged->status, "tries", judged->tries, "seconds",
                                             rg_number_json(judged->seconds), "stamp", stamp));
    }
    return all;
}

bool rg_bisect_kept_write(const struct rg_bisect_kept *kept, const struct rg_bisect *bisect)
{
    if (!*kept->folder)
        return true;
    json_t *document = json_pack("{si so so}", "format", FORMAT, "key", key_of(bisect), "verdicts",
                                 verdicts_of(bisect));
    char *text =
        document && rg_seal(document) ? json_dumps(document, RG_JSON_FLAGS | JSON_COMPACT) : NULL;
    const bool ok =
        text ? rg_output_write(kept->folder, kept->name, text)
             : rg_harness_error("bisect: no memory for the verdicts; close other programs");
    free(text);
    json_decref(document);
    return ok;
}

void rg_bisect_kept_remove(const struct rg_bisect_kept *kept)
{
    char path[sizeof(kept->folder) + sizeof(kept->name)];
    if (path_of(kept, path, sizeof(path)))
        unlink(path);
}
