// Lobes of light: which lamps a direction meets, and how bright they are there.
#ifndef RG_CORE_SCENE_ATLAS_LIGHTS_H
#define RG_CORE_SCENE_ATLAS_LIGHTS_H

#include <stdbool.h>

#include "core/scene/atlas/atlas.h"

// Lights at elevation -90 and 90 have no azimuth, so that 90 cells share 74 directions.
enum { RG_LOBE_COUNT = 2 + (RG_ATLAS_LIGHTS - 2) * RG_ATLAS_PHIS };

// A lamp is an even disc of this radius, as in the database's pictures. Its rim fades from half a
// degree inside to half a degree outside, so that the steps between rays don't show.
#define RG_LAMP_DEG 7.5
#define RG_RIM_DEG  0.5

// A grid on the faces of a cube sorts directions; each square lists the lights that directions in
// it can meet.
enum { RG_LOBE_GRID = 32, RG_LOBE_SQUARES = 6 * RG_LOBE_GRID * RG_LOBE_GRID, RG_LOBE_STEPS = 1024 };

struct rg_lobes {
    int count;
    float direction[RG_LOBE_COUNT][3]; // towards the light, unit vectors
    float peak;                        // radiance at the centre, for an irradiance of 1
    float edge;                        // cosine of the angle beyond which a light is dark
    float profile[RG_LOBE_STEPS + 2];  // radiance over the peak, at even steps of the cosine
    unsigned char listed[RG_LOBE_SQUARES], list[RG_LOBE_SQUARES][RG_LOBE_COUNT];
};

// The direction of a light at an elevation and an azimuth, counted from the viewer's (+z) towards
// the right (+x).
void rg_lobe_direction(double elevation_deg, double azimuth_deg, float direction[3]);

// The lobe of a cell: light 0 to 9, phi 0 to 8.
int rg_lobe_of_cell(int light, int phi);

// The solid angle, in sr, of the directions nearer to this lobe of the atlas than to others by
// elevation and azimuth, together with its mirror image on the viewer's left: all 74 make the
// sphere.
double rg_lobe_share_sr(int lobe);

// Make lobes for the 74 directions, or for any `count` others, up to RG_LOBE_COUNT, and for lamps
// of any radius.
void rg_lobes_of_atlas(struct rg_lobes *lobes);
void rg_lobes_fill(struct rg_lobes *lobes, int count, float (*directions)[3], double lamp_deg);

// The grid square of a direction.
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
