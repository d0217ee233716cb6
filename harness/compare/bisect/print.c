// Prints a bisect's verdicts and result, as text and as JSON.
#include <jansson.h>

#include "core/base/log.h"
#include "harness/compare/bisect/bisect.h"
#include "harness/console/duration.h"
#include "harness/record/named.h"

void rg_bisect_print_verdict(const struct rg_bisect *bisect, const struct rg_judged *j)
{
    char time[RG_DURATION_TEXT];
    printf("%-4s  %s  (exit status %d, %s", rg_judgement_name(j->verdict),
           bisect->candidates->names[j->at], j->status, rg_duration_text(j->seconds, time));
    printf(j->tries > 1 ? ", %d tries)\n" : ")\n", j->tries);
    fflush(stdout);
}

void rg_bisect_print_end(const struct rg_bisect *bisect)
{
    const char *const *names = bisect->candidates->names;
    if (bisect->end == RG_BISECT_FOUND) {
        printf("the first bad one is %s; %s before it is good\n", names[bisect->bad],
               names[bisect->good]);
    } else if (bisect->end == RG_BISECT_AMONG) {
        printf("%s is good; the first bad one is one of these, of which the last alone was "
               "judged:\n",
               names[bisect->good]);
        for (int64_t i = bisect->good + 1; i <= bisect->bad; i++)
            printf("  %s\n", names[i]);
    }
}

// --- JSON ---

static const char *const ends[RG_BISECT_ENDS] = {[RG_BISECT_FOUND] = "found",
                                                 [RG_BISECT_AMONG] = "one of several",
                                                 [RG_BISECT_GOOD_END] = "good is not good",
                                                 [RG_BISECT_BAD_END] = "bad is not bad",
                                                 [RG_BISECT_STOPPED] = "stopped"};

static json_t *judged_json(const struct rg_bisect *b)
{
    json_t *all = json_array();
    for (int64_t i = 0; i < b->count; i++) {
        const struct rg_judged *j = &b->judged[i];
        json_array_append_new(all,
                              json_pack("{so ss si si so}", "candidate",
                                        rg_json_text(b->candidates->names[j->at]), "verdict",
                                        rg_judgement_name(j->verdict), "status", j->status, "tries",
                                        j->tries, "seconds", rg_number_json(j->seconds)));
    }
    return all;
}

// The candidates that may be the first bad one; empty if that is not known.
static json_t *suspects_json(const struct rg_bisect *b)
{
    json_t *all = json_array();
    const bool is_known = b->end == RG_BISECT_FOUND || b->end == RG_BISECT_AMONG;
    for (int64_t i = b->good + 1; is_known && i <= b->bad; i++)
        json_array_append_new(all, rg_json_text(b->candidates->names[i]));
    return all;
}

bool rg_bisect_print_json(const struct rg_bisect *bisect, FILE *out)
{
    const struct rg_candidates *candidates = bisect->candidates;
    json_t *json =
        json_pack("{si so so so si ss so so}", "format", 1, "command",
                  rg_json_text(bisect->judging->line), "good", rg_json_text(candidates->names[0]),
                  "bad", rg_json_text(candidates->names[candidates->count - 1]), "candidates",
                  (int)candidates->count, "end", ends[bisect->end], "first_bad",
                  suspects_json(bisect), "judged", judged_json(bisect));
    const bool is_made =
        json && !json_dumpf(json, out, JSON_INDENT(1) | JSON_REAL_PRECISION(RG_NUMBER_DIGITS));
    json_decref(json);
    fputc('\n', out);
    return is_made ||
           rg_harness_error("JSON: cannot be written; see that there is memory and disk");
}
