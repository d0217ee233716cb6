#include "tests/oracle/drops/map.h"

#include <float.h>
#include <math.h>

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int most(int a, int b)
{
    return a > b ? a : b;
}

// --- the wet part of the pane ---

static void grow_wet(struct oracle_drops *o, int row0, int row1, int column0, int column1)
{
    o->wet.row0 = least(o->wet.row0, row0);
    o->wet.row1 = most(o->wet.row1, row1);
    o->wet.column0 = least(o->wet.column0, column0);
    o->wet.column1 = most(o->wet.column1, column1);
}

static bool any_wet(const struct oracle_drops *o, int row0, int row1, int column0, int column1)
{
    for (int i = row0; i < row1; i++)
        for (int j = column0; j < column1; j++)
            if (o->height_mm[i * o->settings.columns + j] > 0)
                return true;
    return false;
}

static void shrink_wet(struct oracle_drops *o)
{
    int r0 = o->wet.row0, r1 = o->wet.row1, c0 = o->wet.column0, c1 = o->wet.column1;
    while (r0 < r1 && !any_wet(o, r0, r0 + 1, c0, c1))
        r0++;
    while (r0 < r1 && !any_wet(o, r1 - 1, r1, c0, c1))
        r1--;
    while (r0 < r1 && !any_wet(o, r0, r1, c0, c0 + 1))
        c0++;
    while (r0 < r1 && !any_wet(o, r0, r1, c1 - 1, c1))
        c1--;
    o->wet.row0 = r0, o->wet.row1 = r1, o->wet.column0 = c0, o->wet.column1 = c1;
    if (r0 == r1) // empty, so that the first hemisphere sets it anew
        o->wet.row0 = o->settings.rows, o->wet.row1 = 0, o->wet.column0 = o->settings.columns,
        o->wet.column1 = 0;
}

void oracle_drops_find_wet(struct oracle_drops *o)
{
    grow_wet(o, 0, o->settings.rows, 0, o->settings.columns);
    shrink_wet(o);
}

// --- hemispheres ---

struct oracle_drops_cell oracle_drops_cell_at(const struct oracle_drops *o, double x, double y)
{
    const double cell = o->settings.cell_mm;
    return (struct oracle_drops_cell){(int)floor((o->settings.rows * cell - y) / cell),
                                      (int)floor(x / cell)};
}

bool oracle_drops_on_pane(const struct oracle_drops *o, struct oracle_drops_cell cell)
{
    return cell.row >= 0 && cell.row < o->settings.rows && cell.column >= 0 &&
           cell.column < o->settings.columns;
}

void oracle_drops_place(struct oracle_drops *o, uint32_t id, double x, double y, double mass_mg)
{
    const double cell = o->settings.cell_mm;
    const int rows = o->settings.rows, columns = o->settings.columns;
    const double radius = cbrt(3 * mass_mg / (2 * M_PI * ORACLE_DROPS_DENSITY_MG_MM3));
    const int reach = (int)ceil(radius / cell);
    const struct oracle_drops_cell at = oracle_drops_cell_at(o, x, y);
    const int row0 = most(at.row - reach, 0), row1 = least(at.row + reach + 1, rows);
    const int column0 = most(at.column - reach, 0), column1 = least(at.column + reach + 1, columns);
    if (row0 >= row1 || column0 >= column1)
        return;
    grow_wet(o, row0, row1, column0, column1);
    for (int i = row0; i < row1; i++) {
        const double dy = rows * cell - (cell * i + cell / 2) - y;
        const double chord = radius * radius - dy * dy;
        for (int j = column0; j < column1; j++) {
            const double dx = cell * j + cell / 2 - x;
            const double square = chord - dx * dx;
            double *height = &o->height_mm[i * columns + j];
            if (square > *height * *height) {
                *height = sqrt(square);
                o->id[i * columns + j] = id;
            }
        }
    }
}

// --- smoothing ---

// Sums each cell of a row and its neighbours on both sides.
static void sum_row(const struct oracle_drops *o, int row, double *sums)
{
    const int last = o->settings.columns - 1;
    const int column0 = o->wet.column0, column1 = o->wet.column1;
    const double *height = &o->height_mm[row * o->settings.columns];
    for (int j = most(column0, 1); j < least(column1, last); j++)
        sums[j] = height[j - 1] + height[j] + height[j + 1];
    if (column0 == 0)
        sums[0] = height[0] + height[0] + height[least(1, last)];
    if (column1 > last)
        sums[last] = height[most(last - 1, 0)] + height[last] + height[last];
}

static void smooth_heights(struct oracle_drops *o)
{
    const int columns = o->settings.columns, last = o->settings.rows - 1;
    const double floor_mm = o->settings.erode_threshold_mm;
    double *above = o->sums[0], *here = o->sums[1], *below = o->sums[2];
    sum_row(o, most(o->wet.row0 - 1, 0), above);
    sum_row(o, o->wet.row0, here);
    for (int i = o->wet.row0; i < o->wet.row1; i++) {
        sum_row(o, least(i + 1, last), below);
        double *height = &o->height_mm[i * columns];
        for (int j = o->wet.column0; j < o->wet.column1; j++) {
            const double mean = (above[j] + here[j] + below[j]) / 9;
            height[j] = mean < floor_mm ? 0 : mean;
        }
        double *spare = above;
        above = here, here = below, below = spare;
    }
}

// Cells without an ID take that of the neighbouring row, else that of the next cell in their row.
// In this order of cells, the next cell has not changed yet.
static void take_right(uint32_t *restrict id, const uint32_t *restrict below, int begin, int end)
{
    for (int j = begin; j < end; j++) {
        const uint32_t own = id[j], first = below[j], second = id[j + 1];
        const uint32_t other = first ? first : second;
        id[j] = own ? own : other;
    }
}

static void take_left(uint32_t *restrict id, const uint32_t *restrict above, int begin, int end)
{
    for (int j = end - 1; j >= begin; j--) {
        const uint32_t own = id[j], first = above[j], second = id[j - 1];
        const uint32_t other = first ? first : second;
        id[j] = own ? own : other;
    }
}

static void spread_ids(struct oracle_drops *o)
{
    const int rows = o->settings.rows, columns = o->settings.columns;
    for (int i = o->wet.row0; i < least(o->wet.row1, rows - 1); i++)
        take_right(&o->id[i * columns], &o->id[(i + 1) * columns], o->wet.column0,
                   least(o->wet.column1, columns - 1));
    for (int i = o->wet.row1 - 1; i >= most(o->wet.row0, 1); i--)
        take_left(&o->id[i * columns], &o->id[(i - 1) * columns], most(o->wet.column0, 1),
                  o->wet.column1);
}

static void drop_ids(struct oracle_drops *o)
{
    const double least_mm = fmax(o->settings.id_threshold_mm, DBL_MIN); // dry cells have none
    for (int i = o->wet.row0; i < o->wet.row1; i++) {
        uint32_t *id = &o->id[i * o->settings.columns];
        const double *height = &o->height_mm[i * o->settings.columns];
        for (int j = o->wet.column0; j < o->wet.column1; j++)
            id[j] = height[j] >= least_mm ? id[j] : 0;
    }
}

void oracle_drops_smooth(struct oracle_drops *o)
{
    if (o->wet.row0 >= o->wet.row1)
        return;
    grow_wet(o, most(o->wet.row0 - 1, 0), least(o->wet.row1 + 1, o->settings.rows),
             most(o->wet.column0 - 1, 0), least(o->wet.column1 + 1, o->settings.columns));
    smooth_heights(o);
    spread_ids(o);
    drop_ids(o);
    shrink_wet(o);
}

// --- erosion ---

static void erode_row(const struct oracle_drops *o, double *height, uint32_t *id)
{
    const int last = o->settings.columns - 1;
    for (int j = o->wet.column0; j < o->wet.column1; j++) {
        if (height[j] == 0)
            continue;
        const int first = j;
        while (j < last && height[j + 1] > 0)
            j++;
        if (j < last)
            height[j] = 0, id[j] = 0;
        if (first > 0)
            height[first] = 0, id[first] = 0;
    }
}

void oracle_drops_erode(struct oracle_drops *o)
{
    const int columns = o->settings.columns;
    for (int i = o->wet.row0; i < o->wet.row1; i++)
        erode_row(o, &o->height_mm[i * columns], &o->id[i * columns]);
    shrink_wet(o);
}
