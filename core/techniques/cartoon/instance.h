// What the files of cartoon share.
#ifndef RG_CORE_TECHNIQUES_CARTOON_INSTANCE_H
#define RG_CORE_TECHNIQUES_CARTOON_INSTANCE_H

#include "core/scene/camera.h"
#include "core/scene/diorama/diorama.h"
#include "core/scene/mesh/edges.h"
#include "core/techniques/cartoon/cartoon.h"
#include "core/techniques/cartoon/rain/rain.h"
#include "core/techniques/cartoon/water/water.h"
#include "core/techniques/technique.h"
#include "kernels/cartoon/scene/faces_params.h"
#include "kernels/cartoon/scene/ink_params.h"
#include "kernels/cartoon/scene/shade_params.h"

enum cartoon_stage {
    CARTOON_RUN_SOLIDS,
    CARTOON_RUN_THIN,
    CARTOON_RUN_SOLID_NUMBERS,
    CARTOON_RUN_THIN_NUMBERS,
    CARTOON_RUN_INK,
    // One of these draws the picture.
    CARTOON_RUN_GOOCH,
    CARTOON_RUN_TONES,
    CARTOON_RUN_PAPER,
    CARTOON_RUN_HATCHING,
    CARTOON_RUN_KEPT,
    CARTOON_STAGES
};

// The strokes of hatching: a tile's side, and its levels.
enum { CARTOON_TILE_PX = 256, CARTOON_LEVELS = 4 };

// How the scene is looked at in the present frame.
struct cartoon_view {
    struct rg_camera camera;
    m4 to_clip, from_pixel; // from the world; from pixels and depth to the world, over w
    float to_eye[16];       // from the world to the camera's own space (core/scene/camera.h)
    float to_light[3];      // of unit length
};

struct cartoon {
    struct rg_instance base;
    struct cartoon_settings settings;
    struct diorama *diorama; // its mesh has the triangles and bounds
    struct cartoon_view view;
    struct rg_asset *normal_map, *depth_map, *face_map, *number_depth, *ink;
    struct rg_asset *picture; // in its style; of one texel where it is drawn onto the target
    int edge_count;
    cartoon_faces_params solids, thin; // solids are seen from outside alone
    cartoon_ink_params outlines;
    cartoon_shade_params shade;
    m4 found_by;      // the view whose normal map, depth and ink are there
    int64_t found_in; // one more than the frame that drew them; 0: none did
    bool has_picture; // of that view
    struct cartoon_rain rain;
    struct cartoon_water water;
};

extern const struct rg_proof cartoon_proof;

bool cartoon_open(struct rg_instance *instance);
void cartoon_close(struct rg_instance *instance);
bool cartoon_step(struct rg_instance *instance);
bool cartoon_draw(struct rg_instance *instance);

// The scene, in scene/.

// Loads the diorama and adds its assets: the mesh as `positions`, `normals`, `indices` and
// `materials`, the `palette`, and two images of the target's size that each drawing of the scene
// leaves: `normal_map`, RGBA16F, the normal in the world on the side that is seen, and one more
// than the number of the material, all 0 in the sky; and `depth_map`, D32F, 1 in the sky. Where
// collisions ask for faces, `face_map`, RGBA8: which face is nearest, as numbers.h packs it. With
// outlines the `edges` and their `ink`; with hatching its `strokes`. Fills in the view of frame 0.
bool cartoon_scene_open(struct cartoon *c);
// Finds how the scene is looked at in a frame. False, and one logged line, where it cannot be.
bool cartoon_look(struct cartoon *c, int64_t frame);
// Whether a place is inside of a solid of the mesh.
bool cartoon_is_inside(const struct rg_mesh *mesh, const float eye[3]);
// Draws the scene into the normal map and the depth, and in its style onto the target.
// Draws the scene into the normal map, the depth and the ink, unless what the camera sees is there.
bool cartoon_scene_find(struct cartoon *c);
// The same, and draws it in its style onto the target.
bool cartoon_scene_draw(struct cartoon *c);

// Adds the image `strokes`: RGBA8, CARTOON_LEVELS levels, tones 0 to 3 in the channels of its first
// layer, 3 to 6 in those of its second.
void cartoon_add_strokes(struct cartoon *c);
// Hands over each tone of them as a texture of its own (core/techniques/technique.h).
bool cartoon_make_strokes(rg_take_texture *take, void *user);

#endif
