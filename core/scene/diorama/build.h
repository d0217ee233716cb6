// Building dioramas: for the files of this folder alone.
//
// A part is a group of faces whose normals are computed together. All coordinates come from exact
// operations on doubles and the dialect's own sine and cosine, and are rounded to floats once, so
// that a diorama is the same on every machine.
#ifndef RG_CORE_SCENE_DIORAMA_BUILD_H
#define RG_CORE_SCENE_DIORAMA_BUILD_H

#include <stdbool.h>
#include <stddef.h>

#include "core/scene/diorama/diorama.h"

typedef struct {
    double x, y, z;
} point;

// Materials by name; palette.c has their colours.
enum paint {
    PAINT_CLAY,
    PAINT_LAWN,
    PAINT_MEADOW,
    PAINT_LEAF,
    PAINT_DARK_LEAF,
    PAINT_BLOSSOM,
    PAINT_BARK,
    PAINT_WOOD,
    PAINT_PALE_WOOD,
    PAINT_STONE,
    PAINT_PALE_STONE,
    PAINT_DARK_STONE,
    PAINT_SAND,
    PAINT_ROAD,
    PAINT_WATER,
    PAINT_PLASTER,
    PAINT_CREAM,
    PAINT_WHITE,
    PAINT_TILE,
    PAINT_BRICK,
    PAINT_GLASS,
    PAINT_RED,
    PAINT_ORANGE,
    PAINT_YELLOW,
    PAINT_BLUE,
    PAINT_TEAL,
    PAINT_PINK,
    PAINT_BLACK,
    PAINT_CHROME,
    PAINT_IRON,
    PAINT_LIGHT,
    PAINT_COFFEE,
    PAINTS
};
// Fills in a diorama's materials.
void diorama_paint(struct diorama *diorama);

// A coordinate frame: its origin, and the vectors of one metre along x, y and z.
struct frame {
    point origin, x, y, z;
};

struct builder {
    const char *name;
    struct frame frame;
    bool is_thin;          // faces added now are visible from both sides
    int face_count, first; // first: of the part in construction
    int64_t face_room, normal_room, material_room, thin_room;
    float *corners, *normals; // nine numbers for each face
    uint32_t *materials;      // by face
    bool *thin;               // by face: `is_thin` when it was added
    bool has_failed;          // memory ran out: one line is logged, and later faces are dropped
};

void builder_begin(struct builder *b, const char *name);
void builder_free(struct builder *b);
// Moves the one-sided faces to the front, and returns their number.
int builder_sort(struct builder *b);
// Makes a mesh of all faces, with equal vertices joined. NULL, and one logged line, on failure.
struct rg_mesh *builder_mesh(const struct builder *b);

// Enters a frame at (x, y, z) of the current one, turned about the upright axis and scaled by
// `size`. Returns the old frame, which builder_leave restores.
struct frame builder_enter(struct builder *b, point at, double turn_deg, double size);
// The same, first tilted about z, then turned.
struct frame builder_tilt(struct builder *b, point at, double tilt_deg, double turn_deg);
void builder_leave(struct builder *b, struct frame frame);

// Adds a face to the current part, its corners counter-clockwise seen from outside.
void builder_face(struct builder *b, point p0, point p1, point p2, enum paint paint);
void builder_quad(struct builder *b, point p0, point p1, point p2, point p3, enum paint paint);
// Ends the part. A corner's normal is the area-weighted mean of those faces at its position that
// differ from its own face by less than the angle.
void builder_end(struct builder *b, double crease_deg);

// A pseudo-random number in [0, 1) from its purpose and the item.
double chance(uint32_t what, uint32_t which);
double sine(double turn_deg);
double cosine(double turn_deg);

// --- parts, parts.c ---

// A skin over `rings` rings of `around` points each, counter-clockwise as the rings come towards
// the viewer. A fan to a point closes an end; NULL leaves it open.
void skin(struct builder *b, const point *points, int rings, int around, const point *first,
          const point *last, enum paint paint);
// A sheet of (across + 1) * (along + 1) points, row by row. Seen from outside, each row is to the
// left of the one before.
void sheet(struct builder *b, const point *points, int across, int along, enum paint paint);

// A box with sharp edges, and one with edges rounded in `steps`.
void box(struct builder *b, point low, point high, enum paint paint);
void soft_box(struct builder *b, point low, point high, double radius, int steps, enum paint paint);
// Turns a profile of (radius, height) about the upright axis through `at`, from the bottom to the
// top of its outside. An end at radius 0 is closed. Normals as builder_end.
struct profile {
    double radius, height;
};
void lathe(struct builder *b, point at, const struct profile *profile, int count, int around,
           double crease_deg, enum paint paint);
// A ring of a round wire about the upright axis.
void ring(struct builder *b, point at, double radius, double wire, int along, int around,
          enum paint paint);
// A round bar along points, with radii that change linearly from the first to the last.
void bar(struct builder *b, const point *points, int count, double radius0, double radius1,
         int around, enum paint paint);
// A ball, flattened and dented; `id` selects the dents.
void ball(struct builder *b, point at, point radii, int rings, int around, double dent, uint32_t id,
          enum paint paint);
// A prism from z0 to z1 over an outline that is star-shaped about its middle, counter-clockwise
// seen from z.
struct spot {
    double x, y;
};
void prism(struct builder *b, const struct spot *outline, int count, double z0, double z1,
           enum paint paint);
// A flat patch on the ground with a wavy rim, in rings.
void puddle(struct builder *b, point at, double radius_x, double radius_z, int rings, int around,
            double wave, uint32_t id, enum paint paint);

// --- plants, plants.c ---

// A tree with a round crown of several balls; `detail` scales its resolution, usually 1.
void tree(struct builder *b, point at, double height_m, double detail, enum paint paint,
          uint32_t id);
// A fir of several skirts.
void fir(struct builder *b, point at, double height_m, int skirts, int around, uint32_t id);
void bush(struct builder *b, point at, double radius_m, int rings, uint32_t id);
// A flower with petals about its middle.
void flower(struct builder *b, point at, double height_m, enum paint paint, uint32_t id);
// A blade of grass of this many faces, bent outwards in its direction.
void blade(struct builder *b, point at, double height_m, double turn_deg, int faces,
           enum paint paint);
// A pebble of an even number of faces, at least 6.
void pebble(struct builder *b, point at, double radius_m, int faces, uint32_t id, enum paint paint);

// --- filling up, fill.c ---

// The area for pebbles and blades: a ring on the ground.
struct leftover {
    point middle;
    double inner_m, outer_m;
    double pebble_m, blade_m; // their sizes
    enum paint pebble, blade;
};
// Adds pebbles and blades so that the mesh has exactly this many vertices and faces. False, and one
// logged line, where no number of them does.
bool fill(struct builder *b, const struct leftover *leftover, int vertices, int faces);

// --- scenes ---

void build_car(struct builder *b);
void build_house1(struct builder *b);
void build_house2(struct builder *b);
void build_table(struct builder *b);
void build_park1(struct builder *b);
void build_park2(struct builder *b);
void build_ground(struct builder *b);

#endif
