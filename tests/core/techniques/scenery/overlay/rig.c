#include "tests/core/techniques/scenery/overlay/rig.h"

#include <stdlib.h>

#include "core/scene/camera.h"
#include "kernels/dialect/rng.h"

struct picture picture_make(struct rg_device *device, enum rg_format format, float depth)
{
    static const uint32_t nothing[4] = {0};
    const struct rg_image_desc coloured = {format, WIDTH, HEIGHT, 1, 1};
    const struct rg_image_desc deep = {RG_D32F, WIDTH, HEIGHT, 1, 1};
    struct picture p = {WIDTH, HEIGHT, rg_image_create_with(device, &coloured, nothing, "c"),
                        rg_image_create_with(device, &deep, &depth, "d")};
    assert_true(p.colour && p.depth);
    return p;
}

void picture_free(struct picture *p)
{
    rg_image_destroy(p->colour);
    rg_image_destroy(p->depth);
}

float *picture_read(const struct picture *p)
{
    float *texels = malloc(WIDTH * HEIGHT * 4 * sizeof(float));
    assert_true(rg_image_read(p->colour, 0, 0, texels));
    return texels;
}

struct scenery_overlay *open_overlay(struct rg_device *device, struct rg_instance *instance)
{
    *instance = (struct rg_instance){.device = device};
    struct scenery_overlay *overlay = scenery_overlay_open(instance);
    assert_non_null(overlay);
    return overlay;
}

void close_overlay(struct scenery_overlay *overlay, struct rg_instance *instance)
{
    scenery_overlay_close(overlay);
    rg_stages_free(instance);
    rg_assets_free(instance);
}

void overlay_look_from(float near_plane, float to_clip[16])
{
    const struct rg_camera camera = {.position = {0, 2, 6},
                                     .up = {0, 1, 0},
                                     .angle_deg = 60,
                                     .near_plane = near_plane,
                                     .far_plane = 50};
    assert_true(rg_camera_matrix(&camera, (float)WIDTH / HEIGHT, to_clip));
}

void overlay_look(float to_clip[16])
{
    overlay_look_from(0.5f, to_clip);
}

float between(uint32_t item, uint32_t step, double low, double high)
{
    return (float)(low + (high - low) * (double)rg_uniform(rg_random(8, item, step, 4).x));
}
