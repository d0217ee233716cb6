// Assertions of order and of distance that tell both values, where assert_true(a < b) tells only
// its text.
#ifndef RG_TESTS_TOOLS_EXPECT_H
#define RG_TESTS_TOOLS_EXPECT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

// Both sides are evaluated once and compared as long doubles, which hold every integer and double
// exactly. With a NaN, only assert_differs passes.
#define assert_below(a, b)    RG_EXPECT(a, "<", b)
#define assert_at_most(a, b)  RG_EXPECT(a, "<=", b)
#define assert_above(a, b)    RG_EXPECT(a, ">", b)
#define assert_at_least(a, b) RG_EXPECT(a, ">=", b)
#define assert_equals(a, b)   RG_EXPECT(a, "==", b)
#define assert_differs(a, b)  RG_EXPECT(a, "!=", b)

// At most so far apart. With a NaN, or two infinities, it fails.
#define assert_near(a, b, within) rg_near((a), (b), (within), #a, __FILE__, __LINE__)

// From the least to the greatest value, both included.
#define assert_between(a, least, greatest)                                                         \
    rg_between((long double)(a), (long double)(least), (long double)(greatest), #a, __FILE__,      \
               __LINE__)

#define RG_EXPECT(a, order, b)                                                                     \
    rg_expect((long double)(a), order, (long double)(b), #a " " order " " #b, __FILE__, __LINE__)

static inline void rg_expect(long double a, const char *order, long double b, const char *text,
                             const char *file, int line)
{
    const bool holds = !strcmp(order, "<")    ? a < b
                       : !strcmp(order, "<=") ? a <= b
                       : !strcmp(order, ">")  ? a > b
                       : !strcmp(order, ">=") ? a >= b
                       : !strcmp(order, "==") ? a == b
                                              : a != b;
    if (holds)
        return;
    print_error("%s: %.19Lg %s %.19Lg does not hold\n", text, a, order, b);
    _fail(file, line);
}

static inline void rg_near(double a, double b, double within, const char *text, const char *file,
                           int line)
{
    if (fabs(a - b) <= within)
        return;
    print_error("%s: %.17g is not within %g of %.17g\n", text, a, within, b);
    _fail(file, line);
}

static inline void rg_between(long double a, long double least, long double greatest,
                              const char *text, const char *file, int line)
{
    if (a >= least && a <= greatest)
        return;
    print_error("%s: %.19Lg is not from %.19Lg to %.19Lg\n", text, a, least, greatest);
    _fail(file, line);
}

#endif
