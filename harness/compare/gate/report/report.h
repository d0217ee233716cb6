// A gate's results as plain data, and the forms in which CI systems read them. No device is
// needed.
//
// A report is filled case by case, then written in any of the forms below. docs/ci.md says how
// each form shows each outcome.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_REPORT_H
#define RG_HARNESS_COMPARE_GATE_REPORT_REPORT_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "harness/record/ending.h"

// JUnit's element: "failure" for a wrong result, "error" for no result, "skipped" for one that does
// not count; NULL: passed.
const char *rg_ending_element(enum rg_ending ending);
// The enum rg_exit of a gate whose worst ending this is.
int rg_ending_exit(enum rg_ending ending);

// A number with the ends of its interval; NAN: unknown.
struct rg_bounded {
    double value, low, high;
};

// The fields of a case that was not timed.
#define RG_UNMEASURED                                                                              \
    .ratio = {NAN, NAN, NAN}, .smallest_visible = NAN, .time_ms = {NAN, NAN, NAN},                 \
    .baseline_ms = NAN

struct rg_report_case {
    const char *name; // such as "streaks.small.vulkan@VK_DRIVER_FILES=new.json"
    const char *technique;
    const char *const *devices;
    int device_count;
    double seconds; // run time of the case
    enum rg_ending ending;
    bool is_compared;               // its pictures were; any other end proves nothing
    bool is_over;                   // the time was over before
    const char *message;            // the reason, in one line; "": nothing to say
    const char *details;            // several lines; "": none
    const char *const *attachments; // paths of pictures
    int attachment_count;
    struct rg_bounded ratio;   // B's time divided by A's
    double smallest_visible;   // change that would have been noticed, 0.02 for 2 %; NAN: unknown
    struct rg_bounded time_ms; // median time of a sample of B
    double baseline_ms;        // the same of A, or of B's baseline; NAN: unknown
    // "ratio 1.052 (1.031 to 1.074), would have seen 2 %"; "" if nothing was measured. The report
    // writes this text itself.
    const char *measured;
};

struct rg_report {
    int case_count;
    struct rg_report_case *cases; // in the order in which they were added
    int *order;                   // their indices, worst first, equal ones in the order of adding
    int idle_count;               // cases with an expected failure or flake that compared nothing
    const char *passport;         // of the machine, drivers and program, as text of several lines
    const char *drivers;          // a line for each side's driver and its version; NULL: unknown
    // Owned memory.
    int64_t case_room, order_room, text_room;
    int text_count;
    void **texts;
};

// The longest texts, in bytes: longer ones are cut at a whole character, and say so.
enum { RG_REPORT_NAME = 1000, RG_REPORT_LINE = 4000 };

// Adds a copy of a case; NULL means "". Texts are cleaned here, once, so that each form escapes
// only its own special characters.
// - A byte that is not UTF-8, or a character that XML cannot hold or that steers a terminal,
//   becomes U+FFFD. A control character becomes its picture (U+2400 and on): escape is U+241B.
// - Names, messages, devices and paths are single lines: a line break becomes U+240A, a tab U+2409.
// - A name of more than RG_REPORT_NAME bytes is cut and ends in "..." and a hash of the whole name.
// - A name that exists already gets " (2)", and so on.
// - Other long lines end in "... (N bytes more)".
//
// False, and one logged line, without memory.
bool rg_report_add(struct rg_report *report, const struct rg_report_case *found);
// Adds a case from its JSON form (rg_report_json). False, and one logged line, without memory, or
// if it is none.
bool rg_report_read(struct rg_report *report, const json_t *found);
bool rg_report_has(const struct rg_report *report, const char *name);
bool rg_report_set_passport(struct rg_report *report, const char *passport);
bool rg_report_set_drivers(struct rg_report *report, const char *drivers);
void rg_report_free(struct rg_report *report);

// How many cases have this ending.
int rg_report_count(const struct rg_report *report, enum rg_ending ending);

// "14 cases, 1 crash, 13 pass". Every case that passes, differs or has a ratio was compared. The
// number of expected failures is followed by the number of those that were not compared.
enum { RG_REPORT_SUMMARY = 512 };
void rg_report_summary(const struct rg_report *report, char text[RG_REPORT_SUMMARY]);

// --- the forms; false, and one logged line, if one cannot be written ---

// Writes a form to a stream; forms.h declares all of them.
typedef bool (*rg_report_writer)(const struct rg_report *report, FILE *out);
// Writes a form to a file by renaming a temporary one: the file is complete, or unchanged.
bool rg_report_write(const struct rg_report *report, rg_report_writer form, const char *path);

// The text form, in colours or without.
bool rg_report_text_coloured(const struct rg_report *report, FILE *out, bool is_coloured);
// The document of the JSON form, "gate" in docs/records.schema.json, which the caller owns; NULL
// without memory.
json_t *rg_report_document(const struct rg_report *report);

#endif
