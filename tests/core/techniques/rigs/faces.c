#include "tests/core/techniques/rigs/faces.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

struct faces faces_make(int vertex_count, int face_count)
{
    return (struct faces){
        .vertex_count = vertex_count,
        .face_count = face_count,
        .positions = calloc((size_t)vertex_count, 3 * sizeof(float)),
        .normals = calloc((size_t)vertex_count, sizeof(uint32_t)),
        .indices = calloc((size_t)face_count, 3 * sizeof(uint32_t)),
    };
}

void faces_free(struct faces *faces)
{
    free(faces->positions);
    free(faces->normals);
    free(faces->indices);
    *faces = (struct faces){0};
}

static struct rg_buf *upload(struct rg_device *device, const void *words, int count,
                             const char *name)
{
    struct rg_buf *buf = rg_buf_create_with(device, words, (int64_t)count * 4, name);
    assert_non_null(buf);
    return buf;
}

void faces_upload(struct rg_device *device, const struct faces *faces, struct faces_on *on)
{
    *on = (struct faces_on){
        .device = device,
        .face_count = faces->face_count,
        .raster = rg_pass_create(device, "raster_mesh"),
        .test = rg_pass_create(device, "test_faces"),
        .positions = upload(device, faces->positions, 3 * faces->vertex_count, "positions"),
        .normals = upload(device, faces->normals, faces->vertex_count, "normals"),
        .indices = upload(device, faces->indices, 3 * faces->face_count, "indices"),
    };
    assert_true(on->raster && on->test);
}

void faces_close(struct faces_on *on)
{
    rg_pass_destroy(on->raster);
    rg_pass_destroy(on->test);
    rg_buf_destroy(on->positions);
    rg_buf_destroy(on->normals);
    rg_buf_destroy(on->indices);
    *on = (struct faces_on){0};
}

static struct rg_image *target(struct rg_device *device, enum rg_format format, int width,
                               int height, const void *texel)
{
    const struct rg_image_desc desc = {format, width, height, 1, 1};
    struct rg_image *image = rg_image_create_with(device, &desc, texel, rg_format_name(format));
    assert_non_null(image);
    return image;
}

static struct rg_buf *make_samples(const struct faces_on *on)
{
    uint32_t *zeroes = calloc((size_t)on->face_count, sizeof(*zeroes));
    struct rg_buf *samples = upload(on->device, zeroes, on->face_count, "samples");
    free(zeroes);
    return samples;
}

struct faces_drawn faces_draw(const struct faces_on *on, struct rg_pass *program,
                              const raster_mesh_params *params, const struct faces_way *way)
{
    const uint32_t nothing[4] = {0};
    const float farthest = 1;
    struct rg_image *colour = target(on->device, way->format, way->width, way->height, nothing);
    struct rg_image *depth = target(on->device, RG_D32F, way->width, way->height, &farthest);
    struct rg_buf *samples = way->counted ? make_samples(on) : NULL;
    const struct rg_draw draw = {.colour = colour,
                                 .depth = way->depth == RG_DEPTH_OFF ? NULL : depth,
                                 .blend = way->blend,
                                 .depth_mode = way->depth,
                                 .cull = way->cull,
                                 .samples = samples};
    assert_true(rg_pass_run(
        program,
        &(struct rg_run){
            .params = params,
            .slots = {[1].buf = on->positions, [2].buf = on->normals, [3].buf = on->indices},
            .extent = {on->face_count, 1, 1},
            .draw = &draw}));
    const size_t pixels = (size_t)way->width * (size_t)way->height;
    struct faces_drawn drawn = {.width = way->width, .height = way->height};
    drawn.texel_words = rg_format_size(way->format) / 4;
    drawn.colour = malloc(pixels * (size_t)drawn.texel_words * 4);
    drawn.depth = malloc(pixels * sizeof(float));
    drawn.samples = calloc((size_t)on->face_count, sizeof(uint32_t));
    assert_true(rg_image_read(colour, 0, 0, drawn.colour) &&
                rg_image_read(depth, 0, 0, drawn.depth));
    assert_true(!samples || rg_buf_read(samples, 0, drawn.samples, (int64_t)on->face_count * 4));
    rg_image_destroy(colour);
    rg_image_destroy(depth);
    rg_buf_destroy(samples);
    return drawn;
}

void faces_drawn_free(struct faces_drawn *drawn)
{
    free(drawn->colour);
    free(drawn->depth);
    free(drawn->samples);
    *drawn = (struct faces_drawn){0};
}

float faces_value(const struct faces_drawn *drawn, int px, int py, int channel)
{
    float value;
    const size_t texel = (size_t)py * (size_t)drawn->width + (size_t)px;
    memcpy(&value, drawn->colour + 4 * texel + channel, sizeof(value));
    return value;
}

int *faces_layers(const struct faces_on *on, const raster_mesh_params *params, int width,
                  int height, enum rg_cull cull)
{
    raster_mesh_params white = *params;
    white.light_x = white.light_y = white.light_z = 0;
    white.ambient = 1;
    struct faces_drawn drawn = faces_draw(
        on, on->raster, &white,
        &(struct faces_way){width, height, RG_RGBA32F, RG_BLEND_ADD, RG_DEPTH_OFF, cull, false});
    int *layers = malloc((size_t)width * (size_t)height * sizeof(*layers));
    for (int py = 0; py < height; py++)
        for (int px = 0; px < width; px++)
            layers[py * width + px] = (int)faces_value(&drawn, px, py, 0);
    faces_drawn_free(&drawn);
    return layers;
}
