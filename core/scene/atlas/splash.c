#include "core/scene/atlas/splash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/optics/drop.h"
#include "kernels/dialect/rng.h"

#define GRAVITY_M_S2 9.81
#define FRAME_S      0.006
#define FOOT_M                                                                                     \
    (RG_SPLASH_FOOT_SHARE * RG_SPLASH_PICTURE_M * RG_SPLASH_HEIGHT_PX / RG_SPLASH_WIDTH_PX)
#define TILT_RAD   (RG_SPLASH_TILT_DEG * M_PI / 180)
#define DIAMETER_M (2 * RG_DROP_RADIUS_M)
#define SPEED_M_S  (RG_DROP_FALL * DIAMETER_M / RG_EXPOSURE_S)
// The slowest waves on water (Lamb, 1932), as which the ring runs on.
#define WAVE_M_S 0.23

// Rays stand on a finer grid, and each texel shows their mean.
enum {
    FINE = 8,
    FINE_WIDTH = FINE * RG_SPLASH_WIDTH_PX,
    FINE_HEIGHT = FINE * RG_SPLASH_HEIGHT_PX,
    RIM_BALLS = 6, // from one finger to the next
    FINGER_BALLS = 6,
    JET_BALLS = 40,
    SEED = 2007,
    PUDDLE = 1 // a material, see atlas.h
};

#define FINE_PER_M (FINE_WIDTH / RG_SPLASH_PICTURE_M)

// The properties in which materials differ.
struct material {
    double film;      // depth of the water film over the drop's diameter
    double widest_m;  // the crown's radius
    double height_m;  // of the crown at its highest
    double life_s;    // of the crown
    double rise;      // the share of its life after which it is highest
    double rim_m;     // radius of the rim
    double flare;     // how far the sheet leans outwards, over its height
    double lift_deg;  // elevation at which water leaves the edge
    double speed_m_s; // mean of the droplets
    double droplet_m; // mean radius of the droplets
    int droplets;
    double jet_m;  // height of the column that rises after the crown has closed
    double ring_m; // height of the outgoing wave
};

// The puddle's width, life, rise and droplets follow what was published (docs/atlas.md,
// tests/core/scene/atlas/crowns.c).
static const struct material materials[RG_ATLAS_MATERIALS] = {
    {.film = 0.3,
     .widest_m = 0.016,
     .height_m = 0.009,
     .life_s = 0.030,
     .rise = 0.5,
     .rim_m = 0.00036,
     .flare = 0.35,
     .lift_deg = 60,
     .speed_m_s = 0.9,
     .droplet_m = 0.00026,
     .droplets = 75,
     .ring_m = 0.00010},
    {.film = 1.5,
     .widest_m = 0.0154,
     .height_m = 0.014,
     .life_s = 0.056,
     .rise = 0.125,
     .rim_m = 0.00045,
     .flare = 0.15,
     .lift_deg = 68,
     .speed_m_s = 0.8,
     .droplet_m = 0.00026,
     .droplets = 73,
     .jet_m = 0.016,
     .ring_m = 0.00025},
    {.film = 0.1,
     .widest_m = 0.011,
     .height_m = 0.002,
     .life_s = 0.012,
     .rise = 0.5,
     .rim_m = 0.00022,
     .flare = 0.6,
     .lift_deg = 35,
     .speed_m_s = 1.0,
     .droplet_m = 0.00020,
     .droplets = 90},
    {.film = 0.1,
     .widest_m = 0.013,
     .height_m = 0.004,
     .life_s = 0.018,
     .rise = 0.5,
     .rim_m = 0.00028,
     .flare = 0.5,
     .lift_deg = 33,
     .speed_m_s = 0.8,
     .droplet_m = 0.00024,
     .droplets = 40},
};

// The puddle of the tables' atlas, chosen by eye. Stored tables hold this atlas' hash.
static const struct material puddle_of_tables = {.film = 1.5,
                                                 .widest_m = 0.013,
                                                 .height_m = 0.014,
                                                 .life_s = 0.050,
                                                 .rise = 0.5,
                                                 .rim_m = 0.00045,
                                                 .flare = 0.15,
                                                 .lift_deg = 68,
                                                 .speed_m_s = 0.8,
                                                 .droplet_m = 0.00030,
                                                 .droplets = 45,
                                                 .jet_m = 0.016,
                                                 .ring_m = 0.00025};

static const struct material *find(enum rg_swings set, int material)
{
    return set == RG_SWINGS_DATABASE && material == PUDDLE ? &puddle_of_tables
                                                           : &materials[material];
}

// --- the model ---

// The radius is Yarin and Weiss's (1995), R = D (2 / (3 h))^(1/4) sqrt(v t / D), slowed when water
// runs out. The edge of the sheet rises and falls back.
static struct rg_splash_crown crown_of(const struct material *m, double time_s)
{
    const double ideal =
        DIAMETER_M * pow(2 / (3 * m->film), 0.25) * sqrt(SPEED_M_S * time_s / DIAMETER_M);
    const double passed = time_s / m->life_s;
    const bool rises = passed < m->rise;
    const double half =
        rises ? 0.5 * passed / m->rise : 0.5 + 0.5 * (passed - m->rise) / (1 - m->rise);
    const double up = half < 1 ? 4 * half * (1 - half) : 0;
    return (struct rg_splash_crown){
        .radius_m = m->widest_m * tanh(ideal / m->widest_m),
        .height_m = m->height_m * sqrt(up) * (rises ? 1 : sqrt(up)),
    };
}

struct rg_splash_crown rg_splash_crown(enum rg_swings set, int material, double time_s)
{
    return crown_of(find(set, material), time_s);
}

// Fingers stand as far apart as a rim of this radius breaks up by itself, 9.02 radii (Rayleigh;
// Zhang et al., 2010), when the crown is half as wide as it gets.
static int fingers_of(const struct material *m)
{
    return (int)(2 * M_PI * 0.5 * m->widest_m / (9.02 * m->rim_m));
}

// The random numbers of one droplet or finger.
struct chance {
    double a, b, c, d;
};

static struct chance chance_of(int material, int item, int stream)
{
    const rg_uint4 bits = rg_random(SEED, (uint)item, (uint)material, (uint)stream);
    return (struct chance){(double)rg_uniform(bits.x), (double)rg_uniform(bits.y),
                           (double)rg_uniform(bits.z), (double)rg_uniform(bits.w)};
}

// Adds a ball at a distance from the impact, an angle about it and a height.
static void add_ball(struct rg_water *water, double away, double phi, double up, double radius_m)
{
    const double right = away * cos(phi), ahead = away * sin(phi);
    if (water->count < RG_WATER_BALLS && up >= 0 && radius_m > 1e-5)
        water->balls[water->count++] = (struct rg_water_ball){{right, up, ahead}, radius_m};
}

// Adds the rim of the sheet, and the fingers that stand on it, thinner towards their beads.
static void add_rim(struct rg_water *w, const struct material *m, int material, double passed)
{
    for (int k = 0; k < w->spikes && w->height_m > 3 * m->rim_m; k++) {
        const struct chance chance = chance_of(material, k, 0);
        const double middle = (2 * M_PI * k - w->turn) / w->spikes;
        const double phi = middle + 0.1 * (chance.a - 0.5), lift = m->lift_deg * M_PI / 180;
        const double length = w->height_m * (0.15 + 0.4 * chance.b) * (1 - passed);
        for (int i = 1; i < RIM_BALLS; i++) {
            const double angle = middle + 2 * M_PI / w->spikes * i / RIM_BALLS;
            const double edge = rg_water_edge(w, angle);
            add_ball(w, w->foot_m + w->flare * edge, angle, edge, m->rim_m);
        }
        for (int i = 0; i < FINGER_BALLS; i++) {
            const double s = (double)i / (FINGER_BALLS - 1), out = length * s * cos(lift);
            const double wide = i == FINGER_BALLS - 1 ? 1.4 : 1.1 - 0.5 * s;
            add_ball(w, w->foot_m + w->flare * w->height_m + out, phi,
                     w->height_m + length * s * sin(lift), m->rim_m * wide);
        }
    }
}

// Adds droplets that leave the edge one by one while the sheet rises, and fly on parabolas. Their
// sizes are nearly log-normal (Stow and Stainer, 1977): the sum of uniforms is nearly normal.
static void add_droplets(struct rg_water *w, const struct material *m, int material, double time_s)
{
    for (int k = 0; k < m->droplets; k++) {
        const struct chance when = chance_of(material, k, 1), how = chance_of(material, k, 2);
        const double leaves = m->life_s * 2 * m->rise * (0.03 + 0.6 * when.a),
                     flown = time_s - leaves;
        if (flown <= 0)
            continue;
        const struct rg_splash_crown crown = crown_of(m, leaves);
        const double lift = (m->lift_deg + 24 * (when.c - 0.5)) * M_PI / 180;
        const double speed = m->speed_m_s * (0.4 + 1.2 * how.a);
        add_ball(w, crown.radius_m + m->flare * crown.height_m + speed * cos(lift) * flown,
                 2 * M_PI * when.b,
                 crown.height_m + speed * sin(lift) * flown - 0.5 * GRAVITY_M_S2 * flown * flown,
                 m->droplet_m * exp(0.9 * (when.d + how.b + how.c - 1.5)));
    }
}

// Adds the column of water that a closing crater throws up in deep water, and the bead on its top.
static void add_jet(struct rg_water *w, const struct material *m, double time_s)
{
    const double passed = (time_s - m->life_s) / 0.06;
    if (passed <= 0 || passed >= 1 || m->jet_m <= 0)
        return;
    const double height = m->jet_m * 4 * passed * (1 - passed);
    for (int i = 0; i < JET_BALLS; i++) {
        const double s = (i + 0.5) / JET_BALLS;
        add_ball(w, 0, 0, height * s, 0.0006 + 0.0015 * pow(1 - s, 3));
    }
    add_ball(w, 0, 0, height, 0.0013 * sqrt(1 - passed));
}

void rg_splash_water(enum rg_swings set, int material, double time_s, struct rg_water *water)
{
    const struct material *m = find(set, material);
    const struct rg_splash_crown crown = crown_of(m, time_s);
    memset(water, 0, sizeof(*water));
    water->foot_m = crown.radius_m;
    water->flare = m->flare;
    water->height_m = crown.height_m;
    water->spikes = fingers_of(m);
    water->turn = 2 * M_PI * chance_of(material, 0, 3).a;
    water->ring_m = crown.radius_m + WAVE_M_S * fmax(time_s - 0.5 * m->life_s, 0);
    water->ring_width_m = 0.0015 + 0.012 * time_s;
    water->ring_height_m = m->ring_m * exp(-time_s / 0.035);
    add_rim(water, m, material, fmin(time_s / m->life_s, 1));
    add_droplets(water, m, material, time_s);
    add_jet(water, m, time_s);
}

double rg_splash_frame(enum rg_swings set, int material, int frame, struct rg_water *water)
{
    const double time_s = (frame + 0.5) * FRAME_S;
    // It fades out over the last third of the animation.
    const double last = (time_s / (RG_ATLAS_FRAMES * FRAME_S) - 0.65) / 0.35;
    rg_splash_water(set, material, time_s, water);
    return last > 0 ? 1 - last * last * (3 - 2 * last) : 1;
}

// --- drawing ---

// The ball that is met first at each point of the fine grid, from 1 on, and where.
struct nearest {
    uint16_t ball[FINE_HEIGHT * FINE_WIDTH];
    float far[FINE_HEIGHT * FINE_WIDTH];
};

// A point of the fine grid, on a plane through the impact, as the viewer sees it.
static void grid_point(int column, int row, double at[3])
{
    const double up = (FINE_HEIGHT - row - 0.5) / FINE_PER_M - FOOT_M;
    at[0] = (column + 0.5) / FINE_PER_M - 0.5 * RG_SPLASH_PICTURE_M;
    at[1] = up * cos(TILT_RAD);
    at[2] = up * sin(TILT_RAD);
}

// A ball's circle on the fine grid, and its distance along the view.
struct circle {
    double x, y, radius, far;
};

static struct circle circle_of(const struct rg_water_ball *b)
{
    const double up = b->at[1] * cos(TILT_RAD) + b->at[2] * sin(TILT_RAD);
    return (struct circle){(0.5 * RG_SPLASH_PICTURE_M + b->at[0]) * FINE_PER_M,
                           FINE_HEIGHT - (FOOT_M + up) * FINE_PER_M, b->radius_m * FINE_PER_M,
                           (b->at[2] * cos(TILT_RAD) - b->at[1] * sin(TILT_RAD)) * FINE_PER_M};
}

static void cover(const struct circle *c, int ball, struct nearest *nearest)
{
    const int from_y = (int)fmax(c->y - c->radius, 0), from_x = (int)fmax(c->x - c->radius, 0);
    for (int y = from_y; y < FINE_HEIGHT && y < c->y + c->radius; y++) {
        for (int x = from_x; x < FINE_WIDTH && x < c->x + c->radius; x++) {
            const double dx = x + 0.5 - c->x, dy = y + 0.5 - c->y;
            const double inner = c->radius * c->radius - dx * dx - dy * dy;
            const float far = (float)(c->far - sqrt(fmax(inner, 0)));
            const int i = y * FINE_WIDTH + x;
            if (inner > 0 && (!nearest->ball[i] || far < nearest->far[i])) {
                nearest->ball[i] = (uint16_t)(ball + 1);
                nearest->far[i] = far;
            }
        }
    }
}

static void add_light(struct rg_splash_light *light, const double from[3], double share)
{
    const double steps = 9 / M_PI;
    const int height = (int)(asin(fmin(from[1], 1)) * steps + 5);
    const int phi = (int)(atan2(fabs(from[0]), -from[2]) * steps);
    light->cells[height][phi < RG_ATLAS_PHIS ? phi : RG_ATLAS_PHIS - 1] += share;
}

// The share of a ray's light that comes from above the horizon.
static double see(const struct rg_water *water, const struct nearest *nearest, int column, int row,
                  struct rg_splash_light *light)
{
    const double way[3] = {0, -sin(TILT_RAD), cos(TILT_RAD)};
    const int ball = nearest->ball[row * FINE_WIDTH + column];
    struct rg_water_light seen;
    double at[3], sum = 0;
    grid_point(column, row, at);
    rg_water_see(water, ball ? &water->balls[ball - 1] : NULL, at, way, &seen);
    for (int i = 0; i < seen.count; i++) {
        if (seen.from[i][1] <= 0)
            continue;
        sum += seen.share[i];
        if (light)
            add_light(light, seen.from[i], seen.share[i]);
    }
    return sum;
}

bool rg_splash_see(const struct rg_water *water,
                   float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX],
                   struct rg_splash_light *light)
{
    struct nearest *nearest = rg_alloc(1, sizeof(*nearest), "splash");
    if (!nearest)
        return false;
    for (int i = 0; i < water->count; i++) {
        const struct circle circle = circle_of(&water->balls[i]);
        cover(&circle, i, nearest);
    }
    memset(texels, 0, RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX * sizeof(*texels));
    for (int r = 0; r < FINE_HEIGHT; r++)
        for (int c = 0; c < FINE_WIDTH; c++)
            texels[r / FINE * RG_SPLASH_WIDTH_PX + c / FINE] +=
                (float)(see(water, nearest, c, r, light) / (FINE * FINE));
    free(nearest);
    return true;
}

bool rg_splash_draw(enum rg_swings set, int material, int frame,
                    float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX],
                    struct rg_splash_light *light)
{
    struct rg_water water;
    const double shown = rg_splash_frame(set, material, frame, &water);
    const bool drawn = rg_splash_see(&water, texels, light);
    for (int i = 0; drawn && i < RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX; i++)
        texels[i] *= (float)shown;
    return drawn;
}

void rg_splash_parts(const struct rg_splash_light *light,
                     float parts[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS])
{
    double sum = 0;
    for (int i = 0; i < RG_ATLAS_CELLS; i++)
        sum += (&light->cells[0][0])[i];
    for (int height = 0; height < RG_ATLAS_LIGHTS; height++) {
        const double low = fmax(20 * height - 100, -90) * M_PI / 180;
        const double high = fmin(20 * height - 80, 90) * M_PI / 180;
        // to either side
        const double cell_sr = 2 * M_PI / RG_ATLAS_PHIS * (sin(high) - sin(low));
        for (int phi = 0; phi < RG_ATLAS_PHIS; phi++)
            parts[height][phi] = sum > 0 ? (float)(light->cells[height][phi] / (sum * cell_sr)) : 0;
    }
}
