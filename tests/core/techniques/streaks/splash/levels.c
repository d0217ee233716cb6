// Levels of textures, also where a native device's driver makes them: levels DEVICE.
#include <math.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/outcome.h"
#include "core/techniques/streaks/textures.h"
#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/streaks/rig.h"

// A level's texels are read here; the caller frees them.
static uint16_t *read_level(struct rg_image *image, int layer, int level, int *count)
{
    *count = rg_level_size(image->desc.width, level) * rg_level_size(image->desc.height, level);
    uint16_t *texels = malloc((size_t)*count * sizeof(*texels));
    assert_non_null(texels);
    assert_true(rg_image_read(image, layer, level, texels));
    return texels;
}

static double mean_of(struct rg_image *image, int layer, int level)
{
    int count;
    uint16_t *texels = read_level(image, layer, level, &count);
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += (double)rg_unpack_half(texels[i]);
    free(texels);
    return sum / count;
}

// A level is made from the one above by a mix across and one down. Each mix is rounded or cut to a
// half, which is off by 2^-10 of it at most, or by all of it below the least normal half.
static void splashes_are_as_bright_in_each_level(void **state)
{
    (void)state;
    struct streaks *s = rain_open("");
    struct rg_image *crowns = s->textures->crowns;
    for (int layer = 0; layer < crowns->desc.layers; layer++) {
        const double due = mean_of(crowns, layer, 0);
        for (int level = 1; level < crowns->desc.levels; level++) {
            const double mean = mean_of(crowns, layer, level);
            if (!(fabs(mean - due) <= level * 2 * (due * 0x1p-10 + 0x1p-14)))
                fail_msg("layer %d, level %d: %.9g, not %.9g", layer, level, mean, due);
        }
    }
    rain_close(s);
}

// A driver may lack what a native device needs.
static bool is_missing(const char *name)
{
    struct rg_device *device = rg_device_open(name);
    if (!device)
        return rg_failure_take().outcome == RG_UNSUPPORTED;
    assert_true(rg_device_close(device));
    return false;
}

int main(int argc, char **argv)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(splashes_are_as_bright_in_each_level)};
    if (argc > 1 && is_missing(argv[1]))
        return 77;
    return rain_tests_run(argc, argv, tests, 1);
}
