#include "core/scene/city/paint/ground.h"

static const struct paint white_line = {0.80f, 0.80f, 0.77f, 0};
static const struct paint yellow_line = {0.82f, 0.66f, 0.22f, 0};

static struct paint grey(float v)
{
    return (struct paint){v, v, v, 0};
}

// Tar with stones in it, patches and cracks.
static struct paint asphalt(const struct spot *s)
{
    const float cloud = paint_cloud(s, 0), fine = paint_fine(s);
    const float crack = rg_abs(paint_cloud(s, 3) - 0.5f) < 0.004f ? 0.75f : 1;
    const float v = (0.26f + 0.12f * cloud + 0.07f * (fine - 0.5f)) * crack;
    return (struct paint){v, v * 0.995f, v * 0.985f, 0};
}

// Worn paint over the ground; `off` is the distance from the line's middle, in half widths.
static struct paint lined(const struct spot *s, struct paint ground, struct paint line, float off)
{
    const bool worn = paint_cloud(s, 2) > 0.62f && paint_fine(s) > 0.35f;
    return off < 1 && !worn ? paint_scaled(line, 0.85f + 0.15f * paint_cloud(s, 1)) : ground;
}

// Lanes along v; distances are in metres from the road's middle.
static struct paint lanes(const struct spot *s, float width_m)
{
    const float from_middle = rg_abs(s->u - 0.5f) * width_m, to_edge = width_m / 2 - from_middle;
    const float along = s->v * width_m;
    const bool wide = width_m > 10;
    struct paint p = asphalt(s);
    // Tyres polish their tracks, and water runs along the kerb.
    const float track = rg_abs(paint_line(from_middle - 0.75f, 2.25f) - 0.25f);
    p = paint_scaled(p, 0.93f + 0.28f * track);
    if (to_edge < 0.5f)
        p = paint_scaled(p, 0.78f);
    p = lined(s, p, white_line, rg_abs(to_edge - 0.62f) / 0.06f);
    if (!wide)
        return along - 9 * rg_floor(along / 9) < 3 ? lined(s, p, white_line, from_middle / 0.07f)
                                                   : p;
    p = lined(s, p, yellow_line, rg_abs(from_middle - 0.16f) / 0.06f);
    return along - 9 * rg_floor(along / 9) < 3
               ? lined(s, p, white_line, rg_abs(from_middle - 4.5f) / 0.07f)
               : p;
}

static struct paint crossing(const struct spot *s)
{
    const bool bar = paint_line(s->u, 1 / 9.0f) < 0.25f && s->v > 0.08f && s->v < 0.92f;
    return lined(s, asphalt(s), white_line, bar ? 0.0f : 2.0f);
}

static struct paint stop(const struct spot *s)
{
    struct paint p = lined(s, asphalt(s), white_line, rg_abs(s->v - 0.5f) / 0.06f);
    return lined(s, p, white_line, rg_abs(s->u - 0.5f) / 0.008f);
}

// Stone slabs, `across` of them in a texture's width.
static struct paint slabs(const struct spot *s, int across, struct paint colour, float joint)
{
    const int x = (int)(s->u * (float)across), y = (int)(s->v * (float)across);
    const float each = paint_chance(s, y * across + x);
    const float line =
        rg_min(paint_line(s->u, 1 / (float)across), paint_line(s->v, 1 / (float)across));
    const float v = (0.88f + 0.1f * each) * (0.86f + 0.24f * paint_cloud(s, 0)) *
                    (0.96f + 0.08f * paint_fine(s));
    return paint_scaled(colour, line < joint ? v * 0.72f : v);
}

static struct paint paving(const struct spot *s)
{
    const struct paint stone = {0.58f, 0.57f, 0.54f, 0}, granite = {0.64f, 0.63f, 0.62f, 0};
    const struct paint warm = {0.66f, 0.58f, 0.49f, 0}, dark = {0.42f, 0.40f, 0.39f, 0};
    switch (s->texture - PAINT_PAVING) {
    case 0:
        return slabs(s, 6, stone, 0.018f);
    case 1:
        return slabs(s, 2, granite, 0.008f);
    case 2: { // the plaza: light squares in dark frames
        const bool frame = paint_line(s->u, 0.5f) < 0.06f || paint_line(s->v, 0.5f) < 0.06f;
        return slabs(s, 12, frame ? dark : warm, 0.03f);
    }
    case 3:
        return slabs(s, 24, dark, 0.08f);
    default:
        return slabs(s, 16, granite, 0.03f);
    }
}

static struct paint roof(const struct spot *s)
{
    static const float tones[6] = {0.32f, 0.45f, 0.38f, 0.52f, 0.28f, 0.42f};
    const float base = tones[s->texture - PAINT_ROOF];
    const float seam = paint_line(s->u, 0.25f) < 0.006f ? 0.8f : 1;
    const float v =
        base * (0.78f + 0.4f * paint_cloud(s, 0)) * (0.92f + 0.16f * paint_fine(s)) * seam;
    return (struct paint){v, v * 0.985f, v * 0.96f, 0};
}

static struct paint metal(const struct spot *s)
{
    static const float tones[3] = {0.56f, 0.24f, 0.97f};
    const int kind = s->texture - PAINT_METAL;
    const float wear =
        kind == 2 ? 0.96f + 0.04f * paint_cloud(s, 0) : 0.86f + 0.2f * paint_cloud(s, 0);
    const float stains = kind == 2 ? 1 : 1 - 0.12f * paint_stain(s);
    return paint_scaled(grey(tones[kind]), wear * stains);
}

static struct paint leaves(const struct spot *s)
{
    const float c = paint_cloud(s, 0), d = paint_cloud(s, 2), fine = paint_fine(s);
    const float clump = rg_clamp((c - 0.30f) * 2.4f, 0.35f, 1);
    const float light = clump * (0.62f + 0.4f * d) * (0.72f + 0.5f * fine);
    const bool second = s->texture == PAINT_LEAVES + 1;
    return (struct paint){light * (second ? 0.44f : 0.36f), light * (second ? 0.50f : 0.47f),
                          light * (second ? 0.27f : 0.26f), 0};
}

static struct paint plants(const struct spot *s)
{
    const float c = paint_cloud(s, 0), fine = paint_fine(s);
    if (s->texture == PAINT_GRASS)
        return paint_scaled((struct paint){0.34f, 0.46f, 0.22f, 0}, 0.7f + 0.4f * c + 0.25f * fine);
    const float groove = 0.6f + 0.5f * paint_stain(s);
    return paint_scaled((struct paint){0.42f, 0.36f, 0.30f, 0}, groove * (0.85f + 0.3f * c));
}

struct paint paint_ground(const struct spot *s)
{
    const int t = s->texture;
    if (t < PAINT_ASPHALT)
        return roof(s);
    if (t == PAINT_ASPHALT)
        return asphalt(s);
    if (t < PAINT_PAVING)
        return lanes(s, t == PAINT_ASPHALT + 1 ? 9 : 18);
    if (t < PAINT_CROSSING)
        return paving(s);
    if (t < PAINT_METAL)
        return t == PAINT_CROSSING ? crossing(s) : stop(s);
    if (t < PAINT_GRASS)
        return metal(s);
    if (t == PAINT_LEAVES || t == PAINT_LEAVES + 1)
        return leaves(s);
    if (t == PAINT_LIGHT)
        return (struct paint){1, 1, 1, 1};
    if (t == PAINT_WATER)
        return paint_scaled((struct paint){0.22f, 0.30f, 0.34f, 0},
                            0.8f + 0.4f * paint_cloud(s, 0));
    return plants(s);
}
