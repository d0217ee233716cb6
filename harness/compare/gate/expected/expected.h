// What a gate expects to go wrong: failures, flakes and skips that are known, with reason, evidence
// and expiry. docs/expectations.md has the format. Nothing here looks at a clock or a device.
#ifndef RG_HARNESS_COMPARE_GATE_EXPECTED_EXPECTED_H
#define RG_HARNESS_COMPARE_GATE_EXPECTED_EXPECTED_H

#include <stdio.h>

#include "core/base/outcome.h"
#include "harness/compare/gate/text/lines.h"
#include "harness/compare/gate/text/regex.h"

enum rg_known_form {
    RG_FORM_OWN,    // docs/expectations.md
    RG_FORM_FAILS,  // Mesa's *-fails.txt: "test,Fail" lines
    RG_FORM_FLAKES, // Mesa's *-flakes.txt: regular expressions
    RG_FORM_SKIPS,  // Mesa's *-skips.txt: regular expressions
};

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

// Least and most, both within it.
struct rg_envelope {
    double least, most;
};

struct rg_expectation {
    enum rg_known_kind kind;
    int file;                           // in rg_known.files
    int64_t line, line_count;           // in the file, from 0
    const char *cell;                   // a pattern (rg_glob), or of Mesa's fails the name itself
    struct rg_regex *regex;             // of Mesa's flakes and skips, instead of `cell`
    const char *values[RG_FIELD_COUNT]; // as they stand in the file; NULL: not given
    int64_t at[RG_FIELD_COUNT];         // their lines
    unsigned outcomes;                  // a bit, 1 << enum rg_outcome, for each that is expected
    struct rg_envelope pixels, difference; // where values[] has them
    int since, until; // days (harness/compare/gate/text/date.h); INT_MAX: no end
};

struct rg_known {
    int file_count;
    struct rg_known_file {
        enum rg_known_form form;
        struct rg_lines lines; // owned; texts of the rows lie in it
    } files[16];
    int64_t count, room;
    struct rg_expectation *rows; // file by file, in the order of their lines
};

// What was measured of a cell on a device.
struct rg_known_result {
    const char *cell;   // "streaks/rain-128"
    const char *device; // "vulkan", "vulkan@VK_DRIVER_FILES=old.json"
    const char *driver; // as the passport has it: "Mesa 22.3.6"; NULL: it was not to run here, or
                        // could not, so that nothing is known of it, and the outcome unsupported
    enum rg_outcome outcome;
    double pixels;     // that differ; NAN: not measured
    double difference; // the largest of a channel; NAN: not measured
    bool is_foreign;   // what failed is not this device's driver: nothing is expected of that
};

// How a result meets what is expected.
enum rg_met {
    RG_MET_NOTHING,   // nothing is expected: the result stands for itself
    RG_MET_EXPECTED,  // it fails, as expected
    RG_MET_FIXED,     // it passes, and was expected to fail
    RG_MET_DIFFERENT, // it fails in another way: another outcome, or outside the envelope
    RG_MET_EXPIRED,   // what is expected was to be looked at again by now
    RG_MET_FLAKY,     // quarantined: whatever came of it is reported and decides nothing
    RG_MET_SKIPPED,   // it was not to run
};

// Adds a file. False, and one logged line "FILE:LINE: what; mend", where it is refused; then
// nothing of it is added. `expected` is zeroed at first.
bool rg_known_add(struct rg_known *expected, const char *path, enum rg_known_form form);
// The same of a text in memory, which is copied.
bool rg_known_add_text(struct rg_known *expected, const char *name, const char *text, size_t size,
                       enum rg_known_form form);
void rg_known_free(struct rg_known *expected);

// Whether all regular expressions can be searched for in a cell's name, which is asked before any
// work. False, and one logged line with the file's, where one takes too long: for no name like that
// does it hold.
bool rg_known_can_search(const struct rg_known *expected, const char *cell);

// The row that holds for a cell on this day: of several, a skip before a flake before a failure,
// and then the first. -1: none; one that begins later does not hold yet.
int64_t rg_known_row(const struct rg_known *expected, const char *cell, const char *device,
                     const char *driver, int today);
// Whether a row keeps its cell from running on this day; false for row -1.
bool rg_known_skips(const struct rg_known *expected, int64_t row, int today);

// How a result meets its row, -1 for none, on this day.
enum rg_met rg_known_judge(const struct rg_known *expected, int64_t row,
                           const struct rg_known_result *result, int today);
// "none", "expected", "fixed", "fails differently", "expired", "flaky", "skipped".
const char *rg_met_name(enum rg_met met);
// Whether the gate fails by it. What met nothing fails by its own outcome: wrong or broken does,
// and unsupported does not.
bool rg_met_fails(enum rg_met met, enum rg_outcome outcome);

// What a file has to say so that it is true of these results: rows that are fixed go; rows that
// fail otherwise get the new evidence; what has expired gets 90 days, or goes if it is a skip or
// has passed. What a row expects of cells of which nothing is known stays expected. With
// `adds_new`, failures that nothing expects are added at the end. All other bytes stay. The caller
// frees the text, which is NULL where the file is true, or is none of ours or of Mesa's fails.
// False, and one logged line, without memory.
bool rg_known_mend(const struct rg_known *expected, int file, const struct rg_known_result *results,
                   int64_t count, int today, bool adds_new, char **text);

#endif
