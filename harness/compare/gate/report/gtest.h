// googletest's protocol, so that runners that know gtest drive the gate: what they ask for, and the
// lines that they read. https://google.github.io/googletest/advanced.html
//
// deqp-runner is the strictest of them. In its list a line with a point is a suite, and a name ends
// at a space. While a test runs it takes any "[WORD] " for its result, ends at a WORD that it does
// not know, and takes a process that ends without a result for a crash.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_GTEST_H
#define RG_HARNESS_COMPARE_GATE_REPORT_GTEST_H

#include <stdbool.h>
#include <stdio.h>

#include "harness/compare/gate/report/report.h"

// Whether --gtest_filter=FILTER lets a test through: patterns between colons, of which one must
// match, then "-" and patterns of which none may. "*" is any text, "?" any character. Nothing
// before the "-" is "*"; an empty filter lets nothing through.
bool rg_gtest_matches(const char *filter, const char *name);

// Of the cases that a filter lets through, in their order, every `total`th runs, from `index` on.
struct rg_gtest_shards {
    int total, index;
};
// What $GTEST_TOTAL_SHARDS and $GTEST_SHARD_INDEX say; without them one shard has all. Makes the
// file of $GTEST_SHARD_STATUS_FILE. False, and one logged line, where they are no shard.
bool rg_gtest_shards(struct rg_gtest_shards *shards);

// The name for gtest of a case of a report, "streaks.small/cpu" of "streaks.small.cpu": its suite
// reaches to the first point, and further points become slashes. Where that is not enough, for a
// name has no suite, or characters that a filter or a list would misread, or more than
// RG_GTEST_KEPT bytes, these become "_" or are cut, and a hash of the whole name follows, so that
// it stays the only one.
enum { RG_GTEST_KEPT = 160, RG_GTEST_NAME = 256 };
void rg_gtest_name(const char *name, char made[RG_GTEST_NAME]);

// --gtest_list_tests: the cases that the filter lets through, by suite; none need have run.
void rg_gtest_list(FILE *out, const struct rg_report *report, const char *filter);

// What googletest prints of a run of these cases.
bool rg_gtest_print(const struct rg_report *report, FILE *out);

#endif
