// googletest's protocol, so that runners that know gtest can drive the gate: their options, and the
// lines that they read. https://google.github.io/googletest/advanced.html
//
// deqp-runner is the strictest of them. In the list it takes a line with a point for a suite, and
// ends a name at a space. While a test runs, it takes any "[WORD] " for the result, and stops at a
// WORD that it does not know. A process that ends without a result is a crash to it.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_GTEST_H
#define RG_HARNESS_COMPARE_GATE_REPORT_GTEST_H

#include <stdbool.h>
#include <stdio.h>

#include "harness/compare/gate/report/report.h"

// Whether --gtest_filter=FILTER selects a test: patterns between colons, one of which must match,
// then "-" and patterns none of which may. "*" is any text, "?" any character. No pattern before
// the "-" means "*"; an empty filter selects nothing.
bool rg_gtest_matches(const char *filter, const char *name);

// A shard runs every `total`th of the selected cases, in their order, starting at `index`.
struct rg_gtest_shards {
    int total, index;
};
// Reads $GTEST_TOTAL_SHARDS and $GTEST_SHARD_INDEX; without them one shard has all. Creates the
// file of $GTEST_SHARD_STATUS_FILE. False, and one logged line, if they name no shard.
bool rg_gtest_shards(struct rg_gtest_shards *shards);

// The gtest name of a report's case, "streaks.small/cpu" for "streaks.small.cpu". The suite ends at
// the first point; further points become slashes. A name without a suite gets the suite
// "raingauge". A name of more than RG_GTEST_KEPT bytes is cut, and characters that a filter or a
// list would misread become "_". After any of these changes a hash of the whole name follows, to
// keep the name unique.
enum { RG_GTEST_KEPT = 160, RG_GTEST_NAME = 256 };
void rg_gtest_name(const char *name, char made[RG_GTEST_NAME]);

// --gtest_list_tests: lists cases, an array of their names, by suite.
void rg_gtest_list(FILE *out, const json_t *names);

#endif
