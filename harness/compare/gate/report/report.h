// What a gate found, as plain data, and the forms in which CI systems read it. No device is needed.
//
// A report is filled case by case, and then written in any of the forms below. docs/ci.md says how
// each form tells each outcome.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_REPORT_H
#define RG_HARNESS_COMPARE_GATE_REPORT_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

// How a case ended, the worst first: those who read three lines read these first.
enum rg_ending {
    RG_ENDING_CRASH,
    RG_ENDING_TIMEOUT,
    RG_ENDING_ERROR,
    RG_ENDING_LACKING,         // raingauge itself lacked memory, a process, a descriptor or disk
    RG_ENDING_DIFFERS,         // other pictures, states or counters
    RG_ENDING_UNEXPECTED_PASS, // it was expected to fail
    RG_ENDING_NOTHING_MEASURED,
    RG_ENDING_REGRESSED,
    RG_ENDING_INCONCLUSIVE,
    RG_ENDING_FLAKE, // it is known to fail now and then
    RG_ENDING_EXPECTED_FAILURE,
    RG_ENDING_UNSUPPORTED,
    RG_ENDING_SKIPPED,
    RG_ENDING_IMPROVED,
    RG_ENDING_PASS,
};
enum { RG_ENDING_COUNT = RG_ENDING_PASS + 1 };

// "unexpected pass": the words of all forms.
const char *rg_ending_name(enum rg_ending ending);
// JUnit's word for it: "failure" where the result is wrong, "error" where there is none, "skipped"
// where there is none that counts; NULL: it passes.
const char *rg_ending_element(enum rg_ending ending);
// An enum rg_exit: how a gate ends that has nothing worse.
int rg_ending_exit(enum rg_ending ending);
// Whether it is a failure or an error.
bool rg_ending_fails(enum rg_ending ending);

// A number with the ends of its interval; NAN: unknown.
struct rg_bounded {
    double value, low, high;
};

struct rg_report_case {
    const char *name; // such as "streaks.small.vulkan@VK_DRIVER_FILES=new.json"
    const char *technique;
    const char *const *devices;
    int device_count;
    double seconds; // that it took
    enum rg_ending ending;
    const char *message;            // why, in one line; "": nothing to say
    const char *details;            // of several lines; ""
    const char *const *attachments; // paths of pictures
    int attachment_count;
    struct rg_bounded ratio;   // time of what is tested over that of what it is held against
    double smallest_visible;   // change that could have been seen, 0.02 for 2 %; NAN: unknown
    struct rg_bounded time_ms; // median time of a sample of what is tested
    double baseline_ms;        // the same of what it is held against; NAN: unknown
    // "ratio 1.052 (1.031 to 1.074), would have seen 2 %": what was measured; "" where nothing was.
    // The report makes it.
    const char *measured;
};

struct rg_report {
    int case_count;
    struct rg_report_case *cases; // in the order in which they were added
    int idle_count;       // of those that are expected to fail, or may, such that compared nothing
    const char *passport; // what the numbers depend on, as text of several lines
    // Owned memory.
    int64_t case_room, text_room;
    int text_count;
    void **texts;
};

// The longest texts, in bytes: what is longer is cut at a whole character and says so.
enum { RG_REPORT_NAME = 1000, RG_REPORT_LINE = 4000 };

// Adds a copy of a case; NULL stands for "". Texts are made fit for every form once, here, so that
// a form has only its own marks to escape.
// - A byte that is no UTF-8, and a character that XML cannot hold or that steers a terminal,
// becomes
//   U+FFFD. A control character becomes its picture (U+2400 and on): escape is U+241B.
// - Names, messages, devices and paths are of one line: a line break there is U+240A, a tab U+2409.
// - A name of more than RG_REPORT_NAME bytes ends in "..." and a hash of all of it. A name that is
//   there already ends in " (2)", and so on. Other lines end in "... (N bytes more)".
// False, and one logged line, without memory.
bool rg_report_add(struct rg_report *report, const struct rg_report_case *found);
bool rg_report_set_passport(struct rg_report *report, const char *passport);
void rg_report_free(struct rg_report *report);

// How many cases ended so.
int rg_report_count(const struct rg_report *report, enum rg_ending ending);
// Indices of the cases, the worst first, and as they were added among equals; the caller frees
// them. NULL, and one logged line, without memory.
int *rg_report_worst_first(const struct rg_report *report);

// "14 cases, 1 crash, 13 pass": each that passes, differs or has a ratio was compared. Of those
// that are expected to fail, "; 1 of them compared nothing".
enum { RG_REPORT_SUMMARY = 512 };
void rg_report_summary(const struct rg_report *report, char text[RG_REPORT_SUMMARY]);

// --- the forms; false, and one logged line, where one cannot be written ---

// Writes a form to a stream; forms.h has all of them as rows.
typedef bool (*rg_report_writer)(const struct rg_report *report, FILE *out);
// Writes a form to a file, by a temporary one that is renamed: whole, or what was there before.
bool rg_report_write(const struct rg_report *report, rg_report_writer form, const char *path);

// JUnit's XML, as GitLab and Jenkins read it, below RG_JUNIT_LIMIT bytes: the longest details are
// cut first, as far as need be, and say so. tests/harness/gate/report/junit.xsd is its schema.
enum { RG_JUNIT_LIMIT = 30 * 1000 * 1000 };
bool rg_report_junit(const struct rg_report *report, FILE *out);

// Bencher's metric format: cases that were timed, with measures "latency" (ns) and "ratio".
// https://bencher.dev/docs/reference/bencher-metric-format/
bool rg_report_bmf(const struct rg_report *report, FILE *out);
// Our own machine form, "gate" in docs/records.schema.json.
bool rg_report_json(const struct rg_report *report, FILE *out);

// For people, RG_REPORT_WIDTH columns wide: in colours where `out` shows them.
enum { RG_REPORT_WIDTH = 110 };
bool rg_report_text(const struct rg_report *report, FILE *out);
bool rg_report_text_coloured(const struct rg_report *report, FILE *out, bool is_coloured);

// GitHub's workflow commands, which become annotations: at most RG_ANNOTATIONS, the worst first.
enum { RG_ANNOTATIONS = 3 };
bool rg_report_annotations(const struct rg_report *report, FILE *out);
// Markdown of all that did not pass, for the file of $GITHUB_STEP_SUMMARY, which the commands of a
// step share, as far as GitHub's limit of RG_SUMMARY_LIMIT bytes leaves room; what is left out is
// counted.
enum { RG_SUMMARY_LIMIT = 1024 * 1024 };
bool rg_report_markdown(const struct rg_report *report, FILE *out);

#endif
