// Rain in a scene by Feng et al., in double precision: how drops fall, how a camera sees them, and
// when they have hit.
#ifndef RG_TESTS_ORACLE_RAINFALL_H
#define RG_TESTS_ORACLE_RAINFALL_H

#include <stdbool.h>

struct rainfall_vector {
    double x, y, z;
};

struct rainfall_vector rainfall_sum(struct rainfall_vector a, struct rainfall_vector b,
                                    double share);
double rainfall_dot(struct rainfall_vector a, struct rainfall_vector b);
double rainfall_length(struct rainfall_vector a);

// Forces on a drop of mass 1: gravity, wind, and drag. Drag is constant and upwards, or goes with
// the square of the speed through the air.
struct rainfall_air {
    bool is_constant;
    double gravity, drag, k;
    double push_x, push_z; // the wind's force; with quadratic drag, its speed
};
struct rainfall_vector rainfall_acceleration(const struct rainfall_air *air,
                                             struct rainfall_vector velocity);

// A camera and its depths: 0 on the near plane, 1 on the far plane, row by row from the top.
struct rainfall_eye {
    struct rainfall_vector at, right, up, ahead;
    double focal_px, near_m, far_m;
    int width, height;
    const float *depth;
};
struct rainfall_eye rainfall_eye_of(const double position[3], const double target[3],
                                    double angle_deg, double near_m, double far_m, int width,
                                    int height);

struct rainfall_spot {
    double x_px, y_px, depth, distance_m;
    bool is_inside;    // the frustum
    bool is_at_border; // so near the border that rounding decides
};
struct rainfall_spot rainfall_spot_of(const struct rainfall_eye *eye, struct rainfall_vector p);
double rainfall_depth_of(const struct rainfall_eye *eye, double distance_m);

// Visible samples of a sphere: at least `least` for certain, at most `most` if rounding favours
// them.
struct rainfall_samples {
    int least, most;
};
struct rainfall_samples rainfall_count(const struct rainfall_eye *eye, struct rainfall_vector p,
                                       double radius_m);

// The distance of a point behind the visible surface, along the view, and the most that rounding of
// depth or place may change it.
struct rainfall_gap {
    double behind_m, doubt_m;
};
struct rainfall_gap rainfall_behind(const struct rainfall_eye *eye, struct rainfall_vector p);

// The parameter, 0 to 1, of the nearest point to `from` at which a way meets a triangle; -1: none.
double rainfall_meets(struct rainfall_vector from, struct rainfall_vector to,
                      const struct rainfall_vector corners[3]);

#endif
