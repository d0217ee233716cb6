// Texels of halves and floats in memory, blended by kernels/dialect/draw/blend.h, against sums that
// are exact. Each channel has numbers of its own.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/dialect/lang.h"

#include "kernels/dialect/vec.h"

#include "kernels/dialect/draw/blend.h"

static const double source[4] = {0.125, 0.25, 0.375, 0.5}, target[4] = {1, 2, 5, 8};

// The bits of a normal half that holds the number whole.
static uint half_of(double value)
{
    const float whole = (float)value;
    uint bits;
    memcpy(&bits, &whole, sizeof(bits));
    assert_int_equal(bits & 0x1fff, 0);
    return (bits >> 13) - 0x1c000;
}

static double due(int channel, int blend)
{
    return source[channel] + (blend == RG_BLEND_IS_OFF   ? 0
                              : blend == RG_BLEND_IS_ADD ? target[channel]
                                                         : target[channel] * (1 - source[3]));
}

static void halves_are_blended(void **state)
{
    (void)state;
    static const int blends[] = {RG_BLEND_IS_OFF, RG_BLEND_IS_ADD, RG_BLEND_IS_OVER};
    const rgba c = rg_rgba((float)source[0], (float)source[1], (float)source[2], (float)source[3]);
    for (int k = 0; k < 3; k++) {
        uint texels[4] = {7, half_of(target[0]) | half_of(target[1]) << 16,
                          half_of(target[2]) | half_of(target[3]) << 16, 9};
        rg_blend_RGBA16F(texels, 1, c, blends[k]);
        for (int channel = 0; channel < 4; channel++)
            assert_int_equal(texels[1 + channel / 2] >> 16 * (channel % 2) & 0xffff,
                             half_of(due(channel, blends[k])));
        assert_int_equal(texels[0], 7);
        assert_int_equal(texels[3], 9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(halves_are_blended)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
