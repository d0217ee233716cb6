// Judges one candidate of a bisect by a command.
#ifndef RG_HARNESS_COMPARE_BISECT_VERDICT_H
#define RG_HARNESS_COMPARE_BISECT_VERDICT_H

#include <stdbool.h>
#include <stdint.h>

// Environment variables that pass a candidate to the command. The shell expands a quoted variable
// to one word, so a candidate's name is never run as code.
#define RG_VARIABLE_CANDIDATE "RG_CANDIDATE"
#define RG_VARIABLE_GOOD      "RG_GOOD"
#define RG_VARIABLE_BUDGET    "RG_BUDGET"

enum rg_judgement {
    RG_JUDGED_NONE, // not judged yet
    RG_JUDGED_GOOD,
    RG_JUDGED_BAD,
    RG_JUDGED_SKIP,  // the candidate cannot be judged
    RG_JUDGED_AGAIN, // more has to be measured
    RG_JUDGED_STOP,  // the command is wrong or was interrupted; no candidate can be judged
};

// "good": the same words in all forms.
const char *rg_judgement_name(enum rg_judgement verdict);

struct rg_judging {
    const char *line; // for the shell
    double budget_s;  // RG_BUDGET of the first try, doubled for each further try
    int tries;        // at most
    bool crash_is_bad;
    bool prints_here; // the command's stdout goes to ours, else to stderr
};

struct rg_judged {
    enum rg_judgement verdict; // never again, which becomes skip after the last try
    int status;                // of the last try; 128 plus the number of a signal that ended it
    int tries;
    double seconds;
    int64_t at; // index of the candidate in its list
};

// Judges a candidate by the command's exit status: 0 good, 1 bad, 3 again, 4, 77 and 125 skip. A
// process that a signal ended, or a status above 128, which shells report for one, is skip or, with
// `crash_is_bad`, bad. All others are stop, and so, with one logged line, is a shell that cannot be
// started. The command gets the candidate as RG_CANDIDATE, and the good end as RG_GOOD; NULL: not
// set. A signal to raingauge (harness/console/interrupt.h) ends the command first.
struct rg_judged rg_judge(const struct rg_judging *judging, const char *candidate,
                          const char *good);

// The exit status of a verdict inside `git bisect run`. git reads 125 as skip and other values from
// 1 to 127 as bad; higher ones end the bisect (git-bisect(1)).
int rg_judgement_git(enum rg_judgement verdict);
// The exit status for a logged error. While git bisects the repository of the current folder it is
// that of stop; otherwise git would take a misspelt option for a bad commit at every step.
int rg_bisect_status_of_error(void);

#endif
