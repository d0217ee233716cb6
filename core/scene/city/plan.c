// The city's plan: an avenue along z, streets across it and parallel to it, blocks between them;
// and the places of Creus's cameras.
#include "core/scene/city/build.h"

#define SIDE_M   (CITY_SIDE_M / 2.0)
#define ROAD_M   4.5  // half a street's roadway
#define WALK_M   3.5  // a street's pavement
#define AVENUE_M 9.0  // half the avenue's roadway
#define BESIDE_M 5.0  // the avenue's pavement
#define BORDER_M 10.0 // from the last block to the city's border: a pavement and half a street
#define COLUMN_M 48.0 // length of a block
#define ROW_M    50.0

static double column_start(int column)
{
    const double avenue =
        column >= CITY_COLUMNS / 2 ? 2 * (AVENUE_M + BESIDE_M - ROAD_M - WALK_M) : 0;
    return -SIDE_M + BORDER_M + column * (COLUMN_M + 2 * (ROAD_M + WALK_M)) + avenue;
}

static double row_start(int row)
{
    return -SIDE_M + BORDER_M + row * (ROW_M + 2 * (ROAD_M + WALK_M));
}

struct city_block city_block_at(int column, int row)
{
    const double x = column_start(column), z = row_start(row);
    return (struct city_block){
        .x0 = x,
        .x1 = x + COLUMN_M,
        .z0 = z,
        .z1 = z + ROW_M,
        .plaza = column == CITY_COLUMNS / 2 && row == CITY_ROWS / 2,
        .index = row * CITY_COLUMNS + column,
    };
}

struct city_island city_island_at(int column, int row)
{
    const struct city_block block = city_block_at(column, row);
    const int half = CITY_COLUMNS / 2;
    return (struct city_island){
        block.x0 - (column == half ? BESIDE_M : WALK_M),
        block.z0 - WALK_M,
        block.x1 + (column == half - 1 ? BESIDE_M : WALK_M),
        block.z1 + WALK_M,
    };
}

// The thesis does not say where the cameras stand. From these places, the packets that its tables
// draw hold as many particles as printed, to 18 % (test `counts of particles`). For the first
// camera only a range of 2 cm across the avenue achieves that.
const struct rg_camera city_first_camera = {
    .position = {-6.94f, 1.7f, 107.1f},
    .target = {0.5f, 11.0f, 32.8f},
    .up = {0, 1, 0},
    .angle_deg = 60,
    .near_plane = 0.2f,
    .far_plane = 1000,
};
const struct rg_camera city_second_camera = {
    .position = {-5.88f, 6.0f, 66.9f},
    .target = {-8.0f, 20.0f, -107.7f},
    .up = {0, 1, 0},
    .angle_deg = 60,
    .near_plane = 0.2f,
    .far_plane = 1000,
};
