// The forms of a report. A form is a row here and the function that it names. The row gives its
// option in the gate's help, its destination, and the file that it must not replace.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_FORMS_H
#define RG_HARNESS_COMPARE_GATE_REPORT_FORMS_H

#include "harness/compare/gate/report/report.h"

// The destination of a form.
enum rg_report_where {
    RG_WHERE_FILE,     // its option names a file
    RG_WHERE_INSTEAD,  // its option, a flag, prints it in place of text
    RG_WHERE_BELOW,    // its option, a flag, prints it after the other output
    RG_WHERE_DEFAULT,  // printed if nothing else is asked for; no option
    RG_WHERE_APPENDED, // appended to the file of an environment variable, if the form before it is
                       // asked for
};

// Id, destination, name of the option or variable, help text of the option, the option that it
// excludes (NULL: none), writer. Reports are written in this order.
#define RG_REPORT_FORMS(ROW)                                                                       \
    ROW(JUNIT, FILE, "junit", "writes JUnit XML (docs/ci.md)", NULL, rg_report_junit)              \
    ROW(BMF, FILE, "bmf", "writes Bencher's metric format", NULL, rg_report_bmf)                   \
    ROW(JSON, INSTEAD, "json", "prints machine-readable JSON (docs/records.md)", NULL,             \
        rg_report_json)                                                                            \
    ROW(GTEST, DEFAULT, NULL, NULL, NULL, rg_gtest_print)                                          \
    ROW(TEXT, DEFAULT, NULL, NULL, NULL, rg_report_text)                                           \
    ROW(GITHUB, BELOW, "github",                                                                   \
        "prints GitHub's annotations, and appends a summary to the file that "                     \
        "$GITHUB_STEP_SUMMARY names",                                                              \
        "json", rg_report_annotations)                                                             \
    ROW(SUMMARY, APPENDED, "GITHUB_STEP_SUMMARY", NULL, NULL, rg_report_markdown)

#define RG_REPORT_ENUM(id, ...) RG_AS_##id,
enum { RG_REPORT_FORMS(RG_REPORT_ENUM) RG_REPORT_FORM_COUNT };

#define RG_REPORT_WRITER(id, where, name, about, excludes, write)                                  \
    bool write(const struct rg_report *report, FILE *out);
RG_REPORT_FORMS(RG_REPORT_WRITER)

extern const struct rg_report_form {
    enum rg_report_where where;
    const char *name; // of its option or variable; NULL: none
    rg_report_writer write;
} rg_report_forms[RG_REPORT_FORM_COUNT];

// Checks before any work that a file can be appended to, and creates it. A FIFO or device is
// refused, not waited for. False, and one logged line that names the variable, if not.
bool rg_report_can_append(const char *path, const char *variable);
bool rg_report_append(const struct rg_report *report, const struct rg_report_form *form,
                      const char *path);

#endif
