// Regular expressions in Rust's syntax, as in deqp-runner, run by libpcre2 over bytes.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_REGEX_H
#define RG_HARNESS_COMPARE_GATE_TEXT_REGEX_H

#include <stdbool.h>

struct rg_regex;

// Compiles the part of the syntax that Rust and libpcre2 read alike (docs/expectations.md). NULL,
// and one logged line that begins with `place`, if an expression is refused. The caller frees it.
struct rg_regex *rg_regex_of(const char *place, const char *text);
void rg_regex_free(struct rg_regex *regex); // NULL: nothing

// Searches for a match anywhere in a text.
enum rg_regex_found { RG_REGEX_ABSENT, RG_REGEX_FOUND, RG_REGEX_TOO_LONG };
// TOO_LONG, without a message: the search reached its limit of steps or memory.
enum rg_regex_found rg_regex_search(const struct rg_regex *regex, const char *text);

#endif
