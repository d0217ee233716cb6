#include "core/scene/environment/cube.h"

#include "core/base/alloc.h"
#include "kernels/dialect/image/cube.h"

void rg_cube_direction(int face, int x, int y, int size, double direction[3])
{
    const double s = 2 * (x + 0.5) / size - 1;
    const double t = 2 * (y + 0.5) / size - 1;
    const double faces[6][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    for (int i = 0; i < 3; i++)
        direction[i] = faces[face][i];
}

struct rg_environment *rg_environment_create(int size)
{
    const size_t texels = (size_t)(size + 2) * (size_t)(size + 2);
    struct rg_environment *environment = rg_alloc(1, sizeof(*environment), "environment");
    if (!environment)
        return NULL;
    environment->size = size;
    environment->light = rg_alloc(texels, 6 * 3 * sizeof(float), "environment");
    if (environment->light)
        return environment;
    rg_environment_destroy(environment);
    return NULL;
}

void rg_environment_destroy(struct rg_environment *environment)
{
    if (!environment)
        return;
    free(environment->light);
    free(environment);
}

float *rg_environment_texel(const struct rg_environment *environment, int face, int x, int y)
{
    const size_t side = (size_t)environment->size + 2;
    return environment->light +
           (((size_t)face * side + (size_t)(y + 1)) * side + (size_t)(x + 1)) * 3;
}

static void close_texel(struct rg_environment *environment, int face, int x, int y)
{
    const int size = environment->size;
    double d[3];
    rg_cube_direction(face, x, y, size, d);
    cube_point c = cube_locate(v3_make((float)d[0], (float)d[1], (float)d[2]), size);
    const float *from =
        rg_environment_texel(environment, c.face, cube_texel(c.x, size), cube_texel(c.y, size));
    float *to = rg_environment_texel(environment, face, x, y);
    for (int i = 0; i < 3; i++)
        to[i] = from[i];
}

void rg_environment_close_borders(struct rg_environment *environment)
{
    const int size = environment->size;
    for (int face = 0; face < 6; face++) {
        for (int i = -1; i <= size; i++) {
            close_texel(environment, face, i, -1);
            close_texel(environment, face, i, size);
            close_texel(environment, face, -1, i);
            close_texel(environment, face, size, i);
        }
    }
}

void rg_environment_fill(struct rg_environment *environment, rg_light_fn fn, const void *user)
{
    const int size = environment->size;
#pragma omp parallel for collapse(2) schedule(static)
    for (int face = 0; face < 6; face++) {
        for (int y = -1; y <= size; y++) {
            for (int x = -1; x <= size; x++) {
                double direction[3], light[3];
                rg_cube_direction(face, x, y, size, direction);
                fn(direction, user, light);
                for (int i = 0; i < 3; i++)
                    rg_environment_texel(environment, face, x, y)[i] = (float)light[i];
            }
        }
    }
}

struct rg_environment *rg_environment_halve(const struct rg_environment *environment)
{
    const int size = environment->size / 2;
    struct rg_environment *half = rg_environment_create(size);
    if (!half)
        return NULL;
    for (int face = 0; face < 6; face++) {
        for (int y = 0; y < size; y++) {
            for (int x = 0; x < size; x++) {
                const float *top = rg_environment_texel(environment, face, 2 * x, 2 * y);
                const float *bottom = rg_environment_texel(environment, face, 2 * x, 2 * y + 1);
                float *texel = rg_environment_texel(half, face, x, y);
                for (int i = 0; i < 3; i++)
                    texel[i] = 0.25f * ((top[i] + top[i + 3]) + (bottom[i] + bottom[i + 3]));
            }
        }
    }
    rg_environment_close_borders(half);
    return half;
}

// Packs an unsigned float with 5 bits of exponent: drops `dropped` bits of the mantissa, and rounds
// up as `noise`, of as many bits, decides. Subnormal results become 0.
static uint32_t pack_unsigned_float(float value, int dropped, uint32_t noise)
{
    const float smallest = 6.103515625e-5f, largest = 64512.0f;
    if (!(value >= smallest))
        return 0;
    uint32_t bits = rg_float_bits(value < largest ? value : largest);
    uint32_t limit = (31u << (23 - dropped)) - 1;
    uint32_t packed = (bits - (112u << 23) + (noise & ((1u << dropped) - 1))) >> dropped;
    return packed < limit ? packed : limit;
}

static uint32_t pack_rg11b10f(const float light[3], uint32_t noise)
{
    return pack_unsigned_float(light[0], 17, noise) |
           pack_unsigned_float(light[1], 17, noise) << 11 |
           pack_unsigned_float(light[2], 18, noise) << 22;
}

// The first of the two texels of a face of `size` texels that texel `i` of `size_px` interpolates,
// and the weight of the second. The first and last texel lie on the face's edges.
static int source_of(int i, int size_px, int size, float *weight)
{
    const double along = size_px > 1 ? (double)i / (size_px - 1) : 0.5;
    const double at = along * size - 0.5;
    const int first = (int)(at + 1) - 1;
    *weight = (float)(at - first);
    return first;
}

static void pack_face(const struct rg_environment *environment, int face, int size_px,
                      uint32_t *texels)
{
    for (int y = 0; y < size_px; y++) {
        float fx, fy;
        const int sy = source_of(y, size_px, environment->size, &fy);
        for (int x = 0; x < size_px; x++) {
            const int sx = source_of(x, size_px, environment->size, &fx);
            const float *top = rg_environment_texel(environment, face, sx, sy);
            const float *bottom = rg_environment_texel(environment, face, sx, sy + 1);
            float light[3];
            for (int i = 0; i < 3; i++) {
                float above = top[i] + (top[i + 3] - top[i]) * fx;
                float below = bottom[i] + (bottom[i + 3] - bottom[i]) * fx;
                light[i] = above + (below - above) * fy;
            }
            // Cheap noise from a hash.
            uint32_t noise = ((uint32_t)x * 0x9e3779b9u) ^ ((uint32_t)(y + 7) * 0x85ebca6bu);
            noise = (noise ^ noise >> 15) * 0x2c1b3c6du;
            texels[(size_t)y * (size_t)size_px + (size_t)x] = pack_rg11b10f(light, noise >> 14);
        }
    }
}

bool rg_environment_halve_to(const struct rg_environment *environment, int size_px,
                             struct rg_environment **halved)
{
    while ((*halved ? *halved : environment)->size >= 2 * size_px) {
        struct rg_environment *smaller = rg_environment_halve(*halved ? *halved : environment);
        rg_environment_destroy(*halved);
        *halved = smaller;
        if (!smaller)
            return false;
    }
    return true;
}

bool rg_environment_pack(const struct rg_environment *environment, int size_px, uint32_t *texels)
{
    // Bilinear filtering alone would skip texels of a much larger map.
    struct rg_environment *halved = NULL;
    if (!rg_environment_halve_to(environment, size_px, &halved))
        return false;
    const size_t face_texels = (size_t)size_px * (size_t)size_px;
    for (int face = 0; face < 6; face++)
        pack_face(halved ? halved : environment, face, size_px,
                  texels + (size_t)face * face_texels);
    rg_environment_destroy(halved);
    return true;
}
