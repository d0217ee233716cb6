// Lobes of light: which of a set of lights a direction looks into, and how bright they are there.
#ifndef RG_CORE_SCENE_ATLAS_LIGHTS_H
#define RG_CORE_SCENE_ATLAS_LIGHTS_H

#include <stdbool.h>

#include "core/scene/atlas/atlas.h"

// A light at elevation -90 or 90 has no azimuth, so 74 directions fill the 90 cells.
enum { RG_LOBE_COUNT = 2 + (RG_ATLAS_LIGHTS - 2) * RG_ATLAS_PHIS };

// The standard deviation of a light's radiance about its direction, a Gaussian on the sphere.
#define RG_LOBE_DEG 3.0

// Directions are sorted into a grid on the faces of a cube; each of its squares lists the lights
// that a direction in it can look into.
enum { RG_LOBE_GRID = 32, RG_LOBE_SQUARES = 6 * RG_LOBE_GRID * RG_LOBE_GRID, RG_LOBE_STEPS = 1024 };

struct rg_lobes {
    int count;
    float direction[RG_LOBE_COUNT][3]; // towards the light, unit vectors
    float peak;                        // radiance in the middle, for an irradiance of 1
    float edge;                        // cosine beyond which a light is dark
    float profile[RG_LOBE_STEPS + 2];  // radiance over the peak, in even steps of the cosine
    unsigned char listed[RG_LOBE_SQUARES], list[RG_LOBE_SQUARES][RG_LOBE_COUNT];
};

// A light at an elevation and an azimuth from the viewer's (+z) towards the right (+x).
void rg_lobe_direction(double elevation_deg, double azimuth_deg, float direction[3]);

// The lobe of a cell: light 0 to 9, phi 0 to 8.
int rg_lobe_of_cell(int light, int phi);

// The part of the sphere, in sr, that is nearer to a lobe of the atlas than to the other ones by
// elevation and azimuth, with its mirror image on the viewer's left: all 74 make the sphere.
double rg_lobe_share_sr(int lobe);

// Lobes about the directions of the 74, or about any `count` others, up to RG_LOBE_COUNT.
void rg_lobes_of_atlas(struct rg_lobes *lobes);
void rg_lobes_fill(struct rg_lobes *lobes, int count, float (*directions)[3]);

// The square of the grid in which a direction lies.
int rg_lobes_square(float x, float y, float z);

// The radiance of a light in a direction, given the cosine of the angle between the two.
static inline float rg_lobe_radiance(const struct rg_lobes *lobes, float cosine)
{
    if (cosine <= lobes->edge)
        return 0;
    const float at = (cosine - lobes->edge) * (RG_LOBE_STEPS / (1 - lobes->edge));
    const int step = at < RG_LOBE_STEPS ? (int)at : RG_LOBE_STEPS;
    const float low = lobes->profile[step], high = lobes->profile[step + 1];
    return lobes->peak * (low + (at - (float)step) * (high - low));
}

#endif
