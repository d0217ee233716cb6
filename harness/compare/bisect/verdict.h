// One candidate of a bisect, judged by a command.
#ifndef RG_HARNESS_COMPARE_BISECT_VERDICT_H
#define RG_HARNESS_COMPARE_BISECT_VERDICT_H

#include <stdbool.h>
#include <stdint.h>

// Variables hand each candidate to the command: the shell takes one in quotes for one word, so that
// no name of a candidate is ever read as code.
#define RG_VARIABLE_CANDIDATE "RG_CANDIDATE"
#define RG_VARIABLE_GOOD      "RG_GOOD"
#define RG_VARIABLE_BUDGET    "RG_BUDGET"

enum rg_judgement {
    RG_JUDGED_NONE, // not judged yet
    RG_JUDGED_GOOD,
    RG_JUDGED_BAD,
    RG_JUDGED_SKIP,  // it cannot be judged
    RG_JUDGED_AGAIN, // not with so much measured
    RG_JUDGED_STOP,  // no candidate could be: the command is wrong, or was asked to end
};
enum { RG_JUDGED_COUNT = RG_JUDGED_STOP + 1 };

// "good": the words of all forms.
const char *rg_judgement_name(enum rg_judgement verdict);

// What the exit status of a command says: 0 good, 1 bad, 3 again, 4, 77 and 125 skip; a process
// that a signal ended, or a status above 128, as shells tell of such a process, skip or, where
// `crash_is_bad`, bad; all else stop.
enum rg_judgement rg_judgement_of(int status, bool crash_is_bad);

struct rg_judging {
    const char *line; // for the shell
    double budget_s;  // RG_BUDGET at the first try; each further has twice as much
    int tries;        // at most
    bool crash_is_bad;
    bool prints_here; // what the command prints to stdout comes to ours; else to stderr
};

struct rg_judged {
    enum rg_judgement verdict; // never again: what is so after the last try is skipped
    int status;                // of the last try: 128 and the number of a signal that ended it
    int tries;
    double seconds;
    int64_t at; // of the candidate, in its list
};

// RG_BUDGET of a try, counted from 0.
void rg_judging_budget(const struct rg_judging *judging, int number, char budget[32]);

// Judges a candidate, which the command gets as RG_CANDIDATE, and the good end as RG_GOOD; NULLs
// where there are none. Its verdict is stop, too, and one line is logged, where the shell cannot be
// started. A signal that asks raingauge to end
// (harness/console/interrupt.h) ends the command first.
struct rg_judged rg_judge(const struct rg_judging *judging, const char *candidate,
                          const char *good);

#endif
