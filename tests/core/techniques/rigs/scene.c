#include "core/base/log.h"
#include "tests/core/techniques/rigs/scene.h"

#include "core/base/outcome.h"
#include "tests/tools/instance.h"

void mesh_scene_set(struct mesh_scene *scene, const char *assignments)
{
    struct raster_settings *settings = settings_of("raster", "", assignments);
    scene->settings = *settings;
    free(settings);
}

struct mesh_scene mesh_scene_open(const char *assignments)
{
    struct mesh_scene scene;
    mesh_scene_set(&scene, assignments);
    assert_true(scene.settings.scene == RASTER_TRIANGLES
                    ? raster_mesh_knot(scene.settings.triangles, &scene.shape)
                    : raster_mesh_load(&scene.settings, &scene.shape));
    scene.faces = (struct faces){scene.shape.vertex_count, scene.shape.face_count,
                                 scene.shape.positions, scene.shape.normals, scene.shape.indices};
    return scene;
}

void mesh_scene_close(struct mesh_scene *scene)
{
    raster_mesh_free(&scene->shape);
}

raster_mesh_params mesh_scene_look(const struct mesh_scene *scene, int width, int height)
{
    raster_mesh_params p;
    assert_true(raster_mesh_at(&scene->settings, &scene->shape, width, height, 0, &p));
    return p;
}

enum rg_cull mesh_scene_cull(const struct mesh_scene *scene)
{
    return scene->settings.inside ? RG_CULL_FRONT : RG_CULL_BACK;
}

static const char *device_name = "cpu:reference";

static int open_device(void **state)
{
    *state = rg_device_open(device_name);
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

int raster_tests_run(int argc, char **argv, const struct CMUnitTest *tests, size_t count)
{
    enum { UNSUPPORTED = 77 };
    if (argc > 1)
        device_name = argv[1];
    struct rg_device *device = rg_device_open(device_name);
    if (!device)
        return rg_failure_take().outcome == RG_UNSUPPORTED ? UNSUPPORTED : 1;
    if (!rg_device_close(device))
        return 1;
    return _cmocka_run_group_tests(device_name, tests, count, open_device, close_device);
}
