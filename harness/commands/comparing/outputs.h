// The reports of a gate: their files and formats.
#ifndef RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H
#define RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H

#include "harness/commands/comparing/gtest.h"
#include "harness/compare/gate/run/gate.h"

struct rg_gate_outputs {
    char junit[PATH_MAX], pictures[PATH_MAX]; // a file and a folder; "": none
    const char *bmf;                          // a file; NULL: none
    bool prints_gtest;                        // results, in googletest's words
    bool github, json;                        // annotations; results in machine form
    bool updates;                             // files of expectations are written anew
    int today;                                // harness/compare/gate/text/date.h
};

// Sets the paths from --junit and --output, which may be NULL, and googletest's flags. Pictures go
// to their own folder, or beside the JUnit file: FILE.xml has the folder FILE-pictures. False, and
// one logged line, where a path is too long or a format is unknown.
bool rg_gate_outputs_settle(const char *junit, const char *pictures,
                            const struct rg_gtest_asked *gtest, struct rg_gate_outputs *outputs);

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
