// What rain in packets must obey, in double precision and without core/: a rain frame of its own,
// brute-force visibility, and the tests of statistics.
#ifndef RG_TESTS_ORACLE_STREAKS_PACKETS_H
#define RG_TESTS_ORACLE_STREAKS_PACKETS_H

#include <stdbool.h>
#include <stdint.h>

// The probability that a chi-square of so many degrees of freedom is at least this large, by
// chance.
double oracle_chi_square_tail(double chi_square, double degrees);
// Whether `count` numbers come evenly from [0, 1): the probability that they are at least as uneven
// as this, by chance (Kolmogorov and Smirnov). Sorts them.
double oracle_evenness(double *numbers, int64_t count);

// A small generator for tests: splitmix64.
uint64_t oracle_random(uint64_t *state);
double oracle_uniform(uint64_t *state, double low, double high);

// The rain frame as it is documented: x, y and s of a world point or direction, with its origin in
// the world, for rain that falls along `fall`.
struct oracle_frame {
    double origin[3], axes[3][3];
};
struct oracle_frame oracle_frame_at(const double origin[3], const double fall[3]);
void oracle_to_world(const struct oracle_frame *frame, const double rain[3], double world[3]);

// A perspective camera in the world.
struct oracle_camera {
    double eye[3], ahead[3], right[3], up[3]; // of length 1, at right angles
    double tangent, aspect, near_m;           // of half the vertical angle
};
struct oracle_camera oracle_camera_at(const double eye[3], const double target[3],
                                      const double up[3], double angle_deg, double aspect,
                                      double near_m);
bool oracle_sees(const struct oracle_camera *camera, const double world[3]);

// A column of rain: the place of a particle on the top plane, what it may draw across it, and the
// range of s in which it may draw. Whether any of `tries` points of it, thrown at random, is seen.
bool oracle_sees_column(const struct oracle_camera *camera, const struct oracle_frame *frame,
                        const double place[2], double across, double s_begin, double s_end,
                        int tries, uint64_t *random);

// The round gradient over [-1, 1]^2, 1 in the middle and 0 at the rim, summed over a rectangle.
double oracle_gradient_mass(double left, double top, double right, double bottom);

#endif
