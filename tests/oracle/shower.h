// Ye's rain in double precision, written from the paper's equations: what one particle does in one
// step, where it may be born, and where it is seen. It shares nothing with kernels/.
#ifndef RG_TESTS_ORACLE_SHOWER_H
#define RG_TESTS_ORACLE_SHOWER_H

#include <stdbool.h>

struct oracle_rain {
    // Motion.
    double step_s, wind_x, wind_z, fall_m_s, gravity_m_s2;
    bool accelerates, is_layered, tests_corners;
    // The view: level, `heading` radians about the upright axis from -z.
    double eye[3], heading;
    double alpha, beta; // angles of view, across and from top to bottom
    double near_m, far_m;
    double ground_m;
    // Drops, and the picture.
    double height_m, width_m;
    int width_px, height_px;
};

struct oracle_drop {
    double x, y, z, fall_m_s;
};

// Eq. 2: where a drop of this height is a pixel high.
double oracle_farthest(double drop_height_m, double beta, int height_px);

// A place as the viewer has it: how far ahead, and which share of half the view's width or height
// there it is beside or above the middle, -1 to 1 where it is seen.
struct oracle_sight {
    double ahead, across, up;
};
struct oracle_sight oracle_sight_of(const struct oracle_rain *rain, const struct oracle_drop *drop);
// The other way round.
struct oracle_drop oracle_drop_at(const struct oracle_rain *rain, const struct oracle_sight *sight);

// The share of size and speed that the drop's layer has (section III.E).
double oracle_share(const struct oracle_rain *rain, const struct oracle_drop *drop);

// Eqs. 14 and 15, or 16 to 18, over one step.
struct oracle_drop oracle_moved(const struct oracle_rain *rain, const struct oracle_drop *drop);

// How far inside of the body that is seen a drop is, in metres: by the nearest of the six sides,
// which are planes through corners of the body. Below 0 it has left.
double oracle_inside(const struct oracle_rain *rain, const struct oracle_drop *drop);

// Spherical coordinates of a place as eqs. 3 to 5 have them.
struct oracle_sphere {
    double r, phi, theta;
};
struct oracle_sphere oracle_sphere_of(const struct oracle_rain *rain,
                                      const struct oracle_drop *drop);

// A drop on the screen: its lower and upper end, in pixels from the upper left corner, and its
// width there.
struct oracle_streak {
    double low[2], high[2], width_px;
};
struct oracle_streak oracle_streak_of(const struct oracle_rain *rain,
                                      const struct oracle_drop *drop);

#endif
