// The four pieces of work by which machines are compared.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "harness/devices/measure/yardsticks.h"
#include "tests/tools/expect.h"

// Each is done, takes some time, and can be done again; the copy is complete.
static void test_all(void **state)
{
    (void)state;
    struct rg_yardstick_room room = {NULL};
    assert_true(rg_yardsticks_open(&room));
    for (int turn = 0; turn < 2; turn++)
        for (int i = 0; i < RG_YARDSTICKS; i++)
            assert_above(rg_yardstick_take(&room, (enum rg_yardstick)i), 0);
    assert_memory_equal(room.from, room.to, (size_t)64 << 20);
    rg_yardsticks_close(&room);
    rg_yardsticks_close(&room); // a second close does nothing
}

static void test_names(void **state)
{
    (void)state;
    for (int i = 0; i < RG_YARDSTICKS; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(rg_yardstick_name((enum rg_yardstick)i),
                                    rg_yardstick_name((enum rg_yardstick)k));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all), cmocka_unit_test(test_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
