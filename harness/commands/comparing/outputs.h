// The reports of a gate: their files and formats.
#ifndef RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H
#define RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H

#include "harness/commands/comparing/gtest.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/run/gate.h"

// The reports that are asked for, by the options of the forms.
struct rg_reports_asked {
    char *files[RG_REPORT_FORM_COUNT];
    bool flags[RG_REPORT_FORM_COUNT];
};
extern const struct rg_option rg_report_options[]; // struct rg_reports_asked

struct rg_gate_outputs {
    bool are_written[RG_REPORT_FORM_COUNT];  // by form
    const char *files[RG_REPORT_FORM_COUNT]; // destination of each form; NULL: no file
    char junit[PATH_MAX];                    // JUnit's file, which two options can name
    char pictures[PATH_MAX];                 // folder of pictures; "": none
    bool is_folder_asked;                    // an option asks for the folder, not only JUnit's file
    bool is_part;                            // of a shard: without a page, and files of
                                             // expectations are not held against it
    bool updates;                            // files of expectations are written anew
    int today;                               // harness/compare/gate/text/date.h
};

// Settles the outputs from the options of reports, --output, which may be NULL, and googletest's
// flags. Results are in googletest's words if its flags or shards ask for them. Pictures go to the
// requested folder, or next to JUnit's file: FILE.xml has the folder FILE-pictures. False, and one
// logged line, if a path is too long or a form does not exist.
bool rg_gate_outputs_settle(const struct rg_reports_asked *asked, const char *pictures,
                            const struct rg_gtest_asked *gtest, bool is_sharded,
                            struct rg_gate_outputs *outputs);

// Whether no report would replace the input `file`; NULL: none. False, and one logged line, if one
// would.
bool rg_gate_outputs_spare(const struct rg_gate_outputs *outputs, const char *file);

// Checks before any work that all reports can be written, each into its own file. False, and one
// logged line, if not.
bool rg_gate_outputs_can_be_written(const struct rg_gate_outputs *outputs);

// Writes and prints a gate's findings. If files of `known` do not agree with them, writes these
// files anew, or tells people which they are. False, and one logged line, if something cannot be
// written.
bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate);

#endif
