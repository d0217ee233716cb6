#include "core/scene/environment/street.h"

#include <math.h>

#include "core/scene/environment/cube.h"
#include "core/scene/environment/parts.h"
#include "core/scene/vector.h"

#define END_M  150.0 // where the street meets another
#define LEFT_M 300.0 // from where walls along that other street are counted
#define BACK_M 34.0  // from the middle to the towers behind the houses
#define CARS_M 4.3   // to the sides of parked cars that look at the roadway
#define SLOT_M 6.4   // of a parked car

// A ray of unit length from the eye at this height; below 0: the eye mirrored in the ground.
struct street_ray {
    double x, y, z;
    double eye_m;
    double texel; // angle of a texel, in radians
};

static const struct street_look street_looks[2] = {
    [STREET_DAY] = {.time = STREET_DAY,
                    .zenith = {.50, .57, .66},
                    .horizon = {.92, .93, .92},
                    .cloud = {1.15, 1.12, 1.06},
                    .sky = .9,
                    .windows = .55,
                    .lit = .12,
                    .haze_m = 260},
    [STREET_NIGHT] = {.time = STREET_NIGHT,
                      .zenith = {.010, .020, .055},
                      .horizon = {.10, .075, .075},
                      .cloud = {.075, .055, .055},
                      .sky = .35,
                      .lamps = 1,
                      .windows = 1.25,
                      .lit = .38,
                      .haze_m = 420},
};

// --- the sky ---

static void sky(const struct street_look *look, const struct street_ray *ray, double light[3])
{
    const double up = ray->y > 0 ? ray->y : 0, flat = 1 / (up + .12);
    const double cloud =
        street_smooth(2.2 * street_clouds(ray->x * flat * .9, ray->z * flat * .9 + 5, 41) - .6);
    const double low = 1 / (1 + 9 * up * up + 2.5 * up);
    for (int i = 0; i < 3; i++) {
        const double clear = look->zenith[i] + (look->horizon[i] - look->zenith[i]) * low;
        light[i] = clear + (look->cloud[i] - clear) * cloud * (.35 + .3 * low);
    }
    if (look->time == STREET_NIGHT)
        return;
    // The sun behind clouds, ahead on the right.
    const double toward = .42 * ray->x + .50 * ray->y + .757 * ray->z;
    const double near = toward > 0 ? toward * toward : 0, near4 = near * near;
    const double near16 = near4 * near4 * near4 * near4;
    for (int i = 0; i < 3; i++)
        light[i] *= 1 + near16 * (.6 + .8 * (1 - cloud)) + 9 * near16 * near16 * near16 * near16;
}

// --- houses and cars ---

enum { PAINTS = 6 };
static const double paints[PAINTS][3] = {{.03, .03, .035}, {.34, .35, .36}, {.58, .58, .56},
                                         {.28, .03, .025}, {.04, .09, .2},  {.16, .17, .16}};

// A parked car as seen from the roadway: its height at a place, and its light.
static bool car(const struct street_look *look, int side, double along_m, double up_m,
                double light[3])
{
    const int slot = street_floor(along_m / SLOT_M);
    if (up_m < 0 || street_chance(slot, side, 51) < .35) // a mirrored eye is below the ground
        return false;
    const double at = along_m - SLOT_M * slot - .9; // from its end
    const bool body = at > 0 && at < 4.3 && up_m < .95 - .02 * (at - 2.1) * (at - 2.1);
    const bool cabin = at > .7 + .5 * (up_m - .9) && at < 3.6 - .9 * (up_m - .9) && up_m < 1.45;
    if (!body && !cabin)
        return false;
    const double *paint = paints[street_floor(street_chance(slot, side, 52) * PAINTS)];
    const double x_m = side ? CARS_M : -CARS_M;
    const double lamps = street_lamplight(look, x_m, up_m, along_m);
    for (int i = 0; i < 3; i++) {
        const double sky_light = look->sky * (.2 + .6 * up_m) * look->horizon[i];
        const double glass = (sky_light + .25 * lamps * street_lamp[i]) * .12;
        light[i] = body ? paint[i] * (sky_light + lamps * street_lamp[i]) : glass;
    }
    return true;
}

static void add_haze(const struct street_look *look, double way_m, double light[3])
{
    const double share = way_m / (way_m + look->haze_m);
    for (int i = 0; i < 3; i++)
        light[i] += (look->horizon[i] * .8 - light[i]) * share * share;
}

// Where a ray may meet a wall, which looks as those of one row and is as high as those of another.
struct meeting {
    int row, high_as;
    double along_m, way_m, facing;
};

// The light of a wall; false where the ray passes above it.
static bool wall(const struct street_look *look, const struct street_ray *ray,
                 const struct meeting *m, double light[3])
{
    const double up_m = ray->eye_m + ray->y * m->way_m;
    if (up_m >= street_height(m->high_as, m->along_m))
        return false;
    const double width_m = m->way_m * ray->texel / (m->facing < .05 ? .05 : m->facing);
    street_front(look, &(struct street_wall){m->row, ray->x * m->way_m, m->along_m, up_m, width_m},
                 light);
    add_haze(look, m->way_m, light);
    return true;
}

// The way along a ray for each metre across the street.
static double way_per_m(const struct street_ray *ray)
{
    const double across = ray->x > 0 ? ray->x : -ray->x;
    return across > 1e-6 ? 1 / across : 1e6;
}

// The light of a parked car that the ray meets before `end_m`; false where it meets none.
static bool car_before(const struct street_look *look, const struct street_ray *ray, double end_m,
                       double light[3])
{
    const double way_m = CARS_M * way_per_m(ray);
    if (way_m >= end_m ||
        !car(look, ray->x > 0, ray->z * way_m, ray->eye_m + ray->y * way_m, light))
        return false;
    add_haze(look, way_m, light);
    return true;
}

static void above_ground(const struct street_look *look, const struct street_ray *ray,
                         double light[3])
{
    const int side = ray->x > 0;
    const double across = side ? ray->x : -ray->x, along = ray->z > 0 ? ray->z : -ray->z;
    const double end_m = along > 1e-6 ? END_M / along : 1e9;
    const double front_m = FRONT_M * way_per_m(ray), back_m = BACK_M * way_per_m(ray);
    const struct meeting front = {side, side, ray->z * front_m, front_m, across};
    const struct meeting back = {2 + side, 2 + side, ray->z * back_m, back_m, across};
    const struct meeting end = {3, ray->z > 0, ray->x * end_m + LEFT_M, end_m, along};
    if (!car_before(look, ray, end_m, light) &&
        !(front_m < end_m && wall(look, ray, &front, light)) &&
        !(back_m < end_m && wall(look, ray, &back, light)) &&
        !(end_m < back_m && wall(look, ray, &end, light)))
        sky(look, ray, light);
}

// --- the ground ---

// What share of the light that falls on it comes back from asphalt with lines.
static double road_tint(double x_m, double z_m, double width_m)
{
    const double grain = width_m < .3 ? .7 + .6 * street_noise(x_m * 6, z_m * 6, 61) : 1;
    const double line = street_stripes((x_m + .07) / 20, .007, width_m / 20) *
                        street_stripes(z_m / 6, .5, width_m / 6);
    return .075 * grain + .5 * line;
}

// From slabs behind the kerb, `out_m` from it.
static double pavement_tint(double out_m, double x_m, double z_m, double width_m)
{
    const double joints = 1 - .35 * street_stripes(x_m / 1.2, .03, width_m / 1.2) -
                          .35 * street_stripes(z_m / .9, .04, width_m / .9);
    const double stain = .8 + .4 * street_noise(x_m * .9, z_m * .9, 62);
    return .17 * stain * joints + .12 * street_clamp((.22 - out_m) / width_m + .5);
}

static double ground_tint(double x_m, double z_m, double width_m)
{
    const double out_m = (x_m < 0 ? -x_m : x_m) - KERB_M;
    const double share = street_clamp(out_m / width_m + .5);
    const double road = share < 1 ? (1 - share) * road_tint(x_m, z_m, width_m) : 0;
    return share > 0 ? road + share * pavement_tint(out_m, x_m, z_m, width_m) : road;
}

static void ground(const struct street_look *look, const struct street_ray *ray, double light[3])
{
    const double down = -ray->y, way_m = EYE_M / down;
    const double x_m = ray->x * way_m, z_m = ray->z * way_m;
    const double width_m = way_m * ray->texel / (down < .04 ? .04 : down);
    const double tint = ground_tint(x_m, z_m, width_m);
    const double lamps = street_lamplight(look, x_m, 0, z_m);
    const double wet = street_smooth(2.2 * street_noise(x_m * .45, z_m * .3, 71) - .6);
    const double rough = (street_noise(x_m * 7, z_m * 3, 72) - .5) * (.34 - .26 * wet);
    struct street_ray mirrored = *ray;
    mirrored.eye_m = -EYE_M;
    mirrored.y = down + rough * (down < .3 ? down * (.4 + 2 * down) : .3);
    mirrored.texel = ray->texel * (6 - 4 * wet);
    double above[3];
    above_ground(look, &mirrored, above);
    const double share = street_mirrored(down) * (.3 + .7 * wet);
    for (int i = 0; i < 3; i++) {
        const double fallen = look->sky * (.6 * look->zenith[i] + .4 * look->horizon[i]);
        const double own = tint * (1 - .35 * wet) * (fallen + lamps * street_lamp[i]);
        light[i] = own * (1 - share) + above[i] * share;
    }
    add_haze(look, way_m, light);
}

// --- all of it ---

struct seen {
    const struct street_look *look;
    double texel;
};

static void seen_along(const double d[3], const void *user, double light[3])
{
    const struct seen *seen = user;
    const double scale = 1 / sqrt(rg_dot(d, d));
    double s[3];
    street_turn(d, s);
    const struct street_ray ray = {s[0] * scale, s[1] * scale, s[2] * scale, EYE_M,
                                   seen->texel * scale};
    const double ground_m = ray.y < 0 ? EYE_M / -ray.y : 1e9;
    if (ground_m >= FRONT_M * way_per_m(&ray) || ground_m >= END_M)
        above_ground(seen->look, &ray, light);
    else if (!car_before(seen->look, &ray, ground_m, light)) // only cars hide the ground
        ground(seen->look, &ray, light);
}

struct rg_environment *rg_street(enum street_time time, int size)
{
    struct rg_environment *environment = rg_environment_create(size);
    if (!environment)
        return NULL;
    const struct seen seen = {&street_looks[time], 2.0 / size};
    rg_environment_fill(environment, seen_along, &seen);
    street_add_lights(seen.look, environment);
    return environment;
}
