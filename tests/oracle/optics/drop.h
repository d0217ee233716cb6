// Light through an oscillating drop, in double precision, by marching and bisection: slow and
// plain. It shares nothing with core/scene/atlas.
#ifndef RG_TESTS_ORACLE_OPTICS_DROP_H
#define RG_TESTS_ORACLE_OPTICS_DROP_H

#include <stdbool.h>

enum { ORACLE_WAYS = 5 };

// r = 1 + a (3 c^2 - 1) / 2 + b 3/2 s (5 c^2 - 1) cos(phi - phi_drop), angles in radians: phi is
// counted from +z to +x. Inside, a ray passes through a surface that is nearer than `blind`.
struct oracle_drop {
    double a, b, phi_drop, index, blind;
};

// One of the ten oscillations of a set at a part of the exposure: the database's, or the measured.
struct oracle_drop oracle_drop_at(bool database, int oscillation, double part);

// The distance of the surface from the drop's middle in the direction of a unit vector; y is up.
double oracle_drop_radius(const struct oracle_drop *drop, const double n[3]);

// The sources of the light on a ray from `start` in direction `ray`, against the light's way. Each
// way of light (reflected; refracted; with one to three reflections inside) gets a unit vector
// towards its source and its share. False if the ray misses the drop, or is lost within it (6 in
// 100,000 of a sphere's): then shares mean nothing.
bool oracle_drop_light(const struct oracle_drop *drop, const double start[3], const double ray[3],
                       double direction[ORACLE_WAYS][3], double share[ORACLE_WAYS]);

#endif
