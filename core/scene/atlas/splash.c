#include "core/scene/atlas/splash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/optics/drop.h"
#include "kernels/dialect/rng.h"

#define GRAVITY_M_S2  9.81
#define FRAME_S       0.006
#define PICTURE_M     0.06 // across
#define FOOT_M        (RG_SPLASH_FOOT_SHARE * PICTURE_M * RG_SPLASH_HEIGHT_PX / RG_SPLASH_WIDTH_PX)
#define TILT_RAD      (15 * M_PI / 180)
#define DIAMETER_M    (2 * RG_DROP_RADIUS_M)
#define SPEED_M_S     (RG_DROP_FALL * DIAMETER_M / RG_EXPOSURE_S)
#define OPACITY_PER_M 800.0 // optical depth of a metre of splashed water: sheets are translucent

// The picture is drawn on a finer grid, as optical depth, and averaged at the end.
enum {
    FINE = 4,
    FINE_WIDTH = FINE * RG_SPLASH_WIDTH_PX,
    FINE_HEIGHT = FINE * RG_SPLASH_HEIGHT_PX,
    AROUND = 720,
    UP = 80,
    SEED = 2007
};

#define FINE_PER_M (FINE_WIDTH / PICTURE_M)

// The properties in which materials differ.
struct material {
    double film;        // depth of the water film over the drop's diameter
    double height_m;    // of the crown at its highest
    double life_s;      // of the crown
    double thickness_m; // of the sheet of water when it rises
    double flare;       // ratio of the sheet's width at its edge to that at its foot
    double lift_deg;    // elevation at which water leaves the edge
    double speed_m_s;   // mean of the droplets
    double droplet_m;   // mean radius of the droplets
    int droplets, spikes;
    double jet_m;  // height of the column that rises after the crown has closed
    double ring_m; // height of the outgoing wave
};

static const struct material materials[RG_ATLAS_MATERIALS] = {
    {.film = 0.3,
     .height_m = 0.013,
     .life_s = 0.060,
     .thickness_m = 0.00034,
     .flare = 0.22,
     .lift_deg = 66,
     .speed_m_s = 0.62,
     .droplet_m = 0.00042,
     .droplets = 34,
     .spikes = 22,
     .jet_m = 0.004,
     .ring_m = 0.0003},
    {.film = 1.5,
     .height_m = 0.017,
     .life_s = 0.075,
     .thickness_m = 0.00065,
     .flare = 0.12,
     .lift_deg = 72,
     .speed_m_s = 0.66,
     .droplet_m = 0.00062,
     .droplets = 13,
     .spikes = 13,
     .jet_m = 0.020,
     .ring_m = 0.0008},
    {.film = 0.1,
     .height_m = 0.0025,
     .life_s = 0.022,
     .thickness_m = 0.00022,
     .flare = 0.3,
     .lift_deg = 40,
     .speed_m_s = 0.58,
     .droplet_m = 0.00033,
     .droplets = 58,
     .spikes = 31,
     .jet_m = 0,
     .ring_m = 0.00012},
    {.film = 0.1,
     .height_m = 0.0055,
     .life_s = 0.034,
     .thickness_m = 0.00026,
     .flare = 0.2,
     .lift_deg = 33,
     .speed_m_s = 0.52,
     .droplet_m = 0.00045,
     .droplets = 20,
     .spikes = 18,
     .jet_m = 0,
     .ring_m = 0.0003},
};

// --- the model ---

// The radius is Yarin and Weiss's (1995), R = D (2 / (3 h))^(1/4) sqrt(v t / D), slowed when water
// runs out. The edge of the sheet rises and falls back.
struct rg_splash_crown rg_splash_crown(int material, double time_s)
{
    const struct material *m = &materials[material];
    const double ideal =
        DIAMETER_M * pow(2 / (3 * m->film), 0.25) * sqrt(SPEED_M_S * time_s / DIAMETER_M);
    const double widest = 0.42 * PICTURE_M;
    const double passed = time_s / m->life_s;
    const double up = passed < 1 ? 4 * passed * (1 - passed) : 0;
    return (struct rg_splash_crown){
        .radius_m = widest * tanh(ideal / widest),
        .height_m = m->height_m * sqrt(up) * (passed < 0.5 ? 1 : sqrt(up)),
        .thickness_m = passed < 1 ? m->thickness_m * (1 - 0.7 * passed) : 0,
    };
}

// The random numbers of one droplet or spike.
struct chance {
    double a, b, c, d;
};

static struct chance chance_of(int material, int item, int stream)
{
    const rg_uint4 bits = rg_random(SEED, (uint)item, (uint)material, (uint)stream);
    return (struct chance){(double)rg_uniform(bits.x), (double)rg_uniform(bits.y),
                           (double)rg_uniform(bits.z), (double)rg_uniform(bits.w)};
}

// --- drawing ---

// Projects a point, x metres to the right, y up and z towards the back, onto the fine grid.
static void project(double x, double y, double z, double *column, double *row)
{
    *column = (0.5 * PICTURE_M + x) * FINE_PER_M;
    *row = FINE_HEIGHT - (FOOT_M + y * cos(TILT_RAD) + z * sin(TILT_RAD)) * FINE_PER_M;
}

// Adds a volume of water, spread over the four nearest grid points.
static void add_volume(float *depth, double column, double row, double volume_m3)
{
    const double depth_here = volume_m3 * FINE_PER_M * FINE_PER_M * OPACITY_PER_M;
    const double c = column - 0.5, r = row - 0.5;
    const int c0 = (int)floor(c), r0 = (int)floor(r);
    for (int k = 0; k < 4; k++) {
        const int cc = c0 + k % 2, rr = r0 + k / 2;
        const double share = (1 - fabs(c - cc)) * (1 - fabs(r - rr));
        if (cc >= 0 && cc < FINE_WIDTH && rr >= 0 && rr < FINE_HEIGHT)
            depth[rr * FINE_WIDTH + cc] += (float)(share * depth_here);
    }
}

// Adds a volume of water as a ball, or as a slice of a round column of that radius. Anything
// smaller than a grid point gets a point's width.
static void add_ball(float *depth, double x, double y, double z, double radius_m, double volume_m3)
{
    double column, row;
    project(x, y, z, &column, &row);
    const double radius = radius_m * FINE_PER_M, squared = radius * radius + 0.3;
    const int reach = (int)ceil(radius);
    double weights = 0;
    for (int j = -reach; j <= reach; j++)
        for (int i = -reach; i <= reach; i++)
            weights += sqrt(fmax(0, 1 - (i * i + j * j) / squared));
    for (int j = -reach; j <= reach; j++) {
        for (int i = -reach; i <= reach; i++) {
            const double weight = sqrt(fmax(0, 1 - (i * i + j * j) / squared));
            if (weight > 0)
                add_volume(depth, column + i, row + j, volume_m3 * weight / weights);
        }
    }
}

static double ball_m3(double radius_m)
{
    return 4.0 / 3 * M_PI * radius_m * radius_m * radius_m;
}

// Adds the sheet; its edge is scalloped between the spikes and leans outwards.
static void add_sheet(float *depth, const struct material *m, const struct rg_splash_crown *crown,
                      double turn)
{
    if (crown->height_m < 1e-4)
        return;
    for (int a = 0; a < AROUND; a++) {
        const double phi = 2 * M_PI * a / AROUND;
        const double edge = 0.87 + 0.13 * cos(m->spikes * phi + turn);
        const double slant = crown->height_m * edge;
        for (int u = 0; u < UP; u++) {
            const double s = (u + 0.5) / UP;
            const double r = crown->radius_m * (1 + m->flare * s * s);
            const double area = r * 2 * M_PI / AROUND * slant / UP;
            // water gathers in the rim
            const double thickness = crown->thickness_m * (s > 0.93 ? 3.5 : 1);
            double column, row;
            project(r * cos(phi), slant * s, r * sin(phi), &column, &row);
            add_volume(depth, column, row, area * thickness);
        }
    }
}

// Adds fingers that stand on the edge of the sheet, thinner and beaded towards their tips.
static void add_spikes(float *depth, const struct material *m, int material,
                       const struct rg_splash_crown *crown, double turn, double passed)
{
    for (int k = 0; k < m->spikes && crown->height_m > 1e-3; k++) {
        const struct chance chance = chance_of(material, k, 0);
        const double phi = (2 * M_PI * k - turn) / m->spikes + 0.15 * (chance.a - 0.5);
        const double length = crown->height_m * (0.15 + 0.4 * chance.b) * (1 - passed);
        const double lift = m->lift_deg * M_PI / 180, r = crown->radius_m * (1 + m->flare);
        for (int i = 0; i < 12; i++) {
            const double s = i / 11.0, out = r + length * s * cos(lift);
            const double radius = m->droplet_m * (0.75 - 0.45 * s + (i == 11 ? 0.5 : 0));
            add_ball(depth, out * cos(phi), crown->height_m + length * s * sin(lift),
                     out * sin(phi), radius, ball_m3(radius));
        }
    }
}

// Adds droplets that leave the edge one by one while the sheet rises, and fly on parabolas.
static void add_droplets(float *depth, const struct material *m, int material, double time_s)
{
    for (int k = 0; k < m->droplets; k++) {
        const struct chance when = chance_of(material, k, 1), how = chance_of(material, k, 2);
        const double leaves = m->life_s * (0.03 + 0.45 * when.a), flown = time_s - leaves;
        if (flown <= 0)
            continue;
        const struct rg_splash_crown crown = rg_splash_crown(material, leaves);
        const double phi = 2 * M_PI * when.b;
        const double lift = (m->lift_deg + 24 * (when.c - 0.5)) * M_PI / 180;
        const double speed = m->speed_m_s * (0.55 + 0.9 * how.a);
        const double r = crown.radius_m * (1 + m->flare) + speed * cos(lift) * flown;
        const double y =
            crown.height_m + speed * sin(lift) * flown - 0.5 * GRAVITY_M_S2 * flown * flown;
        // nearly log-normal sizes: the sum of uniforms is nearly normal
        const double size = exp(0.9 * (when.d + how.b + how.c - 1.5));
        const double radius = m->droplet_m * size;
        if (y > 0)
            add_ball(depth, r * cos(phi), y, r * sin(phi), radius, ball_m3(radius));
    }
}

// Adds the decaying wave that runs outwards from the foot of the crown.
static void add_ring(float *depth, const struct material *m, const struct rg_splash_crown *crown,
                     double time_s)
{
    const double height = m->ring_m * exp(-time_s / 0.035);
    const double width = 0.0012 + 0.012 * time_s;
    for (int a = 0; a < AROUND; a++) {
        const double phi = 2 * M_PI * a / AROUND;
        for (int u = 0; u < 16; u++) {
            const double across = (u + 0.5) / 8 - 1, r = crown->radius_m + width * across;
            const double area = fabs(r) * 2 * M_PI / AROUND * width / 8;
            double column, row;
            project(r * cos(phi), 0, r * sin(phi), &column, &row);
            add_volume(depth, column, row, area * height * (1 + cos(M_PI * across)));
        }
    }
}

// Adds the column of water that a closing crater throws up in deep water, and the bead on its top.
static void add_jet(float *depth, const struct material *m, double time_s)
{
    enum { SLICES = 64 };
    const double passed = (time_s - 0.62 * m->life_s) / 0.085;
    if (passed <= 0 || passed >= 1 || m->jet_m <= 0)
        return;
    const double height = m->jet_m * 4 * passed * (1 - passed), bead = 0.0017 * sqrt(1 - passed);
    for (int i = 0; i < SLICES; i++) {
        const double s = (i + 0.5) / SLICES, radius = 0.0006 + 0.0022 * pow(1 - s, 3);
        add_ball(depth, 0, height * s, 0, radius, M_PI * radius * radius * height / SLICES);
    }
    add_ball(depth, 0, height, 0, bead, ball_m3(bead));
}

// Turns optical depth into opacity, faded out over the last third of the animation.
static void average(const float *depth, double time_s, float *texels)
{
    const double last = (time_s / (RG_ATLAS_FRAMES * FRAME_S) - 0.65) / 0.35;
    const double left = last > 0 ? 1 - last * last * (3 - 2 * last) : 1;
    memset(texels, 0, RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX * sizeof(*texels));
    for (int r = 0; r < FINE_HEIGHT; r++)
        for (int c = 0; c < FINE_WIDTH; c++)
            texels[r / FINE * RG_SPLASH_WIDTH_PX + c / FINE] +=
                (float)(left * (1 - exp(-(double)depth[r * FINE_WIDTH + c])) / (FINE * FINE));
}

bool rg_splash_draw(int material, int frame, float texels[RG_SPLASH_HEIGHT_PX * RG_SPLASH_WIDTH_PX])
{
    float *depth = rg_alloc(FINE_WIDTH * FINE_HEIGHT, sizeof(*depth), "splash");
    if (!depth)
        return false;
    const struct material *m = &materials[material];
    const double time_s = (frame + 0.5) * FRAME_S, passed = fmin(time_s / m->life_s, 1);
    const double turn = 2 * M_PI * chance_of(material, 0, 3).a;
    const struct rg_splash_crown crown = rg_splash_crown(material, time_s);
    add_ring(depth, m, &crown, time_s);
    add_sheet(depth, m, &crown, turn);
    add_spikes(depth, m, material, &crown, turn, passed);
    add_droplets(depth, m, material, time_s);
    add_jet(depth, m, time_s);
    average(depth, time_s, texels);
    free(depth);
    return true;
}
