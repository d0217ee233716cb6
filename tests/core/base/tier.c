// How closely two devices must agree. The devices are made up, since few machines have one of each
// kind.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/device/device.h"

static const struct rg_device_info reference = {.name = "cpu:reference", .tier = RG_T0},
                                   software = {.name = "gl", .tier = RG_T0},
                                   gpu = {.name = "vulkan", .tier = RG_T1},
                                   other_gpu = {.name = "opencl", .tier = RG_T1},
                                   native = {.name = "gl:native", .tier = RG_T2},
                                   other_native = {.name = "vulkan:native", .tier = RG_T2};

// The order of the two must not matter.
static enum rg_tier owed(const struct rg_device_info *a, const struct rg_device_info *b)
{
    assert_int_equal(rg_tier_owed(a, b), rg_tier_owed(b, a));
    return rg_tier_owed(a, b);
}

static void the_looser_of_two_tiers_is_owed(void **state)
{
    (void)state;
    assert_int_equal(owed(&reference, &software), RG_T0);
    assert_int_equal(owed(&reference, &gpu), RG_T1);
    assert_int_equal(owed(&software, &gpu), RG_T1);
    assert_int_equal(owed(&gpu, &other_gpu), RG_T1);
    assert_int_equal(owed(&reference, &native), RG_T2);
    assert_int_equal(owed(&gpu, &native), RG_T2);
    assert_int_equal(owed(&native, &other_native), RG_T2);
}

// Native drawing in software owes T2 all the same: the place where a device runs decides nothing.
static void running_in_software_decides_nothing(void **state)
{
    (void)state;
    const struct rg_device_info native_in_software = {.software = true, .tier = RG_T2};
    const struct rg_device_info exact_gpu = {.software = false, .tier = RG_T0};
    assert_int_equal(owed(&reference, &native_in_software), RG_T2);
    assert_int_equal(owed(&reference, &exact_gpu), RG_T0);
}

static void a_device_without_a_tier_owes_every_bit(void **state)
{
    (void)state;
    const struct rg_device_info silent = {.name = "new"};
    assert_int_equal(owed(&reference, &silent), RG_T0);
}

static void tiers_have_names(void **state)
{
    (void)state;
    assert_string_equal(rg_tier_name(RG_T0), "T0");
    assert_string_equal(rg_tier_name(RG_T1), "T1");
    assert_string_equal(rg_tier_name(RG_T2), "T2");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_looser_of_two_tiers_is_owed),
        cmocka_unit_test(running_in_software_decides_nothing),
        cmocka_unit_test(a_device_without_a_tier_owes_every_bit),
        cmocka_unit_test(tiers_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
