// A result that no device made, with something in every field.
#ifndef RG_TESTS_HARNESS_RECORD_MADE_H
#define RG_TESTS_HARNESS_RECORD_MADE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/record/result.h"

// Rows 2 to 4, of which row 3 is missing, in two works and variants, on two devices. The second
// device has none of the variant "bare". The caller frees it.
struct rg_result make_result(void);

// A result printed in a format; the caller frees the text.
char *print_result(const struct rg_result *result, int format);
void assert_prints_same(const struct rg_result *a, const struct rg_result *b);

#endif
