// A procedural city for rain to fall on: streets, an avenue, a plaza, buildings that rise towards
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
    CITY_TRIANGLES = 779287,      // as many as Creus' model from Daz3D has
    CITY_SMALL_TRIANGLES = 20001, // of the small one: the same streets and heights, less relief
    CITY_TEXTURES = 149,
    CITY_TEXTURE_PX = 624, // a side: 149 of them make 58 megapixels
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

// A box that faces enclose: what lies behind it is not seen. At y0 it stands on the ground or on
// such a box.
struct city_box {
    float low[3], high[3];
};

// Faces that lie together: a part of the face arrays, and what holds them.
struct city_chunk {
    int first, count;
    float low[3], high[3];
    // The direction in which all of them look, of unit length; 0 where directions differ.
    float normal[3];
};

enum city_lamp_kind { CITY_STREET_LAMP, CITY_TRAFFIC_RED, CITY_TRAFFIC_GREEN };
struct city_lamp {
    enum city_lamp_kind kind;
    float position[3];
    float direction[3]; // the way it shines, of unit length
};

// A scene in faces: quads, each of which is two triangles, and triangles, whose last corner stands
// twice; counter-clockwise seen from outside, each in one plane. Faces of a chunk stand together.
struct city_faces {
    int face_count, triangle_count;
    float *corners;       // SCENERY_FACE_WORDS a face: x, y, z of four corners
    uint32_t *surface_of; // a face's
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
    bool is_mesh; // a user's: its faces may turn either way
    struct city_faces faces;
    int lamp_count;
    struct city_lamp *lamps;
    int box_count;
    struct city_box *boxes; // within the buildings
    int texture_count, texture_px;
    uint64_t hash; // XXH3 of the faces, their surfaces and the settings that paint the textures
};

// NULL, and one logged line, without memory. The caller destroys it.
struct city *city_create(const struct city_settings *settings);
// A user's mesh instead of a city, in matt grey, on a plain ground. It stands in the middle of the
// city's space and fills it. It has no lamps, no boxes and one texture. `name` is what rg_mesh_load
// takes. NULL, and one logged line, on failure.
struct city *city_of_mesh(const char *name);
void city_destroy(struct city *city);

// The painter of a city's textures; a mesh's one is white. NULL, and one logged line, without
// memory. The caller destroys it.
struct city_painter *city_painter_create(const struct city_settings *settings);
void city_painter_destroy(struct city_painter *painter);
// Paints a texture: RGBA8 of texture_px squared texels, rows from the top. Each alone, so that
// several can be painted at once. Colours are square roots of linear light, alpha the share of it
// that a lamp behind gives at night.
void city_paint(const struct city_painter *painter, int texture, uint32_t *texels);

// Fills SCENERY_OPEN_WORDS words (kernels/scenery/openness_grid.h): how much of the sky is seen
// from where. False, and one logged line, without memory.
bool city_openness(const struct city *city, uint32_t *words);

// The two places from which Creus looks: `second` sees farther. `near_plane` and `far_plane` hold
// the city whole.
extern const struct rg_camera city_first_camera, city_second_camera;

// Frees what a city_faces holds.
void city_faces_free(struct city_faces *faces);
// Orders the faces so that those which lie together and look the same way stand together, and makes
// the chunks and bounds. False, and one logged line, without memory.
bool city_faces_sort(struct city_faces *faces);

#endif
