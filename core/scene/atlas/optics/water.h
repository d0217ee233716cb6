// Light through splashed water: balls, a thin sheet, and a wave on the ground, in rays of double
// precision. Metres about the place of the impact: x to the right, y up, z away from the viewer.
#ifndef RG_CORE_SCENE_ATLAS_OPTICS_WATER_H
#define RG_CORE_SCENE_ATLAS_OPTICS_WATER_H

enum { RG_WATER_BALLS = 512, RG_WATER_WAYS = 48 };

struct rg_water_ball {
    double at[3], radius_m;
};

// At one moment. The sheet is a cone, `foot_m` wide at the ground and wider by `flare` a metre up;
// its edge is scalloped between `spikes` fingers. The wave is a ring of this radius and width.
struct rg_water {
    int count, spikes;
    struct rg_water_ball balls[RG_WATER_BALLS];
    double foot_m, flare, height_m, turn;
    double ring_m, ring_width_m, ring_height_m;
};

// The directions from which the light of one ray came, unit vectors, and the share of each. The
// rest of the light, so that all shares are 1 with it, comes from behind the water.
struct rg_water_light {
    int count;
    double from[RG_WATER_WAYS][3], share[RG_WATER_WAYS];
};

// The height of the sheet's edge at an angle about the impact.
double rg_water_edge(const struct rg_water *water, double phi);
// What a ray along the unit vector `way` from `start` shows. `ball` is the nearest that it meets,
// or NULL. Light is followed from ball to ball, through three at most; the sheet and the wave are
// seen directly alone.
void rg_water_see(const struct rg_water *water, const struct rg_water_ball *ball,
                  const double start[3], const double way[3], struct rg_water_light *light);

#endif
