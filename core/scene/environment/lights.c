// Lights as discs, each with its streak on the wet ground.
#include <math.h>

#include "core/scene/environment/cube.h"
#include "core/scene/environment/parts.h"
#include "core/scene/vector.h"

struct light {
    double at[3]; // in the street
    double radius_m;
    double colour[3];
};

// Texels of a face, borders included; none where last_y is above `top`.
struct patch {
    int left, top, last_x, last_y;
};
static const struct patch none = {0, 0, -1, -1};

// A disc, or a streak, as it is drawn around the eye.
struct splat {
    double to[3];        // its middle's direction in the world, of unit length
    double across, down; // a disc's radius, the widths of a streak: angles
    double colour[3];
    bool streak;
    struct patch on[6];
};

enum { MOST_SPLATS = 160 };

struct splats {
    int size; // of the environment
    int count;
    struct splat all[MOST_SPLATS];
};

// --- drawing ---

// The splat's weight in a direction of unit length.
static double weight_of(const struct splat *s, const double d[3], double texel)
{
    const double x = d[0] - s->to[0], y = d[1] - s->to[1], z = d[2] - s->to[2];
    const double out2 = x * x + z * z;
    if (!s->streak)
        return street_clamp((s->across - sqrt(out2 + y * y)) / texel + .5);
    const double a = 1 + out2 / (s->across * s->across), b = 1 + y * y / (s->down * s->down);
    const double fade = street_clamp((d[1] + .577) * 5) * street_clamp(-d[1] * 40);
    return street_mirrored(-d[1]) * fade / (a * a * b * b);
}

static void add_texel(struct rg_environment *environment, const struct splat *s, int face, int x,
                      int y)
{
    double d[3];
    rg_cube_direction(face, x, y, environment->size, d);
    const double scale = 1 / sqrt(rg_dot(d, d));
    for (int i = 0; i < 3; i++)
        d[i] *= scale;
    const double weight = weight_of(s, d, 2.0 / environment->size * scale);
    float *texel = rg_environment_texel(environment, face, x, y);
    for (int i = 0; i < 3; i++)
        texel[i] = (float)((double)texel[i] + weight * s->colour[i]);
}

// Each texel gets the lights in their order, whichever thread draws it.
static void draw(const struct splats *splats, struct rg_environment *environment)
{
#pragma omp parallel for collapse(2) schedule(dynamic, 8)
    for (int face = 0; face < 6; face++) {
        for (int y = -1; y <= splats->size; y++) {
            for (int i = 0; i < splats->count; i++) {
                const struct patch *on = &splats->all[i].on[face];
                for (int x = on->left; y >= on->top && y <= on->last_y && x <= on->last_x; x++)
                    add_texel(environment, &splats->all[i], face, x, y);
            }
        }
    }
}

// --- placing ---

// The texel, borders included, at a place along a face, which is -1 to 1.
static int texel_at(double place, int size)
{
    return (int)(street_clamp((place + 1) / 2) * (size + 1)) - 1;
}

static struct patch patch_of(const struct splat *s, int face, int size)
{
    double corner[3], right[3], below[3]; // of the face: its middle and two sides
    rg_cube_direction(face, 0, 0, 1, corner);
    rg_cube_direction(face, 1, 0, 1, right);
    rg_cube_direction(face, 0, 1, 1, below);
    double u = 0, v = 0;
    const double ahead = rg_dot(corner, s->to);
    for (int i = 0; i < 3; i++) {
        u += (right[i] - corner[i]) / 2 * s->to[i];
        v += (below[i] - corner[i]) / 2 * s->to[i];
    }
    if (ahead < .3)
        return none;
    u /= ahead;
    v /= ahead;
    const double grown = 1.3 * (1 + u * u + v * v), many = s->streak ? 5 : 1;
    const double texel = 2.0 / size;
    const double du = grown * (many * s->across + texel),
                 dv = grown * (s->down * (s->streak ? 3 : 1) + texel);
    if (u - du > 1 || u + du < -1 || v - dv > 1 || v + dv < -1)
        return none;
    return (struct patch){texel_at(u - du, size), texel_at(v - dv, size), texel_at(u + du, size),
                          texel_at(v + dv, size)};
}

// Adds a light seen `up_m` above the eye.
static void add_splat(struct splats *splats, const struct light *light, double up_m, bool streak)
{
    const double place[3] = {light->at[0], up_m, light->at[2]};
    const double way_m = sqrt(rg_dot(place, place));
    const double texel = 2.0 / splats->size, radius = light->radius_m / way_m;
    const double least = streak ? 1.5 * texel : .75 * texel;
    struct splat s = {.streak = streak};
    street_turn(place, s.to);
    for (int i = 0; i < 3; i++)
        s.to[i] /= way_m;
    s.across = streak ? radius * 1.5 : radius;
    s.across = s.across < least ? least : s.across;
    s.down = streak ? .05 + 1.2 * radius : s.across;
    // The light of the whole disc, which a small one keeps.
    const double area = streak ? .8 * s.across * s.down : s.across * s.across;
    for (int i = 0; i < 3; i++)
        s.colour[i] = light->colour[i] * radius * radius / area;
    if (streak && s.to[1] < -.55)
        return;
    for (int face = 0; face < 6; face++) // streaks are neither above nor right below
        s.on[face] = streak && face / 2 == 1 ? none : patch_of(&s, face, splats->size);
    splats->all[splats->count++] = s;
}

// Adds a light and, as far below the ground, its streak.
static void add(struct splats *splats, const struct light *light)
{
    add_splat(splats, light, light->at[1] - EYE_M, false);
    add_splat(splats, light, -light->at[1] - EYE_M, true);
}

// --- the lights ---

static void add_pair(struct splats *splats, const struct light *light, double apart_m)
{
    struct light one = *light;
    for (int side = -1; side <= 1; side += 2) {
        one.at[0] = light->at[0] + side * apart_m;
        add(splats, &one);
    }
}

static void add_lamps(struct splats *splats)
{
    for (int side = 0; side < 2; side++)
        for (int lamp = -6; lamp < 7; lamp++)
            add(splats, &(struct light){{side ? LAMP_X_M : -LAMP_X_M, LAMP_Y_M,
                                         (lamp + (side ? 0 : .5)) * LAMP_GAP_M},
                                        .2,
                                        {46, 27, 10.5}});
}

// Cars that drive: white where they come, on the left ahead and on the right behind; else red.
static void add_cars(const struct street_look *look, struct splats *splats)
{
    static const double come_m[] = {19, 33, 47, 76, 104}, go_m[] = {12, 26, 38, 61, 90};
    const double gain = look->time == STREET_NIGHT ? 1 : .4;
    for (int i = 0; i < 5; i++)
        for (int ahead = -1; ahead <= 1; ahead += 2) {
            add_pair(splats,
                     &(struct light){{-2.2 * ahead, .68, ahead * come_m[i]},
                                     .11,
                                     {60 * gain, 55 * gain, 46 * gain}},
                     .62);
            add_pair(splats,
                     &(struct light){{2.2 * ahead, .8, ahead * go_m[i]},
                                     .09,
                                     {26 * gain, 1.3 * gain, .7 * gain}},
                     .66);
        }
}

static void add_signals(const struct street_look *look, struct splats *splats)
{
    static const double colours[3][3] = {{1.2, 15, 7.5}, {24, 2, 1.2}, {22, 10, .8}};
    static const double far_m[4] = {29, 66, -24, -58};
    const double gain = look->time == STREET_NIGHT ? 1 : .6;
    for (int i = 0; i < 4; i++)
        for (int side = -1; side <= 1; side++) {
            const double *c = colours[i % 3];
            add(splats, &(struct light){{5.2 * side, side ? 3.1 : 5.4, far_m[i]},
                                        .13,
                                        {c[0] * gain, c[1] * gain, c[2] * gain}});
        }
}

void street_add_lights(const struct street_look *look, struct rg_environment *environment)
{
    struct splats splats = {.size = environment->size};
    if (look->time == STREET_NIGHT)
        add_lamps(&splats);
    add_cars(look, &splats);
    add_signals(look, &splats);
    draw(&splats, environment);
}
