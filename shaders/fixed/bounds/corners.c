// Vertices in double, and the primitives that they make.
#include <string.h>

#include "shaders/fixed/bounds/scene.h"

// --- vertices (shaders/fixed/draw.vert) ---

static double half(const uint8_t *bytes)
{
    const int bits = bytes[0] | bytes[1] << 8, exponent = bits >> 10 & 31;
    const double mantissa = bits & 1023;
    const double value =
        exponent ? ldexp(1024 + mantissa, exponent - 25) : ldexp(mantissa, exponent - 24);
    return bits & 0x8000 ? -value : value;
}

// A signed integer of so many bits, normalized.
static double normal(int code, int bits)
{
    const double most = (1 << (bits - 1)) - 1;
    return fmax((code >= 1 << (bits - 1) ? code - (1 << bits) : code) / most, -1);
}

static double formats(const uint8_t *bytes, int c)
{
    const uint8_t *at[RG_FIXED_FORMATS];
    uint32_t tens;
    for (int i = 0; i < RG_FIXED_FORMATS; i++)
        at[i] = bytes + rg_fixed_format_offsets[i];
    memcpy(&tens, at[5], sizeof(tens));
    const int word = at[2][2 * c] | at[2][2 * c + 1] << 8;
    const int signed_word = at[3][2 * c] | at[3][2 * c + 1] << 8;
    const double ten = c < 3 ? (tens >> 10 * c & 1023) / 1023.0 : (tens >> 30) / 3.0;
    const double sum = at[0][c] / 255.0 + 0.5 * normal(at[1][c], 8) + 2 * word / 65535.0 +
                       normal(signed_word, 16) + 0.25 * half(at[4] + (ptrdiff_t)2 * c) + ten;
    return sum * 0.125 + 0.25;
}

static struct rg_corner shade(const struct rg_scene *scene, int index, int instance)
{
    const struct rg_fixed_state *state = scene->state;
    const struct rg_fixed_vertex *vertex = &scene->vertices.vertices[index];
    const float *offset = scene->vertices.offsets[instance];
    struct rg_corner corner = {.cut = 1};
    for (int c = 0; c < 4; c++) {
        corner.place[c] = (double)vertex->position[c] + offset[c];
        corner.at[c] = vertex->at[c] + (c < 3 ? state->shift / 4096.0 : 0);
        corner.colour[c] =
            state->vertex == RG_FIXED_VERTEX_FORMATS
                ? formats(&scene->vertices.formats[index * RG_FIXED_FORMATS_STRIDE], c)
                : vertex->colour[c];
    }
    for (int c = 0; c < 2; c++)
        corner.place[c] += state->nudge / 8192.0 * corner.place[3];
    if (state->vertex == RG_FIXED_VERTEX_CLIPPED)
        corner.cut = corner.place[0] + 0.4375 * corner.place[1] + state->value / 256.0;
    return corner;
}

// --- the geometry stage (shaders/fixed/draw.geom) ---

static void use_beside(struct rg_scene *scene, const struct rg_primitive *primitive,
                       rg_primitive_use *use)
{
    struct rg_primitive beside = *primitive;
    use(scene, primitive);
    for (int i = 0; i < 3; i++) {
        struct rg_corner *corner = &beside.corners[i];
        *corner = primitive->corners[2 - i];
        corner->place[0] += scene->state->value / 256.0;
        corner->place[1] += 0.125;
        for (int c = 0; c < 4; c++)
            corner->colour[c] *= 0.5;
    }
    use(scene, &beside);
}

static void use_everywhere(struct rg_scene *scene, const struct rg_primitive *primitive,
                           rg_primitive_use *use)
{
    for (int layer = 0; layer < RG_FIXED_LAYERS; layer++) {
        struct rg_primitive moved = *primitive;
        moved.layer = layer;
        for (int i = 0; i < 3; i++)
            moved.corners[i].place[0] += scene->state->value * layer / 256.0;
        use(scene, &moved);
    }
}

static void pass_on(struct rg_scene *scene, const struct rg_primitive *primitive,
                    rg_primitive_use *use)
{
    if (scene->state->between == RG_FIXED_GEOMETRY_STAGE)
        use_beside(scene, primitive, use);
    else if (scene->state->between == RG_FIXED_LAYER_STAGE)
        use_everywhere(scene, primitive, use);
    else
        use(scene, primitive);
}

// --- assembly ---

static void assemble(struct rg_scene *scene, const int *indices, int count, int instance,
                     rg_primitive_use *use)
{
    const bool last = scene->state->provokes_last;
    struct rg_primitive primitive = {.count = count, .provoking = last ? count - 1 : 0};
    for (int i = 0; i < count; i++)
        primitive.corners[i] = shade(scene, indices[i], instance);
    pass_on(scene, &primitive, use);
}

// Every other triangle of a strip begins with its first and third vertex.
static void assemble_strip(struct rg_scene *scene, const int *indices, int count, int instance,
                           rg_primitive_use *use)
{
    for (int i = 0; i + 3 <= count; i++) {
        const int turned = i % 2;
        const int triangle[] = {indices[i], indices[i + 1 + turned], indices[i + 2 - turned]};
        assemble(scene, triangle, 3, instance, use);
    }
}

static void assemble_run(struct rg_scene *scene, const int *indices, int count, int instance,
                         rg_primitive_use *use)
{
    static const int corners[] = {[RG_FIXED_TRIANGLES] = 3,
                                  [RG_FIXED_LINES] = 2,
                                  [RG_FIXED_POINTS] = 1,
                                  [RG_FIXED_PATCHES] = 3};
    const int each = corners[scene->state->topology];
    if (scene->state->topology == RG_FIXED_STRIP)
        assemble_strip(scene, indices, count, instance, use);
    else
        for (int i = 0; i + each <= count; i += each)
            assemble(scene, indices + i, each, instance, use);
}

void rg_scene_assemble(struct rg_scene *scene, rg_primitive_use *use)
{
    const struct rg_fixed_state *state = scene->state;
    const struct rg_fixed_arguments a = rg_fixed_arguments(state, &scene->vertices);
    for (int instance = 0; instance < (int)a.instances; instance++) {
        int run[RG_FIXED_MAX_INDICES], count = 0;
        for (int i = 0; i < (int)a.count; i++) {
            const int index = state->indexed ? scene->vertices.indices[i] : i;
            if (state->indexed && index == 0xffff) {
                assemble_run(scene, run, count, instance + state->first_instance, use);
                count = 0;
            } else {
                run[count++] = index + (state->indexed ? a.base_vertex : 0);
            }
        }
        assemble_run(scene, run, count, instance + state->first_instance, use);
    }
}
