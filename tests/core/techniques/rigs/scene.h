// Scenes of the technique raster, for tests that draw the meshes themselves.
#ifndef RG_TESTS_CORE_TECHNIQUES_RIGS_SCENE_H
#define RG_TESTS_CORE_TECHNIQUES_RIGS_SCENE_H

#include "core/techniques/raster/raster.h"
#include "tests/core/techniques/rigs/faces.h"

struct mesh_scene {
    struct raster_settings settings;
    struct raster_mesh shape;
    struct faces faces; // the shape's arrays
};

// The mesh of these "key=value key=value" over the defaults; mesh_scene_close frees it.
struct mesh_scene mesh_scene_open(const char *assignments);
void mesh_scene_close(struct mesh_scene *scene);
// Sets other settings for the same mesh.
void mesh_scene_set(struct mesh_scene *scene, const char *assignments);

// The technique's view in the first frame, and the faces that it culls.
raster_mesh_params mesh_scene_look(const struct mesh_scene *scene, int width, int height);
enum rg_cull mesh_scene_cull(const struct mesh_scene *scene);

// Opens the device named in argv and runs the tests on it, each with the device as *state. Returns
// main's status: 77 if there is no such device.
struct CMUnitTest;
int raster_tests_run(int argc, char **argv, const struct CMUnitTest *tests, size_t count);

#endif
