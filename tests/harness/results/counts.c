// The thesis's two cameras: how many particles the rows of its tables draw from where our cameras
// stand. The test counts the particles that a frame selects, without a device.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/city/city.h"
#include "core/techniques/streaks/packets/packets.h"
#include "core/techniques/streaks/streaks.h"
#include "harness/tables/papers/papers.h"
#include "tests/tools/instance.h"

// In the tables no particle's splash reaches farther than this across the fall.
#define REACH_M 0.046

static struct rg_rain_space space_of(const struct streaks_settings *set)
{
    const struct rg_rain_space_settings sizes = {.fall = {0, -1, 0},
                                                 .width_m = set->rain_width_m,
                                                 .depth_m = set->rain_depth_m,
                                                 .height_m = set->rain_height_m};
    struct rg_rain_space space;
    assert_true(rg_rain_space_make(&sizes, &space));
    return space;
}

// The packets of the last row: the next row may have the same ones.
static struct streaks_packets *kept;
static double kept_height_m;
static int kept_size;

static struct streaks_packets *make_packets(const struct streaks_settings *set,
                                            const struct rg_rain_space *space)
{
    assert_int_equal(set->spectrum, 0); // drops of one size, as the thesis has
    const struct streaks_packets_settings settings = {.seed = (uint32_t)set->seed,
                                                      .drops_m2_s = set->drops_m2_s,
                                                      .fall_speed_m_s = set->fall_speed_m_s,
                                                      .local_height_m = set->local_height_m,
                                                      .packet_size = set->packet_size,
                                                      .scheme = (enum streaks_scheme)set->scheme,
                                                      .memory_bytes =
                                                          (int64_t)set->memory_mb * 1000000};
    struct rg_density *density = rg_density_gradient();
    assert_non_null(density);
    struct streaks_packets *packets = streaks_packets_create(space, density, &settings);
    rg_density_destroy(density);
    assert_non_null(packets);
    return packets;
}

static const struct streaks_packets *packets_of(const struct streaks_settings *set,
                                                const struct rg_rain_space *space)
{
    if (kept && set->local_height_m == kept_height_m && set->packet_size == kept_size)
        return kept;
    streaks_packets_destroy(kept);
    kept = make_packets(set, space);
    kept_height_m = set->local_height_m;
    kept_size = set->packet_size;
    return kept;
}

static struct streaks_view view_of(const struct streaks_settings *set,
                                   const struct rg_rain_space *space, const struct rg_table *table)
{
    struct rg_camera camera =
        set->camera == STREAKS_SECOND ? city_second_camera : city_first_camera;
    struct streaks_view view = {.radius_m = set->culling_radius_m, .across_m = REACH_M};
    camera.angle_deg = (float)set->view_angle_deg;
    rg_rain_eye(space, &camera, view.eye);
    view.top_m = rg_rain_local_top(view.eye[2], set->local_height_m);
    assert_true(
        rg_rain_view_corners(space, &camera, (double)table->width / table->height, view.corners));
    return view;
}

static int64_t count_of(const struct rg_table *table, int row)
{
    struct streaks_settings *set =
        settings_of("streaks", table->variants[0].set, table->rows[row].set);
    struct streaks_selection selection = {0};
    const struct rg_rain_space space = space_of(set);
    const struct streaks_view view = view_of(set, &space, table);
    assert_true(streaks_select(packets_of(set, &space), &view, &selection));
    const int64_t particles = selection.particles;
    streaks_selection_release(&selection);
    free(set);
    return particles;
}

// Rows with an x in `others` are other work: from this camera they cannot draw as many particles as
// printed.
static void check_table(const char *id, const char *others)
{
    const struct rg_table *table = rg_table_find(id);
    assert_non_null(table);
    for (int row = 0; row < table->row_count; row++) {
        const double ratio = (double)count_of(table, row) / rg_table_value(table, row, "particles");
        const bool is_met = fmax(ratio, 1 / ratio) <= 1.2;
        print_message("%s, row %d: %.2f of print\n", id, row + 1, ratio);
        if (is_met != (others[row] == '.'))
            fail_msg("%s, row %d draws %.3f times as many particles as printed", id, row + 1,
                     ratio);
    }
}

static void rows_of_the_first_camera_draw_what_was_printed(void **state)
{
    (void)state;
    check_table("creus-5.4", "........");
}

static void rows_of_both_cameras_draw_what_was_printed(void **state)
{
    (void)state;
    check_table("creus-5.3", "..................");
}

static void rows_of_the_second_camera_draw_what_was_printed(void **state)
{
    (void)state;
    check_table("creus-5.5", "......xx.xx");
    check_table("creus-5.6", "......");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_the_first_camera_draw_what_was_printed),
        cmocka_unit_test(rows_of_both_cameras_draw_what_was_printed),
        cmocka_unit_test(rows_of_the_second_camera_draw_what_was_printed),
    };
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    streaks_packets_destroy(kept);
    return failures;
}
