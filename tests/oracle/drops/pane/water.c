#include "tests/oracle/drops/pane/water.h"

#include <math.h>

#include "tests/oracle/optics/fresnel.h"

// The cubic B-spline about 0, and its derivatives.
static double basis(double t)
{
    const double a = fabs(t);
    return a < 1 ? 2.0 / 3 - a * a + a * a * a / 2 : a < 2 ? pow(2 - a, 3) / 6 : 0;
}

static double basis_slope(double t)
{
    const double a = fabs(t), sign = t < 0 ? -1 : 1;
    return sign * (a < 1 ? 1.5 * a * a - 2 * a : a < 2 ? -(2 - a) * (2 - a) / 2 : 0);
}

static double basis_bend(double t)
{
    const double a = fabs(t);
    return a < 1 ? 3 * a - 2 : a < 2 ? 2 - a : 0;
}

static double cell_height(const struct water_map *map, int column, int row)
{
    column = column < 0 ? 0 : column >= map->columns ? map->columns - 1 : column;
    row = row < 0 ? 0 : row >= map->rows ? map->rows - 1 : row;
    return (double)map->height_mm[row * map->columns + column];
}

struct water_surface water_surface_at(const struct water_map *map, double x_mm, double y_mm)
{
    const double l = map->cell_mm;
    struct water_surface s = {0};
    double xx = 0, xy = 0, yy = 0;
    for (int row = (int)floor(y_mm / l) - 3; row <= (int)floor(y_mm / l) + 3; row++)
        for (int column = (int)floor(x_mm / l) - 3; column <= (int)floor(x_mm / l) + 3; column++) {
            const double h = cell_height(map, column, row);
            const double u = x_mm / l - (column + 0.5), v = y_mm / l - (row + 0.5);
            s.height += h * basis(u) * basis(v);
            s.slope[0] += h * basis_slope(u) * basis(v) / l;
            s.slope[1] += h * basis(u) * basis_slope(v) / l;
            xx += h * basis_bend(u) * basis(v) / (l * l);
            xy += h * basis_slope(u) * basis_slope(v) / (l * l);
            yy += h * basis(u) * basis_bend(v) / (l * l);
        }
    s.bend = sqrt(xx * xx + xy * xy + xy * xy + yy * yy);
    return s;
}

double water_pass(const double d[3], const double normal[3], double n1, double n2, double passed[3])
{
    double along = 0, across[3], sine = 0;
    for (int i = 0; i < 3; i++)
        along += d[i] * normal[i];
    along = fmax(along, 0); // light from behind would graze
    for (int i = 0; i < 3; i++) {
        across[i] = d[i] - along * normal[i];
        sine += across[i] * across[i];
    }
    const double before = acos(fmin(along, 1)), sine_after = n1 / n2 * sin(before);
    if (sine_after >= 1)
        return 1;
    const double after = asin(sine_after), length = sqrt(sine);
    for (int i = 0; i < 3; i++)
        passed[i] = normal[i] * cos(after) + (length > 0 ? across[i] / length * sine_after : 0);
    return fresnel(before, n1 / n2);
}
