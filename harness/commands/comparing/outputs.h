// The reports of a gate: where they go, and in which form they are printed.
#ifndef RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H
#define RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H

#include "harness/commands/comparing/gtest.h"
#include "harness/compare/gate/run/gate.h"

struct rg_gate_outputs {
    char junit[PATH_MAX], pictures[PATH_MAX]; // a file and a folder; "": none
    const char *bmf;                          // a file; NULL: none
    bool prints_gtest;                        // results, in googletest's words
    bool github, json;                        // annotations; results in machine form
    int today;                                // harness/compare/gate/text/date.h
};

// By --junit and --output, which may be NULL, and googletest's flags. Pictures go where they are
// asked for, or beside the file of JUnit: FILE.xml has the folder FILE-pictures. False, and one
// logged line, where a path is too long or a form is not had.
bool rg_gate_outputs_settle(const char *junit, const char *pictures,
                            const struct rg_gtest_asked *gtest, struct rg_gate_outputs *outputs);

// Whether no report would replace this file, which is read; NULL: none. False, and one logged line.
bool rg_gate_outputs_spare(const struct rg_gate_outputs *outputs, const char *file);

// Whether all can be written, each into a file of its own, as is found out before any work. False,
// and one logged line.
bool rg_gate_outputs_can_be_written(const struct rg_gate_outputs *outputs);

// Writes and prints what a gate found, and for people the patches that would make the files of
// `known` true. False, and one logged line, where something cannot be written.
bool rg_gate_outputs_print(const struct rg_gate_outputs *outputs, const struct rg_known *known,
                           const struct rg_gate *gate);

#endif
