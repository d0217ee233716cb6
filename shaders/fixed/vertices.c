// Meshes, from a fixed sequence of numbers, so that every device gets the same bits.
#include "shaders/fixed/fixed.h"

#include <string.h>

// Numerical Recipes' generator: the upper bits are the better ones.
static uint32_t next(uint32_t *seed)
{
    return *seed = *seed * 1664525u + 1013904223u;
}

// A multiple of 1/256 from `low` to below `high`, which are multiples themselves.
static float within(uint32_t *seed, int low, int high)
{
    const int steps = (high - low) * 256;
    return (float)low + (float)(int)((next(seed) >> 8) % (uint32_t)steps) / 256;
}

static void colour(uint32_t *seed, struct rg_fixed_vertex *vertex)
{
    for (int c = 0; c < 4; c++)
        vertex->colour[c] = within(seed, 0, 1);
}

// Two triangles with these corners, each {x, y, w, u, v, layer}.
static void quadrangle(const float corners[4][6], struct rg_fixed_vertices *made)
{
    static const int order[] = {0, 1, 2, 2, 1, 3};
    struct rg_fixed_vertex all[4];
    uint32_t seed = 4;
    for (int i = 0; i < 4; i++) {
        const float *c = corners[i], w = c[2];
        all[i] =
            (struct rg_fixed_vertex){{c[0] * w, c[1] * w, w / 2, w}, {c[3], c[4], c[5], 1}, {0}};
        colour(&seed, &all[i]);
    }
    for (int i = 0; i < 6; i++)
        made->vertices[i] = all[order[i]];
    made->count = 6;
}

static const float pane[4][6] = {{-0.90625f, -0.8125f, 1, 0, 0, 0},
                                 {0.84375f, -0.9375f, 1, 1.25f, 0.125f, 4},
                                 {-0.78125f, 0.875f, 1, 0.0625f, 1.25f, 0},
                                 {0.90625f, 0.8125f, 1, 1.25f, 1.25f, 4}};
static const float square[4][6] = {
    {-1, -1, 1, 0, 0, 0}, {1, -1, 1, 2, 0, 0}, {-1, 1, 1, 0, 2, 0}, {1, 1, 1, 2, 2, 0}};
static const float ground[4][6] = {{-0.96875f, -0.9375f, 1, 0, 0, 0},
                                   {0.9375f, -0.96875f, 1, 2, 0.25f, 4},
                                   {-0.8125f, 0.90625f, 8, 0.125f, 6, 0},
                                   {0.875f, 0.9375f, 8, 2, 5.5f, 4}};

// Triangles of any place, size and depth; every third is in perspective.
static void shards(struct rg_fixed_vertices *made)
{
    uint32_t seed = 11;
    made->count = RG_FIXED_MAX_VERTICES;
    for (int i = 0; i < made->count; i++) {
        struct rg_fixed_vertex *vertex = &made->vertices[i];
        const float w = i / 3 % 3 ? 1 : 1 + within(&seed, 0, 1);
        const float z = within(&seed, 0, 1);
        vertex->position[0] = within(&seed, -1, 1) * w;
        vertex->position[1] = within(&seed, -1, 1) * w;
        vertex->position[2] = z * w;
        vertex->position[3] = w;
        vertex->at[3] = 1;
        for (int c = 0; c < 3; c++)
            vertex->at[c] = within(&seed, 0, 2);
        colour(&seed, vertex);
    }
}

// Every other one reaches from within the target to very far; the others have corners before the
// near plane and behind the eye.
static void beyond(struct rg_fixed_vertices *made)
{
    uint32_t seed = 5;
    made->count = 48;
    for (int i = 0; i < made->count; i++) {
        struct rg_fixed_vertex *vertex = &made->vertices[i];
        const bool is_vast = i / 3 % 2;
        const float reach = is_vast && i % 3 ? 2000 : 1;
        vertex->position[0] = within(&seed, -1, 1) * reach;
        vertex->position[1] = within(&seed, -1, 1) * reach;
        vertex->position[2] = is_vast ? within(&seed, 0, 1) : within(&seed, -1, 2);
        vertex->position[3] = is_vast ? 1 : within(&seed, -1, 2) + 0.5f;
        vertex->at[3] = 1;
        colour(&seed, vertex);
    }
}

const int rg_fixed_format_offsets[RG_FIXED_FORMATS] = {0, 4, 8, 16, 24, 4};

// Any bytes, but for halves, which stay below 2 and are no NaN.
static void fill_formats(struct rg_fixed_vertices *made, int flip)
{
    uint32_t seed = 77;
    for (size_t i = 0; i < sizeof(made->formats); i++)
        made->formats[i] = (uint8_t)(next(&seed) >> 24);
    for (int i = 0; i < RG_FIXED_MAX_VERTICES; i++)
        for (int c = 0; c < 4; c++)
            made->formats[i * RG_FIXED_FORMATS_STRIDE + 25 + 2 * c] &= 0x3f;
    // The last vertex's triangle lies above all others.
    uint8_t *last = &made->formats[(RG_FIXED_MAX_VERTICES - 1) * RG_FIXED_FORMATS_STRIDE];
    if (flip)
        last[(flip - 1) / 8] ^= (uint8_t)(1 << (flip - 1) % 8);
}

// Strips of five vertices, each from three behind the one before.
static void fill_indices(struct rg_fixed_vertices *made)
{
    for (int first = 0; first + 5 <= 60; first += 3) {
        for (int i = 0; i < 5; i++)
            made->indices[made->index_count++] = (uint16_t)(first + i);
        made->indices[made->index_count++] = 0xffff;
    }
}

static void make_mesh(int mesh, struct rg_fixed_vertices *made)
{
    if (mesh == RG_FIXED_SHARDS)
        shards(made);
    else if (mesh == RG_FIXED_BEYOND)
        beyond(made);
    else
        quadrangle(mesh == RG_FIXED_PANE ? pane : mesh == RG_FIXED_SQUARE ? square : ground, made);
}

void rg_fixed_make_vertices(const struct rg_fixed_state *state, struct rg_fixed_vertices *made)
{
    memset(made, 0, sizeof(*made));
    make_mesh(state->mesh, made);
    for (int i = 0; state->plain && i < made->count; i++)
        memcpy(made->vertices[i].colour, made->vertices[i / 3 * 3].colour,
               sizeof(made->vertices[i].colour));
    fill_formats(made, state->texels ? 0 : state->flip);
    fill_indices(made);
    for (int i = 1; i < RG_FIXED_INSTANCES; i++) {
        made->offsets[i][0] = (float)i / 16;
        made->offsets[i][1] = (float)i / -8;
    }
}

struct rg_fixed_arguments rg_fixed_arguments(const struct rg_fixed_state *state,
                                             const struct rg_fixed_vertices *vertices)
{
    return (struct rg_fixed_arguments){
        .count = (uint32_t)(state->indexed ? vertices->index_count : vertices->count),
        .instances = 1 + (uint32_t)state->more_instances,
        .base_vertex = state->base_vertex,
        .first_instance = (uint32_t)state->first_instance,
    };
}

void rg_fixed_viewport(const struct rg_fixed_state *state, int i, int viewport[4])
{
    const int n = state->viewports ? i : 0;
    viewport[0] = 2 * n;
    viewport[1] = 3 * n;
    viewport[2] = RG_FIXED_PX - 4 * n;
    viewport[3] = RG_FIXED_PX - 5 * n;
}

void rg_fixed_scissor(const struct rg_fixed_state *state, int i, int scissor[4])
{
    const int inset = state->scissor + (state->viewports ? i : 0);
    scissor[0] = scissor[1] = inset;
    scissor[2] = scissor[3] = RG_FIXED_PX - 2 * inset;
}

const float rg_fixed_before[4] = {0.25f, 0.5f, 0.75f, 0.5f};
