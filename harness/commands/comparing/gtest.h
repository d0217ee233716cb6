// The flags of googletest that a gate takes: those that mean something to it, and those that
// runners pass to every test and that change nothing here.
#ifndef RG_HARNESS_COMMANDS_COMPARING_GTEST_H
#define RG_HARNESS_COMMANDS_COMPARING_GTEST_H

#include <limits.h>

#include "harness/cli/option.h"

struct rg_gtest_asked {
    bool list;    // names are printed, and nothing runs
    char *filter; // NULL: all cases
    char *output; // "xml:FILE"; NULL: none
    // What changes nothing.
    bool disabled, shuffle, brief, print_time, utf8, catches, breaks, throws, fails_fast, recreates;
    char *color, *seed, *death_style, *trace_depth;
    int repeat;
};

extern const struct rg_option rg_gtest_options[]; // struct rg_gtest_asked

// Takes from the environment what googletest does where its flag is not given: GTEST_FILTER and
// GTEST_OUTPUT; an empty one says nothing. The texts are the environment's.
void rg_gtest_inherit(struct rg_gtest_asked *asked);

// The file that --gtest_output names, in `path`; "" where it was not given. "xml" is
// test_detail.xml, and a folder's raingauge.xml is meant where the path ends in a slash: the folder
// is made. False, and one logged line, where it asks for another form.
bool rg_gtest_output(const struct rg_gtest_asked *asked, char path[PATH_MAX]);

#endif
