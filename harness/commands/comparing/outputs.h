// Where the reports of a gate go.
#ifndef RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H
#define RG_HARNESS_COMMANDS_COMPARING_OUTPUTS_H

#include "harness/commands/comparing/gtest.h"

struct rg_gate_outputs {
    char junit[PATH_MAX], pictures[PATH_MAX]; // a file and a folder; "": none
    bool prints_gtest;                        // results, in googletest's words
};

// By --junit and --output, which may be NULL, and googletest's flags. Pictures go where they are
// asked for, or beside the file of JUnit: FILE.xml has the folder FILE-pictures. False, and one
// logged line, where a path is too long or a form is not had.
bool rg_gate_outputs_settle(const char *junit, const char *pictures,
                            const struct rg_gtest_asked *gtest, struct rg_gate_outputs *outputs);

#endif
