// Matrices: products against plain sums, and inverses undo their matrices.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "tests/tools/expect.h"

static uint32_t state_of_noise = 7;

// A number from -1 to 1.
static double noise(void)
{
    state_of_noise = state_of_noise * 1664525u + 1013904223u;
    return (double)(state_of_noise >> 8) / 8388608.0 - 1;
}

static struct rg_matrix any_matrix(void)
{
    struct rg_matrix m;
    for (int i = 0; i < 16; i++)
        m.rows[i / 4][i % 4] = noise();
    return m;
}

// A rotation about x, then about y, then a translation.
static struct rg_matrix any_motion(void)
{
    const double a = 3 * noise(), b = 3 * noise();
    return (struct rg_matrix){{{cos(b), sin(b) * sin(a), sin(b) * cos(a), 50 * noise()},
                               {0, cos(a), -sin(a), 50 * noise()},
                               {-sin(b), cos(b) * sin(a), cos(b) * cos(a), 50 * noise()},
                               {0, 0, 0, 1}}};
}

static double off_unit(const struct rg_matrix *m)
{
    double worst = 0;
    for (int i = 0; i < 16; i++)
        worst = fmax(worst, fabs(m->rows[i / 4][i % 4] - (i / 4 == i % 4)));
    return worst;
}

static void test_products(void **state)
{
    (void)state;
    float a[16], b[16], product[16];
    for (int i = 0; i < 16; i++) {
        a[i] = (float)(i * i % 7 - 3);
        b[i] = (float)(i * 5 % 11 - 4);
    }
    const struct rg_matrix left = rg_matrix_of(a), right = rg_matrix_of(b);
    const struct rg_matrix exact = rg_matrix_product(&left, &right);
    rg_matrix_multiply(a, b, product);
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += (double)a[4 * row + k] * (double)b[4 * k + column];
            assert_equals((double)product[4 * row + column], sum); // exact, being small integers
            assert_equals(exact.rows[row][column], sum);
        }
    }
    rg_matrix_multiply(a, b, a);
    assert_memory_equal(a, product, sizeof(a));
    rg_matrix_round(&left, a);
    rg_matrix_multiply(a, b, b);
    assert_memory_equal(b, product, sizeof(b));
}

static void test_turns(void **state)
{
    (void)state;
    double left[3][3], right[3][3], product[3][3];
    for (int i = 0; i < 9; i++) {
        left[i / 3][i % 3] = i * i % 7 - 3;
        right[i / 3][i % 3] = i * 5 % 11 - 4;
    }
    rg_turn_multiply(left, right, product);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += left[row][k] * right[k][column];
            assert_equals(product[row][column], sum); // exact, being small integers
        }
}

static void test_inverses(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const struct rg_matrix m = any_matrix();
        struct rg_matrix inverse;
        assert_true(rg_matrix_inverse(&m, &inverse));
        const struct rg_matrix there = rg_matrix_product(&inverse, &m);
        const struct rg_matrix back = rg_matrix_product(&m, &inverse);
        assert_below(off_unit(&there), 1e-9);
        assert_below(off_unit(&back), 1e-9);
    }
    // Its diagonal is 0, so that elimination must exchange rows.
    const struct rg_matrix turned = {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}, {0, 1, 0, 0}}};
    struct rg_matrix inverse;
    assert_true(rg_matrix_inverse(&turned, &inverse));
    const struct rg_matrix unit = rg_matrix_product(&inverse, &turned);
    assert_equals(off_unit(&unit), 0);
}

static void test_motions(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const struct rg_matrix m = any_motion(), back = rg_matrix_back(&m);
        const struct rg_matrix unit = rg_matrix_product(&back, &m);
        assert_below(off_unit(&unit), 1e-12);
    }
}

static void test_what_has_no_inverse(void **state)
{
    (void)state;
    struct rg_matrix inverse, flat = any_matrix(), none = {{{0}}}, nothing = any_matrix();
    for (int c = 0; c < 4; c++)
        flat.rows[3][c] = 2 * flat.rows[0][c] - flat.rows[1][c];
    nothing.rows[1][1] = NAN;
    assert_false(rg_matrix_inverse(&flat, &inverse));
    assert_false(rg_matrix_inverse(&none, &inverse));
    assert_false(rg_matrix_inverse(&nothing, &inverse));
    float rows[16], at[3];
    rg_matrix_round(&none, rows);
    assert_false(rg_matrix_undo(rows, (float[3]){0, 0, 0}, at));
}

// A point goes to clip space and comes back.
static void test_points_undone(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        struct rg_matrix m = any_motion();
        memcpy(m.rows[3], m.rows[2], sizeof(m.rows[3])); // w is the distance ahead
        m.rows[2][3] -= 1;
        const double point[4] = {20 * noise(), 20 * noise(), 20 * noise(), 1};
        double seen[4] = {0};
        for (int k = 0; k < 16; k++)
            seen[k / 4] += m.rows[k / 4][k % 4] * point[k % 4];
        if (fabs(seen[3]) < 1)
            continue;
        float rows[16], at[3];
        rg_matrix_round(&m, rows);
        const float clip[3] = {(float)(seen[0] / seen[3]), (float)(seen[1] / seen[3]),
                               (float)(seen[2] / seen[3])};
        assert_true(rg_matrix_undo(rows, clip, at));
        for (int c = 0; c < 3; c++)
            assert_below(fabs((double)at[c] - point[c]), 0.002);
    }
}

static void test_what_kernels_read(void **state)
{
    (void)state;
    float rows[16], again[16];
    for (int i = 0; i < 16; i++)
        rows[i] = (float)i;
    const m4 m = rg_m4_of(rows);
    assert_equals(m.xx, 0.0f);
    assert_equals(m.xw, 3.0f);
    assert_equals(m.yx, 4.0f);
    assert_equals(m.zz, 10.0f);
    assert_equals(m.wx, 12.0f);
    assert_equals(m.ww, 15.0f);
    rg_m4_rows(&m, again);
    assert_memory_equal(again, rows, sizeof(rows));
}

// From pixels, counted from the left and from the top (-1 in clip space), back to places, through a
// matrix that scales, moves and divides.
static void test_from_pixel(void **state)
{
    (void)state;
    enum { WIDTH = 40, HEIGHT = 10 };
    const float to_clip[16] = {2, 0, 0, 3, 0, 4, 0, 1, 0, 0, 1, 0, 0, 0, 0.5f, 1};
    const m4 matrix = rg_m4_of(to_clip);
    const double places[][3] = {{0, 0, 0}, {1, 2, 3}, {-4, 0.5, 1}};
    m4 from_pixel;
    float rows[16];
    assert_true(rg_matrix_from_pixel(&matrix, WIDTH, HEIGHT, &from_pixel));
    rg_m4_rows(&from_pixel, rows);
    for (int i = 0; i < 3; i++) {
        const double *p = places[i];
        const double w = 0.5 * p[2] + 1;
        const double pixel[4] = {((2 * p[0] + 3) / w + 1) / 2 * WIDTH,
                                 ((4 * p[1] + 1) / w + 1) / 2 * HEIGHT, p[2] / w, 1};
        double found[4] = {0};
        for (int r = 0; r < 4; r++)
            for (int c = 0; c < 4; c++)
                found[r] += (double)rows[4 * r + c] * pixel[c];
        for (int c = 0; c < 3; c++)
            assert_below(fabs(found[c] / found[3] - p[c]), 1e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_from_pixel),    cmocka_unit_test(test_products),
        cmocka_unit_test(test_turns),         cmocka_unit_test(test_inverses),
        cmocka_unit_test(test_motions),       cmocka_unit_test(test_what_has_no_inverse),
        cmocka_unit_test(test_points_undone), cmocka_unit_test(test_what_kernels_read),
    };
    return cmocka_run_group_tests_name("matrices", tests, NULL, NULL);
}
