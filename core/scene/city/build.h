// Functions by which parts of the city add faces: only for the files of this folder.
#ifndef RG_CORE_SCENE_CITY_BUILD_H
#define RG_CORE_SCENE_CITY_BUILD_H

#include "core/scene/city/city.h"
#include "core/scene/city/textures.h"

typedef struct {
    double x, y, z;
} point;

// The material of a surface.
struct look {
    int texture;
    int kind;      // SCENERY_KIND_...
    double tile_m; // width of one texture tile; 0: 4 m
    uint32_t tint; // r, g, b of 8 bits; 0: white
    int glow;      // emitted light, 0 to 7
};

// The place of a texture on a surface (kernels/scenery/surface.h): textures per metre, and their
// origin along u and v.
struct mapping {
    double scale_u, scale_v, from_u, from_v;
    bool turned; // on the ground: u along z
};

enum { CITY_SHOPS = PAINT_WALL - PAINT_SHOP };

struct city_builder {
    struct city_settings settings;
    struct city *city;
    int64_t face_room, surface_room, lamp_room, box_room;
    bool failed; // memory ran out: one line is logged, and later faces are dropped
    // A hash table of surfaces, so that equal ones share a number.
    int *places;
    int place_room;
    struct {
        bool is_known, shines;
        float tint[3];
    } signs[CITY_SHOPS]; // by texture, which many shops share
};

// A pseudo-random number in [0, 1) from the seed, its purpose, and the item.
double city_chance(const struct city_builder *b, uint32_t what, uint32_t which, uint32_t k);

// The number of a surface with this normal. `mapping` may be NULL: the texture is then aligned with
// the world.
uint32_t city_surface(struct city_builder *b, const struct look *look, point normal,
                      const struct mapping *mapping);
// Add a face of four or three corners on a surface.
void city_quad_on(struct city_builder *b, const point corners[4], uint32_t surface);
void city_triangle_on(struct city_builder *b, const point corners[3], uint32_t surface);
// Adds a quad with a surface aligned with the world.
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
// An upright prism or cone of `sides` sides about (x, z), with a lid unless it ends in a point.
void city_post(struct city_builder *b, double x, double z, double y0, double y1, double radius0,
               double radius1, int sides, const struct look *look);
void city_box_add(struct city_builder *b, point low, point high);
// The lamp, whose tint can be set until the next is added; NULL where memory ran out.
struct city_lamp *city_lamp_add(struct city_builder *b, enum city_lamp_kind kind, point at,
                                point direction);

// The street plan (plan.c): lines of streets, and blocks between them.
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
#define CITY_KERB_M 0.15 // the height of islands above the roads

void city_build_streets(struct city_builder *b);   // street.c
void city_build_furniture(struct city_builder *b); // furniture.c
// tree.c: a tree that stands at `foot`; `id` is its own number, for pseudo-random choices.
void city_build_tree(struct city_builder *b, point foot, uint32_t id);
// buildings/building.c: all buildings, with as much relief as brings the city to `triangles`. Call
// it last.
void city_build_buildings(struct city_builder *b, int triangles);

#endif
