// Expectations of a gate: known failures, flakes and skips, each with its reason, evidence and
// expiry. docs/expectations.md describes the format. Nothing here reads a clock or opens a device.
#ifndef RG_HARNESS_COMPARE_GATE_EXPECTED_EXPECTED_H
#define RG_HARNESS_COMPARE_GATE_EXPECTED_EXPECTED_H

#include <stdio.h>

#include "core/base/outcome.h"
#include "core/base/files/lines.h"
#include "harness/compare/gate/text/regex.h"
#include "harness/record/ending.h"

enum rg_known_form {
    RG_FORM_OWN,    // docs/expectations.md
    RG_FORM_FAILS,  // Mesa's *-fails.txt: "test,Fail" lines
    RG_FORM_FLAKES, // Mesa's *-flakes.txt: regular expressions
    RG_FORM_SKIPS,  // Mesa's *-skips.txt: regular expressions
};
enum { RG_FORMS = RG_FORM_SKIPS + 1 };

enum rg_known_kind { RG_EXPECT_SKIP, RG_EXPECT_FLAKE, RG_EXPECT_FAIL };

// The fields of an expectation, in the order in which they are written.
enum rg_known_field {
    RG_FIELD_DEVICE,
    RG_FIELD_DRIVER,
    RG_FIELD_OUTCOME,
    RG_FIELD_PIXELS,
    RG_FIELD_DIFFERENCE,
    RG_FIELD_REASON,
    RG_FIELD_LINK,
    RG_FIELD_SINCE,
    RG_FIELD_UNTIL,
};
enum { RG_FIELD_COUNT = RG_FIELD_UNTIL + 1 };

// Smallest and largest accepted value, inclusive.
struct rg_envelope {
    double least, most;
};

struct rg_expectation {
    enum rg_known_kind kind;
    int file;                           // in rg_known.files
    int64_t line, line_count;           // in the file, from 0
    const char *cell;                   // a pattern (rg_glob); in Mesa's fails the exact name
    struct rg_regex *regex;             // in Mesa's flakes and skips, in place of `cell`
    const char *values[RG_FIELD_COUNT]; // as written in the file; NULL: not given
    int64_t at[RG_FIELD_COUNT];         // the line of each field
    unsigned outcomes;                  // bit 1 << enum rg_outcome is set for each expected outcome
    struct rg_envelope pixels, difference; // valid if values[] has the field
    int since, until; // days (harness/compare/gate/text/date.h); INT_MAX: no end
};

struct rg_known {
    int file_count;
    struct rg_known_file {
        enum rg_known_form form;
        struct rg_lines lines; // owned; the rows' texts point into it
    } files[16];
    int64_t count, room;
    struct rg_expectation *rows; // ordered by file, then by line
};

// A gate's result for a cell on a device.
struct rg_known_result {
    const char *cell;   // "streaks/rain-128"
    const char *device; // "vulkan", "vulkan@VK_DRIVER_FILES=old.json"
    const char *driver; // as in the passport: "Mesa 22.3.6"; NULL: the cell was skipped or could
                        // not run, so nothing is known and the outcome is unsupported
    enum rg_outcome outcome;
    double pixels;     // number of differing pixels; NAN: not measured
    double difference; // largest difference of a channel; NAN: not measured
    bool is_foreign;   // the failure is not this device's driver's, so expectations do not apply
};

// How a case ends by its expectation: an expected failure, an unexpected pass, a flake in
// quarantine, skipped, or as if nothing were expected.
struct rg_judged {
    enum rg_ending ending;
    bool applies;    // an expectation matched this result
    bool is_expired; // which is past its `until` day
};

// Adds a file. A refused file adds nothing: false, and one logged line "FILE:LINE: what; mend".
// `expected` must be zeroed before the first call.
bool rg_known_add(struct rg_known *expected, const char *path, enum rg_known_form form);
// The same for a text in memory, which is copied.
bool rg_known_add_text(struct rg_known *expected, const char *name, const char *text, size_t size,
                       enum rg_known_form form);
void rg_known_free(struct rg_known *expected);

// Checks before any work that every regular expression can be searched for in this cell's name.
// False, and one logged line with the expression's place, if a search takes too long: such an
// expression would match no name of this kind.
bool rg_known_can_search(const struct rg_known *expected, const char *cell);

// The row that applies to a cell on this day; -1: none. Rows whose `since` is still to come do not
// match. If several match, a skip wins over a flake and a flake over a failure, then the first
// wins.
int64_t rg_known_row(const struct rg_known *expected, const char *cell, const char *device,
                     const char *driver, int today);
// Whether a row forbids running its cell on this day; false for row -1.
bool rg_known_skips(const struct rg_known *expected, int64_t row, int today);

// How a result that would have ended as `own` ends by its row, -1 for none, on this day.
struct rg_judged rg_known_judge(const struct rg_known *expected, int64_t row,
                                const struct rg_known_result *result, enum rg_ending own,
                                int today);
// "expected", "fixed", "fails differently", "expired", "flaky", "skipped"; "" if none applies.
const char *rg_judged_word(const struct rg_judged *judged);

// Rewrites a file so that it is true of these results. Rows whose failure is fixed are removed;
// rows that fail differently get the new evidence; expired rows get 90 more days, or are removed if
// they are skips or have passed. Expectations of cells without a known result remain. With
// `adds_new`, unexpected failures are appended. All other bytes stay the same.
//
// The caller frees the text. It is NULL if nothing has to change, and for Mesa's flakes and skips.
// False, and one logged line, without memory.
bool rg_known_mend(const struct rg_known *expected, int file, const struct rg_known_result *results,
                   int64_t count, int today, bool adds_new, char **text);

#endif
