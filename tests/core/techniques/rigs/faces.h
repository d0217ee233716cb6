// Meshes on a device, drawn in the ways that tests need.
#ifndef RG_TESTS_CORE_TECHNIQUES_RIGS_FACES_H
#define RG_TESTS_CORE_TECHNIQUES_RIGS_FACES_H

#include <stdbool.h>
#include <stdint.h>

#include "core/device/device.h"
#include "kernels/raster/mesh_params.h"

// The caller's arrays, in the layout that kernels/dialect/mesh/mesh.h reads.
struct faces {
    int vertex_count, face_count;
    float *positions;
    uint32_t *normals, *indices;
};

// Zeroed arrays for this many; freed by faces_free.
struct faces faces_make(int vertex_count, int face_count);
void faces_free(struct faces *faces);

// A mesh on a device, with both programs that draw it.
struct faces_on {
    struct rg_device *device;
    int face_count;
    struct rg_pass *raster, *test; // raster_mesh; test_faces
    struct rg_buf *positions, *normals, *indices;
};
void faces_upload(struct rg_device *device, const struct faces *faces, struct faces_on *on);
void faces_close(struct faces_on *on);

struct faces_way {
    int width, height;
    enum rg_format format; // the colour's format
    enum rg_blend blend;
    enum rg_depth_mode depth; // the target's depth begins as 1
    enum rg_cull cull;
    bool counted; // counts the samples of each face
};

// The results of a draw: words of the colour's format, depth and samples. Freed by
// faces_drawn_free.
struct faces_drawn {
    int width, height, texel_words;
    uint32_t *colour;
    float *depth;
    uint32_t *samples;
};
struct faces_drawn faces_draw(const struct faces_on *on, struct rg_pass *program,
                              const raster_mesh_params *params, const struct faces_way *way);
void faces_drawn_free(struct faces_drawn *drawn);

// A value of an RGBA32F colour.
float faces_value(const struct faces_drawn *drawn, int px, int py, int channel);

// How often each pixel is covered: draws `faces` at once in RGBA32F, adding 1 each. `params` needs
// only its matrix. Returns width x height counts, which the caller frees.
int *faces_layers(const struct faces_on *on, const raster_mesh_params *params, int width,
                  int height, enum rg_cull cull);

#endif
