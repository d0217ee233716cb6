// What the street's files share. Lengths are metres, x to the right of the street, y up from the
// ground, z along it. The eye is at (0, EYE_M, 0).
#ifndef RG_CORE_SCENE_ENVIRONMENT_PARTS_H
#define RG_CORE_SCENE_ENVIRONMENT_PARTS_H

#include <stdbool.h>
#include <stdint.h>

#include "core/scene/environment/street.h"

#define EYE_M      1.6
#define KERB_M     5.4 // half the roadway
#define FRONT_M    9.0 // from the middle to the houses
#define LAMP_X_M   6.0
#define LAMP_Y_M   5.2
#define LAMP_GAP_M 22.0 // between the lamps of a side; those of the other stand between them

// A time of day: gains of what shines, and colours of the sky.
struct street_look {
    enum street_time time;
    double zenith[3], horizon[3], cloud[3];
    double sky;     // light of the sky on walls and ground
    double lamps;   // light of street lamps
    double windows; // of lit windows
    double lit;     // share of windows that are
    double haze_m;  // at which haze takes half of the light
};

// 0 up to 1 from three whole numbers; noise that is smooth between whole numbers; and smooth noise
// with finer noise on it.
double street_chance(int a, int b, int c);
double street_noise(double x, double y, int seed);
double street_clouds(double x, double y, int seed);

// The whole number at or below x, |x| < 2^31.
static inline int street_floor(double x)
{
    const int cut = (int)x;
    return cut > x ? cut - 1 : cut;
}

static inline double street_clamp(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

static inline double street_smooth(double x)
{
    const double t = street_clamp(x);
    return t * t * (3 - 2 * t);
}

// The share of a window of `width` around x that stripes cover: in each unit, from 0 to `share`.
double street_stripes(double x, double share, double width);

// The share of light that water mirrors to a ray at an angle of this cosine (Schlick, 1994).
static inline double street_mirrored(double cosine)
{
    const double flat = 1 - cosine, flat2 = flat * flat;
    return .025 + .975 * flat2 * flat2 * flat;
}

// The colour of street lamps.
extern const double street_lamp[3];
// Their light at a place, without its colour: 0 by day.
double street_lamplight(const struct street_look *look, double x_m, double y_m, double z_m);

// The wall of a house: `row` is one of the street's two, 0 and 1, or of those behind it, 2 and 3;
// `along_m` is the place along it, `width_m` what a texel covers of it. Its height there is
// `street_height`.
double street_height(int row, double along_m);
struct street_wall {
    int row;
    double x_m, along_m, up_m, width_m;
};
void street_front(const struct street_look *look, const struct street_wall *wall, double light[3]);

// Adds lamps, cars' and traffic lights, and their streaks on the wet ground.
void street_add_lights(const struct street_look *look, struct rg_environment *environment);
// From the world, whose y is up too, to the street, or back: it is a mirror image, and so both.
void street_turn(const double from[3], double to[3]);

#endif
