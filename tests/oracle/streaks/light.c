#include "tests/oracle/streaks/light.h"

#include <math.h>

#include "tests/oracle/streaks/atlas.h"
#include "tests/oracle/vectors.h"

static const double pi = 3.14159265358979323846;

double streak_reach(const struct streak_light *light, const double at[3], double to_light[3])
{
    if (light->kind == STREAK_SUN) {
        for (int i = 0; i < 3; i++)
            to_light[i] = -light->direction[i];
        return 1;
    }
    add(light->at, at, -1, to_light);
    const double squared = dot(to_light, to_light);
    make_unit(to_light);
    double cone = 1;
    if (light->kind == STREAK_SPOT) {
        const double inner = cos(light->inner_deg * pi / 180),
                     outer = cos(light->outer_deg * pi / 180);
        const double t =
            clamped((-dot(to_light, light->direction) - outer) / (inner - outer), 0, 1);
        cone = t * t * (3 - 2 * t);
    }
    return cone / fmax(squared, 0.01);
}

// The two samples around a value and the share of the second; without blending, the nearest sample
// alone.
static void between(double value, int count, bool blended, int at[2], double *share)
{
    at[0] = (int)(blended ? fmin(floor(value), count - 2) : floor(value + 0.5));
    at[1] = blended ? at[0] + 1 : at[0];
    *share = blended ? value - at[0] : 0;
}

struct streak_cells streak_cells_of(const struct streak_view *view, bool below, const double ray[3],
                                    const double to_light[3])
{
    double right[3], turned[3];
    cross(ray, view->up, right);
    cross(view->up, right, turned); // ahead, across the fall
    const double aside = dot(to_light, right),
                 azimuth = atan2(fabs(aside), -dot(to_light, turned)) * 9 / pi - 0.5;
    const double height = asin(clamped(dot(to_light, view->up), -1, 1)) * 9 / pi *
                              (below && !view->absolute ? -1 : 1) +
                          4.5;
    int azimuths[2], heights[2];
    double share, higher;
    between(clamped(azimuth, 0, STREAK_AZIMUTHS - 1), STREAK_AZIMUTHS, view->taps >= 4, azimuths,
            &share);
    between(clamped(height, 0, STREAK_HEIGHTS - 1), STREAK_HEIGHTS, view->taps >= 8, heights,
            &higher);
    struct streak_cells cells = {.mirrored = aside < 0};
    for (int i = 0; i < 4; i++) {
        cells.parts[i] = (i & 1 ? share : 1 - share) * (i & 2 ? higher : 1 - higher);
        cells.columns[i] = heights[i >> 1] * STREAK_AZIMUTHS + azimuths[i & 1];
    }
    return cells;
}
