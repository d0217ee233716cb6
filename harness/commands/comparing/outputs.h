// The reports of a gate: their files and formats.
#ifndef RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H
#define RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H

#include "harness/commands/comparing/gtest.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/run/gate.h"

// What of the forms is asked for, by their options.
struct rg_reports_asked {
    char *files[RG_REPORT_FORM_COUNT];
    bool flags[RG_REPORT_FORM_COUNT];
};
extern const struct rg_option rg_report_options[]; // struct rg_reports_asked

struct rg_gate_outputs {
    bool are_written[RG_REPORT_FORM_COUNT];  // forms
    const char *files[RG_REPORT_FORM_COUNT]; // that they go to; NULL: none
    char junit[PATH_MAX];                    // of the two that name one
    char pictures[PATH_MAX];                 // a folder; "": none
    bool is_folder_asked;                    // and not only beside the file of JUnit
    bool updates;                            // files of expectations are written anew
    int today;                               // harness/compare/gate/text/date.h
};

// By the options of reports, --output, which may be NULL, and googletest's flags. Results are in
// googletest's words where its flags or its shards ask for them. Pictures go where they are asked
// for, or beside the file of JUnit: FILE.xml has the folder FILE-pictures. False, and one logged
// line, where a path is too long or a form is not had.
bool rg_gate_outputs_settle(const struct rg_reports_asked *asked, const char *pictures,
                            const struct rg_gtest_asked *gtest, bool is_sharded,
                            struct rg_gate_outputs *outputs);

// Whether no report would replace the file, which is an input; NULL: none. False, and one logged
// line, if one would.
bool rg_gate_outputs_spare(const struct rg_gate_outputs *outputs, const char *file);

// Whether all reports can be written, each into its own file, to be asked before any work. False,
// and one logged line, if not.
bool rg_gate_outputs_can_be_written(const struct rg_gate_outputs *outputs);

// Writes and prints what a gate found, and writes files of `known` anew that are not true of it, or
// tells people which these are. False, and one logged line, where something cannot be written.
bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate);

#endif
