// Ye's rain in double precision, written from the paper's equations: one step of a particle, where
// it may be born, and where it is seen. It shares nothing with kernels/.
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

// Eq. 2: the distance at which a drop of this height is a pixel high.
double oracle_farthest(double drop_height_m, double beta, int height_px);

// A place for the viewer: the distance ahead, and how far it is beside and above the middle, as
// shares of half the view's width and height. Visible places have shares of -1 to 1.
struct oracle_sight {
    double ahead, across, up;
};
struct oracle_sight oracle_sight_of(const struct oracle_rain *rain, const struct oracle_drop *drop);
// The inverse of oracle_sight_of.
struct oracle_drop oracle_drop_at(const struct oracle_rain *rain, const struct oracle_sight *sight);

// The drop's share of size and speed in its layer (section III.E).
double oracle_share(const struct oracle_rain *rain, const struct oracle_drop *drop);

// Eqs. 14 and 15, or 16 to 18: a drop after one step.
struct oracle_drop oracle_moved(const struct oracle_rain *rain, const struct oracle_drop *drop);

// The distance of a drop inside the visible body, in metres, to the nearest of the six sides. The
// sides are planes through the body's corners. Below 0 the drop has left.
double oracle_inside(const struct oracle_rain *rain, const struct oracle_drop *drop);

// Spherical coordinates of a place, by eqs. 3 to 5.
struct oracle_sphere {
    double r, phi, theta;
};
struct oracle_sphere oracle_sphere_of(const struct oracle_rain *rain,
                                      const struct oracle_drop *drop);

// A drop in the picture: its lower and upper end, in pixels from the upper left corner, and its
// width there.
struct oracle_streak {
    double low[2], high[2], width_px;
};
struct oracle_streak oracle_streak_of(const struct oracle_rain *rain,
                                      const struct oracle_drop *drop);

#endif
