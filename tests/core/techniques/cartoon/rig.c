#include "tests/core/techniques/cartoon/rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/image/format.h"
#include "tests/tools/instance.h"

struct cartoon *rig_draw(struct rg_device *device, const char *assignments, int width, int height)
{
    struct rg_instance *instance = instance_of(device, "cartoon", "", assignments, width, height);
    assert_true(instance->technique->draw(instance));
    return (struct cartoon *)instance;
}

void rig_close(struct cartoon *c)
{
    rg_instance_close(&c->base);
}

float *rig_texels(struct rg_image *image)
{
    const struct rg_image_desc *d = &image->desc;
    const size_t count = (size_t)d->width * (size_t)d->height;
    assert_true(d->format == RG_RGBA16F || d->format == RG_D32F);
    float *texels = malloc(4 * count * sizeof(*texels));
    uint16_t *halves = malloc(4 * count * sizeof(*halves));
    assert_true(texels && halves);
    assert_true(rg_image_read(image, 0, 0, d->format == RG_D32F ? (void *)texels : halves));
    for (size_t i = 0; d->format == RG_RGBA16F && i < 4 * count; i++)
        texels[i] = rg_unpack_half(halves[i]);
    free(halves);
    return texels;
}

float *rig_asset(struct cartoon *c, const char *name)
{
    const struct rg_asset *asset = rg_asset_find(&c->base, name);
    assert_non_null(asset);
    return rig_texels(asset->image);
}

static struct vec scaled(const double v[3], double s)
{
    return (struct vec){v[0] * s, v[1] * s, v[2] * s};
}

struct scene_oracle rig_oracle(const struct cartoon *c)
{
    const struct rg_mesh *mesh = c->diorama->mesh;
    const struct rg_camera *camera = &c->view.camera;
    const struct rg_image_desc *target = &c->base.target->desc;
    const double half = tan((double)camera->angle_deg / 360 * M_PI);
    double ahead[3], up[3] = {0, 1, 0}, right[3], length = 0;
    for (int i = 0; i < 3; i++) {
        ahead[i] = (double)camera->target[i] - (double)camera->position[i];
        length += ahead[i] * ahead[i];
    }
    for (int i = 0; i < 3; i++)
        ahead[i] /= sqrt(length);
    length = hypot(ahead[0], ahead[2]);
    right[0] = -ahead[2] / length;
    right[1] = 0;
    right[2] = ahead[0] / length;
    for (int i = 0; i < 3; i++) // the product right x ahead
        up[i] = right[(i + 1) % 3] * ahead[(i + 2) % 3] - right[(i + 2) % 3] * ahead[(i + 1) % 3];
    return (struct scene_oracle){
        .face_count = mesh->face_count,
        .positions = mesh->positions,
        .normals = mesh->normals,
        .indices = mesh->indices,
        .eye = {(double)camera->position[0], (double)camera->position[1],
                (double)camera->position[2]},
        .ahead = scaled(ahead, 1),
        .right = scaled(right, half * target->width / target->height),
        .down = scaled(up, -half),
        .width = target->width,
        .height = target->height,
        .near_m = (double)camera->near_plane,
        .far_m = (double)camera->far_plane,
    };
}

int rig_run(int argc, char **argv, const struct CMUnitTest *tests, size_t count)
{
    struct rg_device *device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    if (!device)
        return 77;
    struct CMUnitTest *bound = malloc(count * sizeof(*bound));
    if (!bound)
        return 1;
    memcpy(bound, tests, count * sizeof(*bound));
    for (size_t i = 0; i < count; i++)
        bound[i].initial_state = device;
    const int failed = _cmocka_run_group_tests("cartoon", bound, count, NULL, NULL);
    free(bound);
    return rg_device_close(device) ? failed : 1;
}
