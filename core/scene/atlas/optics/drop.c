#include "core/scene/atlas/optics/drop.h"

#include <math.h>

#define TENSION_N_M   0.0728
#define DENSITY_KG_M3 1000.0

// The amplitudes of the modes (2,0) and (3,1), in radii, and the azimuth of the second. They were
// fitted to the database's pictures: to the widths and swing of its streaks, and (3,1) to the
// shapes of its highlights.
static const struct {
    double a20, a31, phi_deg;
} oscillations[10] = {
    {0, 0, 0},       {0.2, 0, 0},     {0.1, 0.1, 270}, {0.1, 0.1, 0},  {0.1, 0.1, 90},
    {0.1, 0.1, 180}, {0.2, 0.1, 270}, {0.2, 0.1, 0},   {0.2, 0.1, 90}, {0.2, 0.1, 180},
};

// The angular frequency of a mode. (2,0) swings at Rayleigh's frequency, sqrt(8 tension / (density
// r^3)). In the database (3,1) swings twice as often, two whole times an exposure; Rayleigh's value
// is 1.94 times.
static double angular_frequency(int n)
{
    const double r3 = RG_DROP_RADIUS_M * RG_DROP_RADIUS_M * RG_DROP_RADIUS_M;
    return (n - 1) * sqrt(8 * TENSION_N_M / (DENSITY_KG_M3 * r3));
}

struct rg_drop_shape rg_drop_shape(int oscillation, double time_s)
{
    const double phi = oscillations[oscillation].phi_deg * M_PI / 180;
    return (struct rg_drop_shape){
        .a = (float)(oscillations[oscillation].a20 * sin(angular_frequency(2) * time_s)),
        .b = (float)(oscillations[oscillation].a31 * sin(angular_frequency(3) * time_s)),
        .mx = (float)sin(phi),
        .mz = (float)cos(phi),
    };
}
