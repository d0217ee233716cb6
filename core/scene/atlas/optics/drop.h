// The oscillating drop: two sets of ten oscillations, its shape at a moment, and the motion of its
// image over the exposure.
#ifndef RG_CORE_SCENE_ATLAS_OPTICS_DROP_H
#define RG_CORE_SCENE_ATLAS_OPTICS_DROP_H

// How drops swing: as Garg and Nayar's database has them, or as was measured in wind tunnels.
enum rg_swings { RG_SWINGS_MEASURED, RG_SWINGS_DATABASE };

// The surface, in radii of a sphere:
//   r = 1 + a P20(cos theta) + b P31(cos theta) cos(phi - phi_drop)
// theta from +y; (mx, mz) is the horizontal direction of phi_drop. A ray inside passes through the
// surface where it would meet it nearer than `blind`.
struct rg_drop_shape {
    float a, b, mx, mz, blind;
};

// An upper bound of the distance of the surface from its centre, in radii.
#define RG_DROP_REACH 1.31f

// The index of refraction of water in visible light, and the radius of the drop.
#define RG_DROP_INDEX    1.333f
#define RG_DROP_RADIUS_M 1.6e-3
#define RG_EXPOSURE_S    (1.0 / 60)

// The drop's fall in the exposure, in its diameters: 8.16 m/s.
#define RG_DROP_FALL 42.5

// The database's streaks are made of pictures of the drop, a 45th of the exposure apart, each of
// which fades into the next one.
enum { RG_DATABASE_POSES = 45 };

// The shape in an oscillation of the set, 0 to 9, at a time in seconds.
struct rg_drop_shape rg_drop_shape(enum rg_swings swings, int oscillation, double time_s);

#endif
