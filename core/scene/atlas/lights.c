#include "core/scene/atlas/lights.h"

#include <math.h>
#include <string.h>

// The most that half the diagonal of a grid square can be: at a face's middle, 2 / 32 / sqrt(2).
#define SQUARE_REACH_RAD 0.0443

void rg_lobe_direction(double elevation_deg, double azimuth_deg, float direction[3])
{
    const double elevation = elevation_deg * M_PI / 180, azimuth = azimuth_deg * M_PI / 180;
    direction[0] = (float)(cos(elevation) * sin(azimuth));
    direction[1] = (float)sin(elevation);
    direction[2] = (float)(cos(elevation) * cos(azimuth));
}

int rg_lobe_of_cell(int light, int phi)
{
    if (light == 0 || light == RG_ATLAS_LIGHTS - 1)
        return light ? RG_LOBE_COUNT - 1 : 0;
    return 1 + (light - 1) * RG_ATLAS_PHIS + phi;
}

double rg_lobe_share_sr(int lobe)
{
    const double half = 10 * M_PI / 180;
    if (lobe == 0 || lobe == RG_LOBE_COUNT - 1)
        return 2 * M_PI * (1 - cos(half));
    const double elevation = (20 * (1 + (lobe - 1) / RG_ATLAS_PHIS) - 90) * M_PI / 180;
    return 4 * half * (sin(elevation + half) - sin(elevation - half));
}

void rg_lobes_of_atlas(struct rg_lobes *lobes)
{
    float directions[RG_LOBE_COUNT][3];
    for (int light = 0; light < RG_ATLAS_LIGHTS; light++)
        for (int phi = 0; phi < RG_ATLAS_PHIS; phi++)
            rg_lobe_direction(20 * light - 90, 10 + 20 * phi,
                              directions[rg_lobe_of_cell(light, phi)]);
    rg_lobes_fill(lobes, RG_LOBE_COUNT, directions, RG_LAMP_DEG);
}

// The direction of a square's middle.
static void middle_of(int square, double d[3])
{
    const int face = square / (RG_LOBE_GRID * RG_LOBE_GRID), axis = face / 2;
    const double s = (square % RG_LOBE_GRID + 0.5) * 2 / RG_LOBE_GRID - 1;
    const double t = (square / RG_LOBE_GRID % RG_LOBE_GRID + 0.5) * 2 / RG_LOBE_GRID - 1;
    const double length = sqrt(1 + s * s + t * t);
    d[axis] = (face % 2 ? -1 : 1) / length;
    d[(axis + 1) % 3] = s / length;
    d[(axis + 2) % 3] = t / length;
}

static int clamp_index(float s)
{
    const int i = (int)((s + 1) * (RG_LOBE_GRID / 2));
    return i < 0 ? 0 : i < RG_LOBE_GRID ? i : RG_LOBE_GRID - 1;
}

int rg_lobes_square(float x, float y, float z)
{
    const float d[3] = {x, y, z};
    const int wider = fabsf(y) > fabsf(x) ? 1 : 0, axis = fabsf(z) > fabsf(d[wider]) ? 2 : wider;
    const float scale = 1 / fabsf(d[axis]);
    const int s = clamp_index(d[(axis + 1) % 3] * scale);
    const int t = clamp_index(d[(axis + 2) % 3] * scale);
    return ((2 * axis + (d[axis] < 0)) * RG_LOBE_GRID + t) * RG_LOBE_GRID + s;
}

// Fills the profile of a lamp, and the radiance at which its irradiance is 1.
static void fill_profile(struct rg_lobes *lobes, double lamp_deg)
{
    const double edge = cos((lamp_deg + RG_RIM_DEG) * M_PI / 180);
    double irradiance = 0;
    lobes->edge = (float)edge;
    for (int i = 0; i < RG_LOBE_STEPS + 2; i++) {
        const double cosine = fmin(1, edge + (1 - edge) * i / RG_LOBE_STEPS);
        const double inwards_deg = lamp_deg - acos(cosine) * 180 / M_PI;
        const double radiance = fmin(fmax(0.5 + 0.5 * inwards_deg / RG_RIM_DEG, 0), 1);
        const double part = i == 0 || i == RG_LOBE_STEPS ? 0.5 : i < RG_LOBE_STEPS;
        lobes->profile[i] = (float)radiance;
        irradiance += radiance * part * 2 * M_PI * (1 - edge) / RG_LOBE_STEPS;
    }
    lobes->peak = (float)(1 / irradiance);
}

void rg_lobes_fill(struct rg_lobes *lobes, int count, float (*directions)[3], double lamp_deg)
{
    lobes->count = count;
    memcpy(lobes->direction, directions, (size_t)count * sizeof(*directions));
    fill_profile(lobes, lamp_deg);
    const double reach = cos((lamp_deg + RG_RIM_DEG) * M_PI / 180 + SQUARE_REACH_RAD);
    for (int square = 0; square < RG_LOBE_SQUARES; square++) {
        double d[3];
        middle_of(square, d);
        int listed = 0;
        for (int l = 0; l < count; l++) {
            const float *to = lobes->direction[l];
            if (d[0] * (double)to[0] + d[1] * (double)to[1] + d[2] * (double)to[2] > reach)
                lobes->list[square][listed++] = (unsigned char)l;
        }
        lobes->listed[square] = (unsigned char)listed;
    }
}
