// raster: the settings, parameters and host-side inputs of drawing itself as the thing measured.
#ifndef RG_CORE_TECHNIQUES_RASTER_RASTER_H
#define RG_CORE_TECHNIQUES_RASTER_RASTER_H

#include <stdint.h>

#include "core/techniques/params.h"
#include "kernels/raster/mesh_params.h"
#include "kernels/raster/quads_params.h"
#include "kernels/raster/show_params.h"
#include "kernels/raster/streaks_params.h"

enum raster_scene { RASTER_BILLBOARDS, RASTER_MESH, RASTER_TRIANGLES, RASTER_QUADS, RASTER_SCENES };
enum raster_format { RASTER_RGBA16F, RASTER_RGBA8, RASTER_RGBA32F };
enum { RASTER_VIEWS = 20 };

struct raster_settings {
    int scene, seed;
    double share;
    int count;
    // Draw state; in blend, depth and cull 0 leaves the choice to the scene.
    int blend, depth, cull, format;
    // billboards
    int billboards;
    double reach_m, air_width_m, air_height_m, view_angle_deg;
    double streak_radius_mm, streak_length_mm, fall_m_s, wind_m_s, step_s, opacity;
    // mesh and triangles
    char model[RG_PATH_SIZE];
    int faces, triangles, view, inside;
    double zoom, near_plane, shift_px, turn_deg;
    // quads
    int quads;
};

extern const struct rg_param_table raster_param_table;
extern const struct rg_proof raster_proof;

// A mesh in the form that raster_mesh draws.
struct raster_mesh {
    int vertex_count, face_count;
    float *positions;      // x, y, z of each vertex
    uint32_t *normals;     // mesh_normal_pack
    uint32_t *indices;     // three vertices of each face, counter-clockwise seen from outside
    float low[3], high[3]; // bounds
    double radius;         // of the ball around the bounds' middle, in halves of the longest side
    char name[160];
    uint64_t hash; // of a model's file; 0: no model
};

// Loads the settings' model, or makes the knot, a closed tube of `triangles` faces, rounded down to
// whole rings. Call raster_mesh_free in either case. False, with one logged line, on failure.
bool raster_mesh_load(const struct raster_settings *settings, struct raster_mesh *shape);
bool raster_mesh_knot(int triangles, struct raster_mesh *shape);
void raster_mesh_free(struct raster_mesh *shape);

// The quads' buffer, RASTER_QUAD_WORDS floats each; the caller frees it.
float *raster_quads_make(const struct raster_settings *settings);

// The parameters of the programs at a frame, for a target of width x height pixels. False, with one
// logged line, where the camera cannot see.
raster_streaks_params raster_streaks_at(const struct raster_settings *settings, int width,
                                        int height, int64_t frame);
bool raster_mesh_at(const struct raster_settings *settings, const struct raster_mesh *shape,
                    int width, int height, int64_t frame, raster_mesh_params *params);
raster_quads_params raster_quads_at(const struct raster_settings *settings, int width, int height,
                                    int64_t frame);

#endif
