#include "tests/oracle/streaks/far.h"

#include <math.h>
#include <stdbool.h>

#include "tests/oracle/streaks/light.h"
#include "tests/oracle/vectors.h"

static const double pi = 3.14159265358979323846;

enum { SWINGS = 128, PARTS = 48 };

void streak_means_find(const struct streak_atlas *atlas, struct streak_means *means)
{
    *means = (struct streak_means){0};
    const int count = SWINGS * STREAK_OSCILLATIONS;
    for (int i = 0; i < count; i++) {
        const int oscillation = i % STREAK_OSCILLATIONS;
        const double swing = (i / STREAK_OSCILLATIONS + 0.5) / SWINGS;
        for (int view = 0; view < STREAK_VIEWS; view++) {
            means->skies[view] += streak_texture(atlas, oscillation, STREAK_LEVELS - 1, view,
                                                 STREAK_SKY, 0.5, swing) /
                                  count;
            for (int column = 0; column < STREAK_HEIGHTS * STREAK_AZIMUTHS; column++)
                means->points[view][column] += streak_texture(atlas, oscillation, STREAK_LEVELS - 1,
                                                              view, column, 0.5, swing) /
                                               count;
        }
    }
}

// A ray of length 1, and the elevation at which it sees drops, in steps of the atlas.
struct ray {
    double of[3];
    double per_m; // its way across the squares in a metre
    int axis;
    double elevation;
};

static void find_ray(const struct streak_view *view, const struct streak_far *far, int x, int y,
                     struct ray *ray)
{
    add(view->ahead, view->right, (x + 0.5 - view->width / 2.0) / view->focal_px, ray->of);
    add(ray->of, view->above, -(y + 0.5 - view->height / 2.0) / view->focal_px, ray->of);
    make_unit(ray->of);
    const double first = dot(ray->of, far->axes[0]), second = dot(ray->of, far->axes[1]);
    ray->axis = fabs(first) < fabs(second);
    ray->per_m = ray->axis ? second : first;
    ray->elevation = asin(clamped(-dot(ray->of, view->up), -1, 1)) * 9 / pi;
}

// The light of a streak from an elevation, between two views.
static double seen_from(double elevation, const double *first, int pitch)
{
    const double view = fmin(fabs(elevation), STREAK_VIEWS - 1);
    const int lower = (int)fmin(floor(view), STREAK_VIEWS - 2);
    return first[lower * pitch] * (lower + 1 - view) + first[(lower + 1) * pitch] * (view - lower);
}

// Adds the radiance of the lights on drops at a place. Returns a number for the nearest cells of
// all lights.
static long add_lights(const struct streak_view *view, const struct streak_means *means,
                       const struct ray *ray, const double at[3], double share, double light[3])
{
    long nearest = 0;
    for (int i = 0; i < view->light_count; i++) {
        const struct streak_light *l = &view->lights[i];
        double to_light[3], shown = 0;
        const double reached = streak_reach(l, at, to_light);
        const struct streak_cells cells =
            streak_cells_of(view, ray->elevation < 0, ray->of, to_light);
        for (int k = 0; k < 4; k++)
            shown += cells.parts[k] * seen_from(ray->elevation, &means->points[0][cells.columns[k]],
                                                STREAK_HEIGHTS * STREAK_AZIMUTHS);
        for (int c = 0; c < 3; c++)
            light[c] += share * pi * reached * shown * l->colour[c];
        nearest = nearest * STREAK_HEIGHTS * STREAK_AZIMUTHS + cells.columns[0];
    }
    return nearest;
}

// Draws a slab's part of a ray, in metres along it. True if a light's nearest cell changes there.
static bool draw_part(const struct streak_view *view, const struct streak_far *far,
                      const struct streak_means *means, const struct ray *ray, double first,
                      double last, double light[3])
{
    // The share of the ray that drops cover, times the ratio of a drop's time at a place to the
    // atlas' time there. A cell of the atlas is 32 texels wide, a drop 23.744.
    const double shown = fmin(fabs(ray->elevation), STREAK_VIEWS - 1);
    const double covers = far->drops_m3 * (last - first) * 2 * far->radius_m *
                          (2 * far->radius_m * 32 / 23.744) / streak_atlas_share(shown);
    const double sky = covers * seen_from(ray->elevation, means->skies, 1);
    double added[3];
    long nearest = 0;
    bool changes = false;
    for (int c = 0; c < 3; c++)
        added[c] = sky * view->sky[c];
    for (int i = 0; i < PARTS; i++) {
        double at[3];
        add(view->eye, ray->of, first + (last - first) * (i + 0.5) / PARTS, at);
        const long here = add_lights(view, means, ray, at, covers / PARTS, added);
        changes |= i > 0 && here != nearest;
        nearest = here;
    }
    for (int c = 0; c < 3; c++)
        light[c] = added[c] * view->gain + (1 - fmin(sky * view->opacity, 1)) * light[c];
    return changes;
}

bool streak_far_draw(const struct streak_view *view, const struct streak_far *far,
                     const struct streak_means *means, int x, int y, double light[3])
{
    struct ray ray;
    find_ray(view, far, x, y, &ray);
    const double steep = fabs(ray.per_m), eye = far->eye[ray.axis] * (ray.per_m < 0 ? -1 : 1);
    const int nearest = (int)floor((eye + far->nearest_m) / far->slab_m),
              farthest = (int)floor((eye + far->farthest_m) / far->slab_m);
    bool changes = false;
    for (int slab = farthest; slab >= nearest; slab--) {
        const double first = fmax(slab * far->slab_m - eye, far->nearest_m),
                     last = fmin((slab + 1) * far->slab_m - eye, far->farthest_m);
        if (last > first)
            changes |= draw_part(view, far, means, &ray, first / steep, last / steep, light);
    }
    return changes;
}
