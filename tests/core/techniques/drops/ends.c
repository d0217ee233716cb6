// Which cells lie at an end of a pane (kernels/drops/water/flattening.h), by counting, on panes
// that water crosses along columns and along rows. A mistake where it runs along rows shows on no
// pane that is upright or square.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/drops/water/flatten.h"
#include "tests/tools/expect.h"

// A cell's distance from both ends of a line of so many cells.
struct line {
    int at, count;
};

static void expect_ends(const drops_params p, int column, int row)
{
    const struct line columns = {column, p.columns}, rows = {row, p.rows};
    const struct line across = p.is_upright ? columns : rows, down = p.is_upright ? rows : columns;
    const ends e = ends_of(p, column, row);
    const int reach = drops_reach(p);
    assert_int_equal(e.is_first != 0, across.at < p.apart);
    assert_int_equal(e.is_second != 0, across.at < reach);
    assert_int_equal(e.is_second_last != 0, across.at >= across.count - reach);
    assert_int_equal(e.is_last != 0, across.at >= across.count - p.apart);
    assert_int_equal(e.is_top != 0, down.at < p.apart);
    assert_int_equal(e.is_bottom != 0, down.at >= down.count - p.apart);
    assert_int_equal(e.is_beyond != 0, column >= p.columns || row >= p.rows);
}

static void ends_are_where_the_pane_ends(void **state)
{
    (void)state;
    for (int upright = 0; upright < 2; upright++)
        for (int apart = 1; apart < 3; apart++)
            for (int wide = 0; wide < 2; wide++) {
                const drops_params p = {.columns = wide ? 23 : 11,
                                        .rows = wide ? 11 : 23,
                                        .apart = apart,
                                        .is_upright = upright};
                for (int row = 0; row < p.rows + 2; row++)
                    for (int column = 0; column < p.columns + 2; column++)
                        expect_ends(p, column, row);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ends_are_where_the_pane_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
