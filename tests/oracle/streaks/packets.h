// Properties that rain in packets must have, in double precision and without core/: its own rain
// frame, brute-force visibility, and statistical tests.
#ifndef RG_TESTS_ORACLE_STREAKS_PACKETS_H
#define RG_TESTS_ORACLE_STREAKS_PACKETS_H

#include <stdbool.h>
#include <stdint.h>

// The probability that a chi-square with this many degrees of freedom is at least this large by
// chance.
double oracle_chi_square_tail(double chi_square, double degrees);
// The probability that `count` numbers drawn evenly from [0, 1) are at least as uneven as these by
// chance (Kolmogorov and Smirnov). Sorts them.
double oracle_evenness(double *numbers, int64_t count);

// A small random generator for tests: splitmix64.
uint64_t oracle_random(uint64_t *state);
double oracle_uniform(uint64_t *state, double low, double high);

// The documented rain frame, for rain that falls along `fall`: x, y and s of a world point or
// direction, with its origin in the world.
struct oracle_frame {
    double origin[3], axes[3][3];
};
struct oracle_frame oracle_frame_at(const double origin[3], const double fall[3]);
void oracle_to_world(const struct oracle_frame *frame, const double rain[3], double world[3]);

// A perspective camera in the world.
struct oracle_camera {
    double eye[3], ahead[3], right[3], up[3]; // of length 1, at right angles
    double tangent, aspect, near_m;           // tangent: of half the vertical angle
};
struct oracle_camera oracle_camera_at(const double eye[3], const double target[3],
                                      const double up[3], double angle_deg, double aspect,
                                      double near_m);
bool oracle_sees(const struct oracle_camera *camera, const double world[3]);

// A column of rain: a particle's place on the top plane, the width that it may draw across it, and
// the range of s in which it may draw. Returns whether any of `tries` random points of it is seen.
bool oracle_sees_column(const struct oracle_camera *camera, const struct oracle_frame *frame,
                        const double place[2], double across, double s_begin, double s_end,
                        int tries, uint64_t *random);

// The mass of the round gradient over [-1, 1]^2, 1 in the middle and 0 at the rim, in a rectangle.
double oracle_gradient_mass(double left, double top, double right, double bottom);

#endif
