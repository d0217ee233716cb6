// A street tree: a trunk, and a crown of lobes. Each lobe is a dark core, which keeps the sky from
// showing through, under sprays of leaves around it.
#include <math.h>

#include "core/scene/city/build.h"

// The purposes of pseudo-random numbers; other files of this folder use other values.
enum { CHANCE_TREE = 100, CHANCE_LEAF = 110, CHANCE_TINT = 111 };

enum { LOBES = 7, CROWN_LEAVES = 1000 };
#define GOLDEN_TURN 2.399963229728653 // the golden angle, which spreads points evenly over a sphere
#define CORE_SHARE  0.72              // radius of a lobe's core over that of the lobe
#define LEAF_M      0.56              // the greatest length of a spray

struct lobe {
    point centre;
    double radius_m;
};

static point between(point a, point b, double share)
{
    return (point){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share};
}

static point away(point from, point to)
{
    const point d = {to.x - from.x, to.y - from.y, to.z - from.z};
    const double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    return (point){d.x / length, d.y / length, d.z / length};
}

static double distance(point a, point b)
{
    return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

static point out(point from, point way, double by)
{
    return (point){from.x + way.x * by, from.y + way.y * by, from.z + way.z * by};
}

static point cross(point a, point b)
{
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// --- the lump ---

static void lump_triangle(struct city_builder *b, const struct look *look, point centre,
                          const point p[3])
{
    const point middle = between(between(p[0], p[1], 0.5), p[2], 1.0 / 3);
    city_triangle_on(b, p, city_surface(b, look, away(centre, middle), NULL));
}

// A sphere of `rings` rings, twice as many around.
static void build_lump(struct city_builder *b, point c, double radius, int rings, uint32_t tint)
{
    const struct look look = {PAINT_LEAVES, SCENERY_KIND_LEAVES, 1.6, tint, 0};
    const int sides = 2 * rings;
    for (int i = 0; i < rings; i++) {
        for (int j = 0; j < sides; j++) {
            point at[2][2];
            for (int k = 0; k < 4; k++) {
                const double down = M_PI * (i + k / 2) / rings;
                const double around = 2 * M_PI * (j + k % 2) / sides;
                at[k / 2][k % 2] =
                    (point){c.x + radius * sin(down) * cos(around), c.y + radius * cos(down),
                            c.z - radius * sin(down) * sin(around)};
            }
            if (i < rings - 1)
                lump_triangle(b, &look, c, (const point[]){at[0][0], at[1][0], at[1][1]});
            if (i > 0)
                lump_triangle(b, &look, c, (const point[]){at[0][0], at[1][1], at[0][1]});
        }
    }
}

// --- leaves ---

// Darkens leaves deep in the crown and on its lower side, which see less of the sky.
static uint32_t leaf_tint(const struct city_builder *b, uint32_t id, uint32_t k, double up)
{
    const double light = 0.72 + 0.12 * up + 0.16 * city_chance(b, CHANCE_TINT, id, k);
    const double warm = 0.9 + 0.1 * city_chance(b, CHANCE_TINT, id, k + 65536);
    const uint32_t g = (uint32_t)(255 * light), r = (uint32_t)(warm * g);
    return r | g << 8 | (uint32_t)(0.85 * g) << 16;
}

// A spray of leaves, a kite, randomly turned and tilted away from the lobe's surface. It is lit
// with the normal of the round crown, not of the facet.
static void build_leaf(struct city_builder *b, const struct lobe *lobe, point crown, point way,
                       uint32_t id, uint32_t k)
{
    double chance[5];
    for (uint32_t i = 0; i < 5; i++)
        chance[i] = city_chance(b, CHANCE_LEAF, id, 8 * k + i);
    const point foot = out(lobe->centre, way, lobe->radius_m * (0.72 + 0.28 * chance[0]));
    const point up = fabs(way.y) < 0.9 ? (point){0, 1, 0} : (point){1, 0, 0};
    const point flat = cross(up, way), east = away((point){0, 0, 0}, flat),
                north = cross(way, east);
    const double turn = 2 * M_PI * chance[1], tilt = 0.7 * chance[2];
    const double length = LEAF_M * (0.6 + 0.4 * chance[3]), half = 0.36 * length;
    const point level = out(out((point){0, 0, 0}, east, cos(turn)), north, sin(turn));
    const point along = out(out((point){0, 0, 0}, level, cos(tilt)), way, sin(tilt));
    const point side = cross(way, level), middle = out(foot, along, 0.45 * length);
    const point p[4] = {foot, out(middle, side, -half), out(foot, along, length),
                        out(middle, side, half)};
    const point lit = away((point){0, 0, 0}, between(way, away(crown, foot), 0.3));
    const struct look look = {PAINT_LEAVES + (int)(2 * chance[4]), SCENERY_KIND_LEAVES, 1.6,
                              leaf_tint(b, id, k, lit.y), 0};
    city_quad_on(b, p, city_surface(b, &look, lit, NULL));
}

static bool is_inside(const struct lobe *lobes, int but, point p)
{
    bool inside = false;
    for (int i = 0; i < LOBES; i++)
        inside |= i != but && distance(lobes[i].centre, p) < CORE_SHARE * lobes[i].radius_m;
    return inside;
}

// Adds leaves all over the lobes, equally dense on each, except inside other lobes.
static void build_leaves(struct city_builder *b, const struct lobe *lobes, point crown, uint32_t id)
{
    double squares = 0;
    for (int i = 0; i < LOBES; i++)
        squares += lobes[i].radius_m * lobes[i].radius_m;
    uint32_t k = 0;
    for (int i = 0; i < LOBES; i++) {
        const struct lobe *lobe = &lobes[i];
        const int count = (int)(CROWN_LEAVES * lobe->radius_m * lobe->radius_m / squares);
        for (int j = 0; j < count; j++, k++) {
            const double y = 1 - (2 * j + 1.0) / count, level = sqrt(1 - y * y);
            const double around = GOLDEN_TURN * j;
            const point way = {level * cos(around), y, level * sin(around)};
            if (!is_inside(lobes, i, out(lobe->centre, way, lobe->radius_m)))
                build_leaf(b, lobe, crown, way, id, k);
        }
    }
}

// --- the tree ---

// Places one lobe in the middle and the others around it, alternately lower and higher.
static void place_lobes(const struct city_builder *b, point crown, double radius, uint32_t id,
                        struct lobe lobes[LOBES])
{
    lobes[0] = (struct lobe){{crown.x, crown.y + 0.35 * radius, crown.z}, 0.95 * radius};
    for (int i = 1; i < LOBES; i++) {
        const double chance = city_chance(b, CHANCE_TREE, id, 1002 + (uint32_t)i);
        const double turn = 2 * M_PI * (i + 0.5 * chance) / (LOBES - 1), off = 0.80 * radius;
        const double up = (i & 1 ? -0.30 : 0.15) + 0.2 * chance;
        lobes[i] = (struct lobe){
            {crown.x + off * cos(turn), crown.y + radius * up, crown.z + off * sin(turn)},
            radius * (0.60 + 0.16 * chance)};
    }
}

void city_build_tree(struct city_builder *b, point foot, uint32_t id)
{
    static const struct look bark = {PAINT_BARK, SCENERY_KIND_WALL, 1, 0, 0};
    const double height = 2.6 + 1.2 * city_chance(b, CHANCE_TREE, id, 1000);
    const double radius = 1.5 + 0.5 * city_chance(b, CHANCE_TREE, id, 1001);
    const point crown = {foot.x, foot.y + height + radius, foot.z};
    if (b->settings.size != CITY_FULL) {
        build_lump(b, crown, radius * 1.2, 3, 0);
        return;
    }
    struct lobe lobes[LOBES];
    place_lobes(b, crown, radius, id, lobes);
    city_post(b, foot.x, foot.z, foot.y, crown.y, 0.2, 0.09, 8, &bark);
    for (int i = 0; i < LOBES; i++)
        build_lump(b, lobes[i].centre, CORE_SHARE * lobes[i].radius_m, i ? 4 : 5, 0x505850u);
    build_leaves(b, lobes, crown, id);
}
