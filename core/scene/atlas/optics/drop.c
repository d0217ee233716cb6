#include "core/scene/atlas/optics/drop.h"

#include <math.h>
#include <stdbool.h>

#define TENSION_N_M   0.0728
#define DENSITY_KG_M3 1000.0

// The amplitudes of the modes (2,0) and (3,1), in radii, and the azimuth of the second.
struct swing {
    double a20, a31, phi_deg;
};

// Fitted to the database's pictures: to the widths and swing of its streaks, and (3,1) to the
// shapes of its highlights.
static const struct swing database[10] = {
    {0, 0, 0},       {0.2, 0, 0},     {0.1, 0.1, 270}, {0.1, 0.1, 0},  {0.1, 0.1, 90},
    {0.1, 0.1, 180}, {0.2, 0.1, 270}, {0.2, 0.1, 0},   {0.2, 0.1, 90}, {0.2, 0.1, 180},
};

// Drops of 2 mm, whose axis ratio Kubesh and Beard (1993) saw vary by up to 15 %, at the
// frequencies of (2,0) and of the first harmonic: 3/2 a20 to either side, so that a20 is 0.05 at
// most. How much of it is (3,1) is not published; half is taken. The smaller drops that rain is
// full of are rounder, those of the database larger.
static const struct swing measured[10] = {
    {0, 0, 0},           {0.05, 0, 0},         {0.025, 0.0125, 270}, {0.025, 0.0125, 0},
    {0.025, 0.0125, 90}, {0.025, 0.0125, 180}, {0.05, 0.025, 270},   {0.05, 0.025, 0},
    {0.05, 0.025, 90},   {0.05, 0.025, 180},
};

// At rest they are 0.926 times as high as wide (Chuang and Beard, 1990). That their base is flatter
// than their top is left out: seen from below, the atlas shows them upside down.
#define MEASURED_REST_A20 (-0.051)

// The database's renderer missed a surface nearer than this to where a ray came from, 1 mm: light
// that runs along the wall of a bent drop leaves it straight on.
#define BLIND 0.6f

// The angular frequency of a mode. (2,0) swings at Rayleigh's frequency, sqrt(8 tension / (density
// r^3)). (3,1) swings twice as often, two whole times an exposure: so it does in the database, and
// so streaks of any length are a row of the atlas again and again. Rayleigh's value is 1.94 times.
static double angular_frequency(int n)
{
    const double r3 = RG_DROP_RADIUS_M * RG_DROP_RADIUS_M * RG_DROP_RADIUS_M;
    return (n - 1) * sqrt(8 * TENSION_N_M / (DENSITY_KG_M3 * r3));
}

struct rg_drop_shape rg_drop_shape(enum rg_swings swings, int oscillation, double time_s)
{
    const bool is_database = swings == RG_SWINGS_DATABASE;
    const struct swing *s = &(is_database ? database : measured)[oscillation];
    const double phi = s->phi_deg * M_PI / 180;
    return (struct rg_drop_shape){
        .a = (float)((is_database ? 0 : MEASURED_REST_A20) +
                     s->a20 * sin(angular_frequency(2) * time_s)),
        .b = (float)(s->a31 * sin(angular_frequency(3) * time_s)),
        .mx = (float)sin(phi),
        .mz = (float)cos(phi),
        .blind = is_database ? BLIND : 0,
    };
}
