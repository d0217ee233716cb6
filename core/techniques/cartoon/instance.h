// Shared declarations of cartoon's files.
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
    // Exactly one of these draws the picture.
    CARTOON_RUN_GOOCH,
    CARTOON_RUN_TONES,
    CARTOON_RUN_PAPER,
    CARTOON_RUN_HATCHING,
    CARTOON_STAGES
};

// The texture of hatching strokes: a tile's side, and its levels.
enum { CARTOON_TILE_PX = 256, CARTOON_LEVELS = 4 };

// The scene's view in the current frame.
struct cartoon_view {
    struct rg_camera camera;
    m4 to_clip, from_pixel; // to_clip: from the world; from_pixel: from pixels and depth to the
                            // world, over w
    float to_eye[16];       // from the world to the camera's own space (core/scene/camera.h)
    float to_light[3];      // of unit length
};

struct cartoon {
    struct rg_instance base;
    struct cartoon_settings settings;
    struct diorama *diorama; // its mesh has the triangles and bounds
    struct cartoon_view view;
    struct rg_asset *normal_map, *depth_map, *face_map, *number_depth, *ink;
    struct rg_layer layer; // of rain and puddles, over the styled picture
    int first_stage;       // of enum cartoon_stage, after the layer's
    int edge_count;
    cartoon_faces_params solids, thin; // solids are visible from outside only
    cartoon_ink_params outlines;
    cartoon_shade_params shade;
    m4 found_by;      // the view of the current normal map, depth and ink
    int64_t found_in; // the frame that drew them, plus one; 0: none
    bool has_picture; // the picture of that view is there, too
    struct cartoon_rain rain;
    struct cartoon_water water;
};

extern const struct rg_proof cartoon_proof;

bool cartoon_open(struct rg_instance *instance);
void cartoon_close(struct rg_instance *instance);
bool cartoon_step(struct rg_instance *instance);
bool cartoon_draw(struct rg_instance *instance);

// Functions of scene/.

// Loads the diorama and adds its assets. The mesh becomes `positions`, `normals`, `indices`,
// `materials` and `palette`. Each drawing of the scene writes two images of the target's size.
// `normal_map`, RGBA16F, has the world's normal on the visible side and the material's number plus
// one, all 0 in the sky. `depth_map`, D32F, is 1 in the sky. Collisions with faces add `face_map`,
// RGBA8, the nearest face packed as in numbers.h; outlines add `edges` and `ink`, hatching
// `strokes`. Fills in the view of frame 0.
bool cartoon_scene_open(struct cartoon *c);
// Computes the view of a frame. False, and one logged line, where the camera cannot see.
bool cartoon_look(struct cartoon *c, int64_t frame);
// Whether a place is inside a solid of the mesh.
bool cartoon_is_inside(const struct rg_mesh *mesh, const float eye[3]);
// Draws the scene into the normal map, the depth and the ink, unless they hold this view already.
bool cartoon_scene_find(struct cartoon *c);
// The same, and then draws the styled scene onto the background, unless it is there already.
bool cartoon_scene_draw(struct cartoon *c);

// Adds the image `strokes`: RGBA8, CARTOON_LEVELS levels, tones 0 to 3 in the channels of its first
// layer, 3 to 6 in those of its second.
void cartoon_add_strokes(struct cartoon *c);
// Hands over each tone as a texture (core/techniques/technique.h).
bool cartoon_make_strokes(rg_take_texture *take, void *user);

#endif
