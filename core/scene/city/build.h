// How the city's parts add their faces: for the files of this folder alone.
#ifndef RG_CORE_SCENE_CITY_BUILD_H
#define RG_CORE_SCENE_CITY_BUILD_H

#include "core/scene/city/city.h"
#include "core/scene/city/textures.h"

typedef struct {
    double x, y, z;
} point;

// What a surface is made of.
struct look {
    int texture;
    int kind;      // SCENERY_KIND_...
    double tile_m; // how wide a texture is; 0: 4 m
    uint32_t tint; // r, g, b of 8 bits; 0: white
    int glow;      // by itself, 0 to 7
};

// Where a texture lies (kernels/scenery/surface.h): textures a metre, and where they begin along u
// and v.
struct mapping {
    double scale_u, scale_v, from_u, from_v;
    bool turned; // on the ground: u along z
};

struct city_builder {
    struct city_settings settings;
    struct city *city;
    int64_t face_room, surface_room, lamp_room, box_room;
    bool failed; // no memory: one line is logged, and what follows is left out
    // Surfaces by what they are, so that equal ones are one.
    int *places;
    int place_room;
};

// A number in [0, 1) that depends on the seed, what it is for, and which of those it is.
double city_chance(const struct city_builder *b, uint32_t what, uint32_t which, uint32_t k);

// The number of a surface that looks along `normal`. `mapping` may be NULL: the texture then lies
// upon the world.
uint32_t city_surface(struct city_builder *b, const struct look *look, point normal,
                      const struct mapping *mapping);
// A face of four corners, or of three, on a surface.
void city_quad_on(struct city_builder *b, const point corners[4], uint32_t surface);
void city_triangle_on(struct city_builder *b, const point corners[3], uint32_t surface);
// The same with a surface that lies upon the world.
void city_quad(struct city_builder *b, point p0, point p1, point p2, point p3,
               const struct look *look);
void city_triangle(struct city_builder *b, point p0, point p1, point p2, const struct look *look);

// The sides of a box.
enum {
    BOX_X0 = 1,
    BOX_X1 = 2,
    BOX_Y0 = 4,
    BOX_Y1 = 8,
    BOX_Z0 = 16,
    BOX_Z1 = 32,
    BOX_WALLS = 51,
    BOX_ON_GROUND = 59,
    BOX_ALL = 63
};
void city_box(struct city_builder *b, point low, point high, int sides, const struct look *look);
// An upright prism or cone of `sides` sides about (x, z); with a lid where it does not end in a
// point.
void city_post(struct city_builder *b, double x, double z, double y0, double y1, double radius0,
               double radius1, int sides, const struct look *look);
void city_box_add(struct city_builder *b, point low, point high);
void city_lamp_add(struct city_builder *b, enum city_lamp_kind kind, point at, point direction);

// The plan of the streets (plan.c). Lines of streets, and blocks between them.
enum { CITY_COLUMNS = 6, CITY_ROWS = 6 };
struct city_block {
    double x0, z0, x1, z1;
    bool plaza;
    int index;
};
struct city_block city_block_at(int column, int row);
// A block with the pavement around it; roads fill the rest.
struct city_island {
    double x0, z0, x1, z1;
};
struct city_island city_island_at(int column, int row);
#define CITY_KERB_M 0.15 // how high islands stand above the roads

void city_build_streets(struct city_builder *b);   // street.c
void city_build_furniture(struct city_builder *b); // furniture.c
// tree.c: a tree that stands at `foot`; `id` is a number of its own, for chances.
void city_build_tree(struct city_builder *b, point foot, uint32_t id);
// buildings/building.c: all buildings, so that the city has as many triangles as wanted. To be
// called last.
void city_build_buildings(struct city_builder *b, int triangles);

#endif
