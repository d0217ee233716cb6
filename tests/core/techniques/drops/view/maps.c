// Pictures of drops' maps: heights in grey, owners in distinct colours, drops as discs.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "core/image/srgb.h"
#include "tests/core/techniques/drops/view/rig.h"
#include "tests/tools/expect.h"

enum { COLUMNS = 250, ROWS = 150 };

static struct rg_device *device;

static double height_wedge(double x_mm, double y_mm, const void *user)
{
    (void)user;
    return 0.02 * x_mm + 0.01 * y_mm;
}

// A pixel is a cell, white from 3 mm on. Beside the pane it is dark.
static void heights_are_grey(void **state)
{
    (void)state;
    struct drops *d =
        rig_open_sized(device, "columns=250 rows=150 drops_s=0 view=height", COLUMNS, ROWS + 40);
    view_put_heights(d, height_wedge, NULL);
    struct rg_picture picture = view_draw(d);
    for (int y = 0; y < picture.height; y++)
        for (int x = 0; x < COLUMNS; x++) {
            const int row = y - 20;
            const bool is_on = row >= 0 && row < ROWS;
            const double mm = height_wedge((x + 0.5) / 2, (row + 0.5) / 2, NULL);
            const double due = is_on ? fmin(mm / 3, 1) : 0.02;
            for (int c = 0; c < 3; c++)
                assert_below(fabs((double)view_pixel(&picture, x, y)[c] - due), 0.001);
        }
    rg_picture_destroy(&picture);
    rig_close(d);
}

// --- owners ---

static double difference(const struct rg_picture *p, int a, int b)
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += pow(
            (double)(rg_srgb_encode(p->texels[4 * a + c]) - rg_srgb_encode(p->texels[4 * b + c])),
            2);
    return sqrt(sum);
}

enum { OWNERS = 400 };

// IDs 1 to 400 and 1001 to 1400, one cell each, in the first columns of two rows.
static void put_ids(struct drops *d)
{
    struct rg_buf *buf = rg_asset_find(&d->base, "ids")->buf;
    uint32_t *map = rig_words(d, "ids");
    for (int i = 0; i < 2 * OWNERS; i++)
        map[drops_cell(d->params, i % OWNERS, i / OWNERS)] =
            (uint32_t)(i < OWNERS ? i + 1 : 1001 + i - OWNERS);
    assert_true(rg_buf_write(buf, 0, map, (int64_t)buf->size));
    free(map);
}

// 400 owners in succession have distinct colours. As perceived, the two most alike differ by a
// twelfth of black to white, and successive ones by nearly half. Cells without an owner are black.
static void owners_differ_in_colour(void **state)
{
    (void)state;
    struct drops *d = rig_open_sized(device, "columns=400 rows=16 drops_s=0 view=ids", OWNERS, 16);
    put_ids(d);
    struct rg_picture picture = view_draw(d);
    double least = 2, least_next = 2, least_black = 2;
    for (int row = 0; row < 2; row++)
        for (int a = 0; a < OWNERS; a++) {
            const int first = row * OWNERS;
            least_black = fmin(least_black, difference(&picture, first + a, 2 * OWNERS));
            for (int b = 0; b < a; b++) {
                const double off = difference(&picture, first + a, first + b);
                least = fmin(least, off);
                least_next = fmin(least_next, b == a - 1 ? off : 2);
            }
        }
    if (!(least > 1.0 / 12 && least_next > 0.45 && least_black > 0.3))
        fail_msg("colours differ by %.3g, next ones by %.3g, from black by %.3g", least, least_next,
                 least_black);
    const float *nobodys = view_pixel(&picture, 5, 9);
    assert_equals(nobodys[0], 0);
    assert_equals(nobodys[1], 0);
    assert_equals(nobodys[2], 0);
    rg_picture_destroy(&picture);
    rig_close(d);
}

// --- drops ---

static drops_drop drop(double mg, double x_mm, double y_mm)
{
    return (drops_drop){
        .mass = (uint32_t)(mg * DROPS_QUANTA_MG), .x = (float)x_mm, .y = (float)y_mm};
}

// Running drops are red and resting ones blue. A disc has its drop's area and place. The third drop
// is too small to be seen, and is drawn 1.5 pixels wide.
static void drops_are_discs_of_their_size(void **state)
{
    (void)state;
    const drops_drop all[3] = {drop(90, 20.3, 30.7), drop(15, 60.1, 12.2), drop(0.05, 100, 60)};
    const double radius_mm[3] = {cbrt(3 * 90 / (2 * M_PI)), cbrt(3 * 15 / (2 * M_PI)), 1.5 / 4};
    struct drops *d =
        rig_open_sized(device, "columns=250 rows=150 drops_s=0 view=particles", 500, 300);
    rig_put(d, all, 3, 1);
    struct rg_picture picture = view_draw(d);
    for (int k = 0; k < 3; k++) {
        const bool runs = k == 0;
        double area = 0, x = 0, y = 0;
        for (int i = 0; i < 500 * 300; i++) {
            const float *c = view_pixel(&picture, i % 500, i / 500);
            const double px = (i % 500 + 0.5) / 4, py = ((double)(i / 500) + 0.5) / 4;
            if (hypot(px - (double)all[k].x, py - (double)all[k].y) > 6)
                continue;
            const double share = (double)c[runs ? 0 : 2] / 0.9;
            area += share / 16;
            x += share * px / 16;
            y += share * py / 16;
            assert_true(share == 0 || (runs ? c[0] > 3 * c[2] : c[2] > 3 * c[0]));
        }
        const double due = M_PI * radius_mm[k] * radius_mm[k];
        if (fabs(area - due) > 0.04 * due)
            fail_msg("drop %d covers %g mm2, not %g", k, area, due);
        assert_below(fabs(x / area - (double)all[k].x), 0.02);
        assert_below(fabs(y / area - (double)all[k].y), 0.02);
    }
    rg_picture_destroy(&picture);
    rig_close(d);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights_are_grey),
        cmocka_unit_test(owners_differ_in_colour),
        cmocka_unit_test(drops_are_discs_of_their_size),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
