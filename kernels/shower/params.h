// Parameters and buffers of all kernels of shower, shared with the host: Ye, "Raining Simulation
// based on Improved Particle Systems algorithms". Lengths are metres in the world, y up.
#ifndef RG_KERNELS_SHOWER_PARAMS_H
#define RG_KERNELS_SHOWER_PARAMS_H

#include "kernels/dialect/matrix.h"

// Planes of the buffer `particles`: a word of a particle is beside the same word of the next one,
// so that compilers vectorise over particles.
#define SHOWER_X     0
#define SHOWER_Y     1
#define SHOWER_Z     2
#define SHOWER_FALL  3 // the rate of decline, m/s; 0: the slot has no particle
#define SHOWER_WORDS 4

// Planes of the buffer `attributes`, which the traditional system keeps beside them.
#define SHOWER_VX         0 // m/s
#define SHOWER_VZ         1
#define SHOWER_AX         2 // m/s^2
#define SHOWER_AY         3
#define SHOWER_AZ         4
#define SHOWER_AGE        5 // frames
#define SHOWER_ATTRIBUTES 6

// The buffer `marks`: the state of each slot after the step.
#define SHOWER_STAYS    0u
#define SHOWER_FREE     1u // there is no particle: a new one may be born or placed here
#define SHOWER_PROMOTED 2u // it left at one end of its column and came in at the other
#define SHOWER_CROSSED  3u // it left by a side and came in again

// Words of the buffer `tally`.
#define SHOWER_ALIVE  0 // particles
#define SHOWER_BORN   1 // since the beginning, modulo 2^32, as all that follow
#define SHOWER_DIED   2
#define SHOWER_RAISED 3 // promotions
#define SHOWER_PASSED 4 // particles that left by a side and came in again
#define SHOWER_PLACED 5 // particles that got another place, since their column has no top
#define SHOWER_TALLY  6

// Streams of random numbers, one a purpose.
#define SHOWER_PLACE  1u
#define SHOWER_NUMBER 2u

#define SHOWER_CHUNK 64 // slots that an item of shower_promote goes over

RG_STRUCT(shower_plane)
{
    float x, y, z; // its unit normal, which points into the body
    float at;      // x px + y py + z pz + at is the distance of a point inside
};
RG_STRUCT_SIZE(shower_plane, 4)

RG_STRUCT(shower_params)
{
    // The six sides of the body that is seen (section III.B).
    shower_plane front, back, left, right, top, bottom;
    // Particles.
    int slots;
    int wanted; // particles that there should be in this step (eq. 1)
    uint seed;
    uint step;
    float step_s;
    int is_full;     // 1: attributes are kept
    int accelerates; // 1: eqs. 12 to 15; 0: eqs. 16 to 18
    int is_promoted; // 1: particles are promoted; 0: they die and are born
    int is_layered;  // 1: drops of the layers behind are smaller and slower (section III.E)
    // Motion.
    float wind_x, wind_z; // m/s (eqs. 9 and 11)
    float fall_m_s;       // of a new particle (eq. 10)
    float gravity_m_s2;   // (eq. 13)
    // The wind through the region, relative to the viewer: the share of the particles leaving on
    // the left that comes in again on the right, and vice versa. As many come in as the wind blows
    // in there.
    float left_to_right, right_to_left;
    float thinning_m; // distance that it carries away from the viewer in a step, or 0
    float to_left;    // of those that it then brings in at the sides, the share on the left
    // The region (eqs. 2 to 8).
    float eye_x, eye_y, eye_z;
    float ahead_x, ahead_z; // unit vector along the view, which is level
    float across, above;    // tangents of half the angles of view
    float near_m, far_m;
    float phi_rad, phi_span_rad; // the angle from straight up
    float theta_rad, theta_span_rad;
    int is_even; // 1: births are uniform in volume; 0: uniform in distance and angle
    // Drops.
    float height_m, width_m;
    // The ground, and the scene seen from above.
    float ground_m;
    float map_x, map_z;         // its first texel's corner
    float map_per_x, map_per_z; // maps per metre
    float map_top_m, map_height_m;
};
RG_STRUCT_SIZE(shower_params, 64)

#endif
