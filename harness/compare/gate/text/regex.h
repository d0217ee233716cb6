// Regular expressions in Rust's syntax, which deqp-runner has, run by libpcre2 over bytes.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_REGEX_H
#define RG_HARNESS_COMPARE_GATE_TEXT_REGEX_H

#include <stdbool.h>

struct rg_regex;

// Compiles what Rust and libpcre2 read alike; docs/expectations.md says what that is. NULL, and one
// logged line that begins with `place`, where an expression is refused. The caller frees it.
struct rg_regex *rg_regex_of(const char *place, const char *text);
void rg_regex_free(struct rg_regex *regex); // NULL: nothing

// Whether it is found anywhere in a text.
enum rg_regex_found { RG_REGEX_ABSENT, RG_REGEX_FOUND, RG_REGEX_TOO_LONG };
// TOO_LONG, without a message: the search was given up at its limit of steps or of memory.
enum rg_regex_found rg_regex_search(const struct rg_regex *regex, const char *text);

#endif
