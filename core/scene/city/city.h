// A procedural city for rain to fall on: streets, an avenue, a plaza, buildings that are highest in
// the middle, lamps and traffic lights, and 149 textures, all from one seed. docs/city.md shows it.
//
// Right-handed, y up, in metres; the ground lies at y = 0 and has no gaps.
#ifndef RG_CORE_SCENE_CITY_CITY_H
#define RG_CORE_SCENE_CITY_CITY_H

#include <stdbool.h>
#include <stdint.h>

#include "core/scene/camera.h"
#include "core/scene/mesh/mesh.h"
#include "kernels/scenery/city_params.h"
#include "kernels/scenery/surface.h"

enum {
    CITY_TRIANGLES = 779287,      // the same number as Creus's model from Daz3D
    CITY_SMALL_TRIANGLES = 20001, // the small city: the same streets and heights, less relief
    CITY_TEXTURES = 149,
    CITY_TEXTURE_PX = 624, // width and height: 149 of them make 58 megapixels
    CITY_SMALL_TEXTURE_PX = 64,
    CITY_CHUNK_FACES = 1024, // at most
};
#define CITY_SIDE_M   400.0f // along x and z, about the origin
#define CITY_HEIGHT_M 230.0f // of the mast on the highest tower

enum city_size { CITY_FULL, CITY_SMALL };
struct city_settings {
    int seed;
    enum city_size size;
};

// A closed box inside a building, which hides everything behind it. Its lower side is on the ground
// or on another box.
struct city_box {
    float low[3], high[3];
};

// A run of neighbouring faces in the arrays, with its bounds.
struct city_chunk {
    int first, count;
    float low[3], high[3];
    // The unit direction that all of them face; 0 where directions differ.
    float normal[3];
};

enum city_lamp_kind {
    CITY_STREET_LAMP,
    CITY_TRAFFIC_RED,
    CITY_TRAFFIC_GREEN,
    CITY_HEADLIGHT,
    CITY_TAIL_LIGHT,
    CITY_SIGN, // over a shop's windows
    CITY_LAMP_KINDS
};
struct city_lamp {
    enum city_lamp_kind kind;
    float position[3];
    float direction[3]; // the direction of its light, of unit length
    float tint[3];      // of signs: their linear colour, of luminance 1
};

// A scene's faces: planar quads, each of two triangles, and triangles, whose last corner is
// repeated; counter-clockwise seen from outside. The faces of a chunk are contiguous.
struct city_faces {
    int face_count, triangle_count;
    float *corners;       // SCENERY_FACE_WORDS for each face: x, y, z of four corners
    uint32_t *surface_of; // the surface of each face
    int surface_count;
    uint32_t *surfaces; // SCENERY_SURFACE_WORDS each
    int chunk_count;
    struct city_chunk *chunks;
    float low[3], high[3]; // bounds
};

struct city_painter;

struct city {
    char name[RG_MESH_NAME_SIZE]; // for people and records
    struct city_settings settings;
    bool is_mesh; // a user's mesh, whose faces may have either orientation
    struct city_faces faces;
    int lamp_count;
    struct city_lamp *lamps;
    int box_count;
    struct city_box *boxes; // inside the buildings, for culling
    int texture_count, texture_px;
    uint64_t hash; // XXH3 of the faces, their surfaces and the settings that paint the textures
};

// NULL, and one logged line, when memory runs out. The caller destroys it.
struct city *city_create(const struct city_settings *settings);
// Makes a scene of a user's mesh instead of a city, matt grey, on a plain ground, scaled to fill
// the city's space. It has no lamps, no boxes and one texture. `name` is as for rg_mesh_load. NULL,
// and one logged line, on failure.
struct city *city_of_mesh(const char *name);
void city_destroy(struct city *city);

// The painter of a city's textures; a mesh's only texture is white. NULL, and one logged line, when
// memory runs out. The caller destroys it.
struct city_painter *city_painter_create(const struct city_settings *settings);
void city_painter_destroy(struct city_painter *painter);
// Paints a texture: RGBA8 of texture_px squared texels, rows from the top. Textures are
// independent, so that several can be painted at once. Colours are square roots of linear light,
// alpha is the share that a lamp behind adds at night.
void city_paint(const struct city_painter *painter, int texture, uint32_t *texels);

// Fills SCENERY_OPEN_WORDS words (kernels/scenery/openness_grid.h) with the visible share of the
// sky at grid points. False, and one logged line, when memory runs out.
bool city_openness(const struct city *city, uint32_t *words);

// Creus's two cameras; the second sees farther. The whole city lies between `near_plane` and
// `far_plane`.
extern const struct rg_camera city_first_camera, city_second_camera;

// Frees the arrays of a city_faces.
void city_faces_free(struct city_faces *faces);
// Sorts the faces so that neighbours with one direction are contiguous, and makes the chunks and
// bounds. False, and one logged line, when memory runs out.
bool city_faces_sort(struct city_faces *faces);

#endif
