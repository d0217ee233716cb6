// The flags of googletest that a gate accepts: some have a meaning here, others are passed by test
// runners to every test and ignored.
#ifndef RG_HARNESS_COMMANDS_COMPARING_GTEST_H
#define RG_HARNESS_COMMANDS_COMPARING_GTEST_H

#include <limits.h>

#include "harness/commands/cli/option.h"

struct rg_gtest_asked {
    bool list;    // print names and run nothing
    char *filter; // NULL: all cases
    char *output; // "xml:FILE"; NULL: none
    // Ignored flags.
    bool disabled, shuffle, brief, print_time, utf8, catches, breaks, throws, fails_fast, recreates;
    char *color, *seed, *death_style, *trace_depth;
    int repeat;
};

extern const struct rg_option rg_gtest_options[]; // struct rg_gtest_asked

// Takes the values of GTEST_FILTER and GTEST_OUTPUT for flags that are not given, as googletest
// does; empty ones are ignored. The texts are the environment's.
void rg_gtest_inherit(struct rg_gtest_asked *asked);

// The file of --gtest_output, in `path`; "" if it was not given. "xml" means test_detail.xml; a
// path that ends in a slash means raingauge.xml in that folder, which is made. False, and one
// logged line, for another format.
bool rg_gtest_output(const struct rg_gtest_asked *asked, char path[PATH_MAX]);

#endif
