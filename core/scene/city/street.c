// The ground: roads with their markings, kerbs, pavements, and the plaza.
#include <math.h>

#include "core/scene/city/build.h"

#define SIDE_M     (CITY_SIDE_M / 2.0)
#define CROSSING_M 4.0  // the length of a crossing along its road, and its distance from a junction
#define STOP_M     3.0  // length of the strip with the stop line
#define STRIP_M    18.0 // roads are cut into such pieces, so that depth planes start near pixels
#define KERB_TOP_M 0.3

static const struct look plain = {PAINT_ASPHALT, SCENERY_KIND_ASPHALT, 9, 0, 0};
static const struct look slabs = {PAINT_PAVING, SCENERY_KIND_PAVING, 4, 0, 0};
static const struct look kerb = {PAINT_PAVING + 1, SCENERY_KIND_PAVING, 2, 0, 0};
static const struct look plaza_stone = {PAINT_PAVING + 2, SCENERY_KIND_PAVING, 6, 0, 0};
static const struct look grass = {PAINT_GRASS, SCENERY_KIND_EARTH, 5, 0, 0};

// --- roads ---

// A road's rectangle with a texture that spans its width.
struct road {
    double x0, z0, x1, z1;
    bool along_z;
};

// Builds the part of a road between two distances along it.
static void road_part(struct city_builder *b, const struct road *r, double from, double to,
                      const struct look *look)
{
    const double across = 1 / (r->along_z ? r->x1 - r->x0 : r->z1 - r->z0);
    const struct mapping m = {across, 1 / look->tile_m, r->along_z ? r->x0 : r->z0, 0, !r->along_z};
    const double x0 = r->along_z ? r->x0 : from, x1 = r->along_z ? r->x1 : to;
    const double z0 = r->along_z ? from : r->z0, z1 = r->along_z ? to : r->z1;
    const point corners[4] = {{x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}};
    city_quad_on(b, corners, city_surface(b, look, (point){0, 1, 0}, &m));
}

// A road between two junctions, with a crossing and a stop line at each end.
static void build_road(struct city_builder *b, const struct road *r, bool avenue)
{
    const struct look crossing = {PAINT_CROSSING, SCENERY_KIND_ASPHALT, CROSSING_M, 0, 0};
    const struct look stop = {PAINT_STOP, SCENERY_KIND_ASPHALT, STOP_M, 0, 0};
    const struct look lanes = {PAINT_ASPHALT + (avenue ? 2 : 1), SCENERY_KIND_ASPHALT,
                               avenue ? 18 : 9, 0, 0};
    const double from = r->along_z ? r->z0 : r->x0, to = r->along_z ? r->z1 : r->x1;
    const double ends[4] = {from + CROSSING_M, from + CROSSING_M + STOP_M, to - CROSSING_M - STOP_M,
                            to - CROSSING_M};
    road_part(b, r, from, ends[0], &crossing);
    road_part(b, r, ends[0], ends[1], &stop);
    const int parts = (int)ceil((ends[2] - ends[1]) / STRIP_M);
    for (int i = 0; i < parts; i++)
        road_part(b, r, ends[1] + (ends[2] - ends[1]) * i / parts,
                  ends[1] + (ends[2] - ends[1]) * (i + 1) / parts, &lanes);
    road_part(b, r, ends[2], ends[3], &stop);
    road_part(b, r, ends[3], to, &crossing);
}

static void flat(struct city_builder *b, double x0, double z0, double x1, double z1, double y,
                 const struct look *look)
{
    city_quad(b, (point){x0, y, z1}, (point){x1, y, z1}, (point){x1, y, z0}, (point){x0, y, z0},
              look);
}

// Start and end of the gaps between islands, including those at the border.
static double gap_start_x(int i)
{
    return i ? city_island_at(i - 1, 0).x1 : -SIDE_M;
}

static double gap_end_x(int i)
{
    return i < CITY_COLUMNS ? city_island_at(i, 0).x0 : SIDE_M;
}

static double gap_start_z(int i)
{
    return i ? city_island_at(0, i - 1).z1 : -SIDE_M;
}

static double gap_end_z(int i)
{
    return i < CITY_ROWS ? city_island_at(0, i).z0 : SIDE_M;
}

static void build_roads(struct city_builder *b)
{
    for (int i = 0; i <= CITY_COLUMNS; i++) {
        for (int j = 0; j <= CITY_ROWS; j++) {
            const double x0 = gap_start_x(i), x1 = gap_end_x(i);
            const double z0 = gap_start_z(j), z1 = gap_end_z(j);
            flat(b, x0, z0, x1, z1, 0, &plain);
            if (j < CITY_ROWS)
                build_road(b, &(struct road){x0, z1, x1, gap_start_z(j + 1), true},
                           i == CITY_COLUMNS / 2);
            if (i < CITY_COLUMNS)
                build_road(b, &(struct road){x1, z0, gap_start_x(i + 1), z1, false}, false);
        }
    }
}

// --- islands ---

// Fills the area between two nested rectangles at one height.
static void ring(struct city_builder *b, const struct city_island *o, const struct city_island *i,
                 double y, const struct look *look)
{
    city_quad(b, (point){o->x0, y, o->z1}, (point){o->x1, y, o->z1}, (point){i->x1, y, i->z1},
              (point){i->x0, y, i->z1}, look);
    city_quad(b, (point){o->x1, y, o->z1}, (point){o->x1, y, o->z0}, (point){i->x1, y, i->z0},
              (point){i->x1, y, i->z1}, look);
    city_quad(b, (point){o->x1, y, o->z0}, (point){o->x0, y, o->z0}, (point){i->x0, y, i->z0},
              (point){i->x1, y, i->z0}, look);
    city_quad(b, (point){o->x0, y, o->z0}, (point){o->x0, y, o->z1}, (point){i->x0, y, i->z1},
              (point){i->x0, y, i->z0}, look);
}

static struct city_island shrunk(const struct city_island *o, double by)
{
    return (struct city_island){o->x0 + by, o->z0 + by, o->x1 - by, o->z1 - by};
}

static void build_plaza(struct city_builder *b, const struct city_block *block)
{
    const struct city_island all = {block->x0, block->z0, block->x1, block->z1};
    const struct city_island inner = shrunk(&all, 9), edge = shrunk(&inner, 0.4);
    const double y = CITY_KERB_M, low = y + 0.35;
    ring(b, &all, &inner, y, &plaza_stone);
    // a lawn with a low wall
    city_box(b, (point){inner.x0, y, inner.z0}, (point){inner.x1, low, inner.z1}, BOX_WALLS, &kerb);
    ring(b, &inner, &edge, low, &kerb);
    flat(b, edge.x0, edge.z0, edge.x1, edge.z1, low, &grass);
}

static void build_island(struct city_builder *b, int column, int row)
{
    const struct city_block block = city_block_at(column, row);
    const struct city_island outer = city_island_at(column, row);
    const struct city_island walk = shrunk(&outer, KERB_TOP_M);
    const struct city_island lots = {block.x0, block.z0, block.x1, block.z1};
    city_box(b, (point){outer.x0, 0, outer.z0}, (point){outer.x1, CITY_KERB_M, outer.z1}, BOX_WALLS,
             &kerb);
    ring(b, &outer, &walk, CITY_KERB_M, &kerb);
    ring(b, &walk, &lots, CITY_KERB_M, &slabs);
    if (block.plaza)
        build_plaza(b, &block);
    else
        flat(b, lots.x0, lots.z0, lots.x1, lots.z1, CITY_KERB_M, &slabs);
}

void city_build_streets(struct city_builder *b)
{
    build_roads(b);
    for (int column = 0; column < CITY_COLUMNS; column++)
        for (int row = 0; row < CITY_ROWS; row++)
            build_island(b, column, row);
}
