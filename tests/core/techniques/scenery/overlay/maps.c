// Maps of the overlay: maps DEVICE. Plates in the world against the texel that each pixel's ray
// meets, in double precision; insets in the picture's corner.
#include <math.h>
#include <stdlib.h>

#include "core/scene/matrix.h"
#include "tests/core/techniques/scenery/overlay/rig.h"
#include "tests/tools/expect.h"

static double ramp(double v)
{
    return fmin(fmax(v, 0), 1);
}

// --- plates ---

enum { MAP_PX = 4 };

// The texel of a map on the floor that a pixel's ray meets. Returns the ray's distance from the
// texel's rim, in texels; negative off the map.
static double texel_met(double x, double y, int *texel, double *ahead)
{
    const double slope = 2.0 / 6, length = sqrt(1 + slope * slope);
    const double right = (2 * x / WIDTH - 1) * tan(M_PI / 6) * WIDTH / HEIGHT;
    const double down = (2 * y / HEIGHT - 1) * tan(M_PI / 6);
    *ahead = 2 * length / (slope + down);
    if (slope + down <= 0)
        return -1;
    const double floor_x = right * *ahead;
    const double floor_z = 6 - *ahead * (1 - slope * down) / length;
    const double across = (floor_x + 3) / 6 * MAP_PX, along = (floor_z + 5) / 8 * MAP_PX;
    const double rim = fmin(fmin(across, MAP_PX - across), fmin(along, MAP_PX - along));
    if (rim < 0)
        return rim;
    *texel = (int)along * MAP_PX + (int)across;
    return fmin(rim, fmin(0.5 - fabs(across - floor(across) - 0.5),
                          0.5 - fabs(along - floor(along) - 0.5)));
}

// A map of 4 x 4 different values on the floor, with rows along x, from black to white: upwards, as
// maps of density, or downwards, as depth.
static void check_plate(struct rg_device *device, float black_at, float white_at)
{
    const struct rg_image_desc desc = {RG_D32F, MAP_PX, MAP_PX, 1, 1};
    const float half_way = 0.94f;
    float values[MAP_PX * MAP_PX], to_clip[16];
    overlay_look(to_clip);
    for (int i = 0; i < MAP_PX * MAP_PX; i++)
        values[i] = 0.02f + 0.06f * (float)i;
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(device, &instance);
    struct rg_image *map = rg_image_create(device, &desc, "map");
    assert_true(map && rg_image_write(map, 0, 0, values));
    const scenery_plate_params plate = {.to_clip = rg_m4_of(to_clip),
                                        .corner_x = -3,
                                        .corner_z = -5,
                                        .across_x = 6,
                                        .down_z = 8,
                                        .white_at = white_at,
                                        .black_at = black_at};
    struct picture open = picture_make(device, RG_RGBA32F, 1);
    struct picture tested = picture_make(device, RG_RGBA32F, half_way);
    assert_true(scenery_overlay_plate(overlay, &plate, map, open.colour, open.depth) &&
                scenery_overlay_plate(overlay, &plate, map, tested.colour, tested.depth));
    float *texels = picture_read(&open), *behind = picture_read(&tested);
    int shown = 0, hidden = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int texel = 0;
        double ahead;
        const double inside = texel_met(i % WIDTH + 0.5, i / WIDTH + 0.5, &texel, &ahead);
        if (fabs(inside) < 0.05)
            continue; // either texel, or none
        const double grey = ramp(((double)values[texel] - (double)black_at) /
                                 ((double)white_at - (double)black_at));
        assert_float_equal(texels[4 * i], inside > 0 ? grey : 0, 1e-5);
        assert_float_equal(texels[4 * i + 3], inside > 0 ? 1 : 0, 0);
        const double depth = 50 / 49.5 * (1 - 0.5 / ahead);
        if (inside < 0 || fabs(depth - (double)half_way) < 1e-4)
            continue;
        shown++;
        hidden += depth > (double)half_way;
        assert_float_equal(behind[4 * i + 3], depth < (double)half_way ? 1 : 0, 0);
    }
    print_message("plate: %d pixels, %d behind the depth\n", shown, hidden);
    assert_above(shown, 1000);
    assert_above(hidden, shown / 20);
    assert_below(hidden, shown * 9 / 10);
    free(texels);
    free(behind);
    picture_free(&open);
    picture_free(&tested);
    rg_image_destroy(map);
    close_overlay(overlay, &instance);
}

static void plates_show_their_maps(void **state)
{
    check_plate(*state, 0.1f, 0.9f);
    check_plate(*state, 0.9f, 0.1f);
}

// --- insets ---

static void insets_show_the_part_of_a_map(void **state)
{
    enum { MAP = 16 };
    const scenery_inset_params inset = {.x0 = 100,
                                        .y0 = 10,
                                        .x1 = 132,
                                        .y1 = 26,
                                        .u0 = 0.5f,
                                        .u1 = 1,
                                        .v1 = 0.5f,
                                        .layer = 1,
                                        .near_depth = 0.25f,
                                        .far_depth = 0.75f};
    float depths[MAP * MAP];
    struct rg_device *device = *state;
    const struct rg_image_desc desc = {RG_D32F, MAP, MAP, 2, 1};
    const float nothing = 0;
    struct rg_image *map = rg_image_create_with(device, &desc, &nothing, "map");
    for (int i = 0; i < MAP * MAP; i++)
        depths[i] = between((uint32_t)i, 0, 0, 1);
    assert_true(map && rg_image_write(map, 1, 0, depths));
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(device, &instance);
    struct picture p = picture_make(device, RG_RGBA32F, 1);
    assert_true(scenery_overlay_inset(overlay, &inset, map, p.colour));
    float *texels = picture_read(&p);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH - inset.x0, y = i / WIDTH - inset.y0;
        float due = 0;
        if (x >= 0 && x < 32 && y >= 0 && y < 16) { // 4 and 2 pixels a texel
            const float depth = depths[y / 2 * MAP + 8 + x / 4];
            due = x == 0 || x == 31 || y == 0 || y == 15 ? 1
                                                         : fminf(fmaxf((0.75f - depth) * 2, 0), 1);
        }
        assert_float_equal(texels[4 * i], due, 1e-6f);
    }
    free(texels);
    picture_free(&p);
    close_overlay(overlay, &instance);
    rg_image_destroy(map);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates_show_their_maps),
        cmocka_unit_test(insets_show_the_part_of_a_map),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
