// The forms of a report. A form is a row here and a function that writes it: its option in the
// gate's help, where it goes, and which file it must not replace all follow from the row.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_FORMS_H
#define RG_HARNESS_COMPARE_GATE_REPORT_FORMS_H

#include "harness/compare/gate/report/report.h"

// Where a form goes.
enum rg_report_where {
    RG_WHERE_FILE,     // its option names a file
    RG_WHERE_INSTEAD,  // its option, a flag, prints it instead of text
    RG_WHERE_BELOW,    // its option, a flag, prints it below what is printed else
    RG_WHERE_DEFAULT,  // it is printed where nothing else is asked for; it has no option
    RG_WHERE_APPENDED, // the form before it appends it to the file of an environment variable
};

// Its name here, where it goes, the name of its option or variable, what help says of the option,
// what it excludes (NULL: nothing), what writes it. In the order in which they are written.
#define RG_REPORT_FORMS(ROW)                                                                       \
    ROW(JUNIT, FILE, "junit", "writes JUnit's XML (docs/ci.md)", NULL, rg_report_junit)            \
    ROW(BMF, FILE, "bmf", "writes Bencher's metric format", NULL, rg_report_bmf)                   \
    ROW(JSON, INSTEAD, "json", "results in machine form (docs/records.md)", NULL, rg_report_json)  \
    ROW(GTEST, DEFAULT, NULL, NULL, NULL, rg_gtest_print)                                          \
    ROW(TEXT, DEFAULT, NULL, NULL, NULL, rg_report_text)                                           \
    ROW(GITHUB, BELOW, "github",                                                                   \
        "prints GitHub's annotations, and appends to the file of $GITHUB_STEP_SUMMARY", "json",    \
        rg_report_annotations)                                                                     \
    ROW(SUMMARY, APPENDED, "GITHUB_STEP_SUMMARY", NULL, NULL, rg_report_markdown)

#define RG_REPORT_ENUM(id, ...) RG_AS_##id,
enum { RG_REPORT_FORMS(RG_REPORT_ENUM) RG_REPORT_FORM_COUNT };

extern const struct rg_report_form {
    enum rg_report_where where;
    const char *name; // of its option or variable; NULL: none
    rg_report_writer write;
} rg_report_forms[RG_REPORT_FORM_COUNT];

// Whether a file can be appended to, as is found out before any work; it is made. A FIFO or device
// is refused, and not waited for. False, and one logged line that names the variable.
bool rg_report_can_append(const char *path, const char *variable);
bool rg_report_append(const struct rg_report *report, const struct rg_report_form *form,
                      const char *path);

#endif
