// A result that no device made, with something in every field.
#ifndef RG_TESTS_HARNESS_RECORD_MADE_H
#define RG_TESTS_HARNESS_RECORD_MADE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/record/result.h"

// Rows 2 to 4, of which the third is missing, in two works and variants, on two devices; of the
// variant "bare" the second device has none. The caller frees it.
struct rg_result make_result(void);

// What is printed of a result in a format; the caller frees it.
char *print_result(const struct rg_result *result, int format);
void assert_prints_same(const struct rg_result *a, const struct rg_result *b);

#endif
