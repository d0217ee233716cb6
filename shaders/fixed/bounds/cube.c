// Faces of a cube map, and texels across their edges (OpenGL, Cube Map Texture Selection and
// Seamless Cube Map Filtering; Vulkan, Cube Map Face Selection and Cube Map Edge Handling).
#include "shaders/fixed/bounds/scene.h"

enum { PX = RG_FIXED_TEXTURE_PX };

// Of each face: its axis and where it points, and the axes of both coordinates with their signs.
static const struct {
    int axis, sign, s, s_sign, t, t_sign;
} faces[RG_SCENE_FACES] = {{0, 1, 2, -1, 1, -1}, {0, -1, 2, 1, 1, -1}, {1, 1, 0, 1, 2, 1},
                           {1, -1, 0, 1, 2, -1}, {2, 1, 0, 1, 1, -1},  {2, -1, 0, -1, 1, -1}};

static struct rg_span to_face(struct rg_span coordinate, struct rg_span major)
{
    const struct rg_span inverse = {1 / major.high, 1 / major.low};
    return rg_span_clamp(
        rg_span_add(rg_span_scale(rg_span_times(coordinate, inverse), 0.5), rg_span_at(0.5)), 0, 1);
}

bool rg_cube_place(const struct rg_span direction[3], int face, struct rg_span *u,
                   struct rg_span *v)
{
    const struct rg_span s = rg_span_scale(direction[faces[face].s], faces[face].s_sign);
    const struct rg_span t = rg_span_scale(direction[faces[face].t], faces[face].t_sign);
    struct rg_span major = rg_span_scale(direction[faces[face].axis], faces[face].sign);
    // The axis is the greatest of the three.
    major.low = fmax(major.low, fmax(rg_span_absolute(s).low, rg_span_absolute(t).low));
    if (major.low > major.high || major.high <= 0)
        return false;
    major.low = fmax(major.low, 1e-6);
    *u = to_face(s, major);
    *v = to_face(t, major);
    return true;
}

// The texel beyond one edge of a face: half a texel down on the face beside it.
static const struct rg_span *beside(const struct rg_texture *texture, int face, int x, int y)
{
    double place[3], axis = 0;
    const double s = fmin(fmax((x + 0.5) * 2 / PX - 1, -1), 1);
    const double t = fmin(fmax((y + 0.5) * 2 / PX - 1, -1), 1);
    place[faces[face].axis] = faces[face].sign * (1 - 1.0 / PX);
    place[faces[face].s] = faces[face].s_sign * s;
    place[faces[face].t] = faces[face].t_sign * t;
    int next = 0;
    for (int i = 0; i < RG_SCENE_FACES; i++)
        if (faces[i].sign * place[faces[i].axis] > axis) {
            axis = faces[i].sign * place[faces[i].axis];
            next = i;
        }
    const int column = (int)floor((faces[next].s_sign * place[faces[next].s] + 1) * PX / 2);
    const int row = (int)floor((faces[next].t_sign * place[faces[next].t] + 1) * PX / 2);
    return texture->texels[next][0][row * PX + column];
}

static int clamp(int i)
{
    return i < 0 ? 0 : i >= PX ? PX - 1 : i;
}

const struct rg_span *rg_cube_texel(const struct rg_texture *texture, int face, int x, int y)
{
    const bool in_x = clamp(x) == x, in_y = clamp(y) == y;
    if (in_x && in_y)
        return texture->texels[face][0][y * PX + x];
    if (in_x || in_y)
        return beside(texture, face, x, y);
    return texture->corners[face][(x > 0) + 2 * (y > 0)];
}

// At a corner three faces meet: a device takes one of their texels, or a mean.
void rg_cube_corners(struct rg_texture *texture)
{
    for (int face = 0; face < RG_SCENE_FACES; face++)
        for (int i = 0; i < 4; i++) {
            const int x = i & 1 ? PX : -1, y = i & 2 ? PX : -1;
            const struct rg_span *around[] = {rg_cube_texel(texture, face, clamp(x), clamp(y)),
                                              rg_cube_texel(texture, face, x, clamp(y)),
                                              rg_cube_texel(texture, face, clamp(x), y)};
            for (int c = 0; c < 4; c++)
                texture->corners[face][i][c] =
                    rg_span_join(rg_span_join(around[0][c], around[1][c]), around[2][c]);
        }
}
