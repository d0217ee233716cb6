// Pictures out of focus: a point becomes a disc, an even picture stays even, light is kept.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/image/disc.h"
#include "tests/tools/expect.h"

static struct rg_picture dark(int width, int height, int channels)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, width, height, channels, "test"));
    memset(picture.texels, 0, (size_t)rg_picture_values(&picture) * sizeof(float));
    return picture;
}

static float *texel(const struct rg_picture *p, int x, int y)
{
    return p->texels + ((int64_t)y * p->width + x) * p->channels;
}

// The area of a texel inside the disc, counted on a fine grid, over the disc's area.
static double share_inside(double dx, double dy, double radius)
{
    int inside = 0;
    for (int i = 0; i < 40; i++)
        for (int j = 0; j < 40; j++)
            inside += hypot(dx + (i - 19.5) / 40, dy + (j - 19.5) / 40) < radius;
    return inside / 1600.0 / (M_PI * radius * radius);
}

// The blur draws one chord for each row. Texels on the disc's edge may thus be off by half of a
// whole texel's share.
static void a_point_becomes_a_disc(void **state)
{
    (void)state;
    for (double diameter = 5; diameter < 20; diameter += 3.5) {
        struct rg_picture p = dark(41, 37, 3);
        const double radius = diameter / 2, whole = 1 / (M_PI * radius * radius);
        texel(&p, 20, 18)[1] = 1;
        assert_true(rg_picture_blur(&p, diameter));
        double sum = 0;
        for (int y = 0; y < p.height; y++)
            for (int x = 0; x < p.width; x++) {
                const float *t = texel(&p, x, y);
                const double due = share_inside(x - 20, y - 18, radius);
                const bool is_edge = due > 0 && due < 0.999 * whole;
                assert_equals(t[0], 0);
                assert_equals(t[2], 0);
                if (fabs((double)t[1] - due) > (is_edge ? 0.52 : 0.03) * whole)
                    fail_msg("disc of %g at %d %d: %g, not %g", diameter, x, y, (double)t[1], due);
                sum += (double)t[1];
            }
        assert_below(fabs(sum - 1), 1e-6);
        rg_picture_destroy(&p);
    }
}

// A disc far larger than the picture sees it mirrored again and again, so that it shows its mean.
static void beyond_its_edges_a_picture_is_mirrored(void **state)
{
    (void)state;
    struct rg_picture p = dark(8, 6, 1);
    for (int i = 0; i < 48; i++)
        p.texels[i] = (float)(i % 8);
    assert_true(rg_picture_blur(&p, 4000));
    for (int i = 0; i < 48; i++)
        assert_below(fabs((double)p.texels[i] - 3.5), 0.01);
    rg_picture_destroy(&p);

    // At a corner a quarter of the disc is inside the picture, and the rest mirrors that quarter.
    p = dark(12, 12, 1);
    texel(&p, 0, 0)[0] = 1;
    assert_true(rg_picture_blur(&p, 7));
    struct rg_picture q = dark(24, 24, 1);
    for (int i = 0; i < 4; i++)
        texel(&q, 11 + i % 2, 11 + i / 2)[0] = 1;
    assert_true(rg_picture_blur(&q, 7));
    for (int y = 0; y < 12; y++)
        for (int x = 0; x < 12; x++)
            assert_below(fabsf(*texel(&p, x, y) - *texel(&q, x + 12, y + 12)), 1e-6f);
    rg_picture_destroy(&p);
    rg_picture_destroy(&q);
}

static void a_half_has_means_of_four(void **state)
{
    (void)state;
    struct rg_picture p = dark(5, 4, 2);
    for (int i = 0; i < 20; i++) {
        p.texels[2 * i] = (float)i;
        p.texels[2 * i + 1] = 1;
    }
    assert_true(rg_picture_halve(&p));
    assert_int_equal(p.width, 2);
    assert_int_equal(p.height, 2);
    const float due[4] = {3, 5, 13, 15};
    for (int i = 0; i < 4; i++)
        assert_true(p.texels[2 * i] == due[i] && p.texels[2 * i + 1] == 1);
    for (int i = 0; i < 3; i++)
        assert_true(rg_picture_halve(&p));
    assert_equals(p.width, 1);
    assert_equals(p.height, 1);
    assert_equals(p.texels[0], 9);
    rg_picture_destroy(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_becomes_a_disc),
        cmocka_unit_test(beyond_its_edges_a_picture_is_mirrored),
        cmocka_unit_test(a_half_has_means_of_four),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
