// When the system started this process, by its own files.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "harness/console/clock.h"
#include "harness/console/started.h"
#include "tests/tools/expect.h"

// The clock stands still, so that the age of the process is what is left.
double rg_now_ms(void)
{
    return 0;
}

static double uptime_ms(void)
{
    double s = 0;
    FILE *file = fopen("/proc/uptime", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%lf", &s), 1);
    fclose(file);
    return s * 1e3;
}

// Its start after the machine's; 0 where the system does not tell. It is the 22nd word, of which
// the second is the name in brackets.
static double start_ms(void)
{
    char text[2048] = "";
    double ticks = 0;
    FILE *file = fopen("/proc/self/stat", "r");
    assert_non_null(file);
    assert_non_null(fgets(text, sizeof(text), file));
    fclose(file);
    int word = 2;
    for (char *rest = strrchr(text, ')'), *next = strtok(rest, " "); next; word++) {
        next = strtok(NULL, " ");
        if (word == 21 && next)
            sscanf(next, "%lf", &ticks);
    }
    return ticks * 1e3 / (double)sysconf(_SC_CLK_TCK);
}

static void its_age_lies_between_two_readings(void **state)
{
    (void)state;
    enum { GRAIN_MS = 20 };
    nanosleep(&(struct timespec){0, 50000000}, NULL); // or its age would be nothing
    const double start = start_ms(), before = uptime_ms() - start;
    const double age = -rg_started_ms();
    const double after = uptime_ms() - start;
    if (start > 0) {
        assert_above(before, GRAIN_MS);
        assert_at_least(age, before - GRAIN_MS);
        assert_at_most(age, after + GRAIN_MS);
    } else {
        assert_equals(age, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_age_lies_between_two_readings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
