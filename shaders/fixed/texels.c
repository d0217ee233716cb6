// Textures, from a fixed sequence of numbers.
#include "shaders/fixed/fixed.h"

#include <string.h>

int rg_fixed_layers(const struct rg_fixed_state *state)
{
    return state->texture == RG_FIXED_CUBE    ? 6
           : state->texture == RG_FIXED_ARRAY ? RG_FIXED_TEXTURE_LAYERS
                                              : 1;
}

static bool is_compressed(const struct rg_fixed_state *state)
{
    return state->texels >= RG_FIXED_TEXELS_BC1;
}

int rg_fixed_levels(const struct rg_fixed_state *state)
{
    return is_compressed(state) ? 1 : RG_FIXED_LEVELS;
}

static size_t size_of(const struct rg_fixed_state *state, int level)
{
    const size_t px = RG_FIXED_TEXTURE_PX >> level, blocks = px / 4 * (px / 4);
    if (!is_compressed(state))
        return px * px * 4;
    return blocks * (state->texels == RG_FIXED_TEXELS_BC3 ? 16 : 8);
}

size_t rg_fixed_make_texels(const struct rg_fixed_state *state, int layer, int level,
                            uint8_t *texels)
{
    static const uint8_t constant[] = {201, 118, 37, 164};
    const size_t size = size_of(state, level);
    uint32_t seed = (uint32_t)(100 + layer * 16 + level);
    for (size_t i = 0; i < size; i++) {
        seed = seed * 1664525u + 1013904223u;
        texels[i] = state->plain == RG_FIXED_CONSTANT   ? constant[i % 4]
                    : state->plain == RG_FIXED_EXTREMES ? (uint8_t)(seed >> 31 ? 255 : 0)
                                                        : (uint8_t)(seed >> 24);
    }
    for (size_t i = 0; state->texels == RG_FIXED_TEXELS_D32F && i < size / 4; i++) {
        const float depth = (float)texels[4 * i] / 256;
        memcpy(&texels[4 * i], &depth, sizeof(depth));
    }
    if (state->flip && layer == 0 && level == 0)
        texels[(state->flip - 1) / 8] ^= (uint8_t)(1 << (state->flip - 1) % 8);
    return size;
}
