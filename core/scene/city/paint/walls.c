#include "core/scene/city/paint/walls.h"

// --- walls ---

enum wall_pattern { WALL_BRICK, WALL_PANELS, WALL_STONE, WALL_PLASTER };
struct wall {
    enum wall_pattern pattern;
    struct paint colour;
};

static const struct wall walls[PAINT_WALLS] = {
    {WALL_BRICK, {0.60f, 0.38f, 0.31f, 0}},   {WALL_STONE, {0.76f, 0.71f, 0.61f, 0}},
    {WALL_PANELS, {0.66f, 0.65f, 0.63f, 0}},  {WALL_PLASTER, {0.80f, 0.72f, 0.56f, 0}},
    {WALL_BRICK, {0.48f, 0.31f, 0.27f, 0}},   {WALL_STONE, {0.58f, 0.57f, 0.55f, 0}},
    {WALL_BRICK, {0.72f, 0.58f, 0.44f, 0}},   {WALL_PLASTER, {0.84f, 0.83f, 0.79f, 0}},
    {WALL_STONE, {0.83f, 0.80f, 0.73f, 0}},   {WALL_PANELS, {0.55f, 0.54f, 0.52f, 0}},
    {WALL_BRICK, {0.54f, 0.40f, 0.35f, 0}},   {WALL_STONE, {0.52f, 0.45f, 0.39f, 0}},
    {WALL_PLASTER, {0.70f, 0.58f, 0.48f, 0}}, {WALL_BRICK, {0.66f, 0.47f, 0.38f, 0}},
    {WALL_STONE, {0.70f, 0.69f, 0.68f, 0}},   {WALL_PANELS, {0.74f, 0.71f, 0.66f, 0}},
};

// A brick or block: its brightness relative to others, and 0 in a joint.
struct block {
    float shade, joint;
};

static struct block block_at(float u, float v, int across, int down, float joint_u, float joint_v)
{
    const float y = v * (float)down, row = rg_floor(y);
    const float x = u * (float)across + ((int)row & 1 ? 0.5f : 0);
    const float column = rg_floor(x);
    const uint32_t id = (uint32_t)((int)column % across) * 7919u + (uint32_t)row * 104729u;
    const uint32_t h = (id ^ id >> 9) * 0x9e3779b1u;
    const float fx = x - column, fy = y - row;
    const bool in_joint = fx < joint_u || fy < joint_v;
    return (struct block){(float)(h >> 24) / 255, in_joint ? 1.0f : 0.0f};
}

struct paint paint_wall(const struct spot *s, int wall, float u, float v, int across, int down)
{
    const struct wall *w = &walls[wall];
    const float dirt = 0.82f + 0.26f * paint_cloud(s, 0), grain = 0.95f + 0.1f * paint_fine(s);
    const float stains = 1 - 0.16f * paint_stain(s) * paint_stain(s);
    struct paint p = paint_scaled(w->colour, dirt * grain * stains);
    struct block b = {0.5f, 0};
    float joint = 0.8f;
    switch (w->pattern) {
    case WALL_BRICK:
        b = block_at(u, v, across, down, 0.06f, 0.16f);
        p = paint_scaled(p, 0.86f + 0.26f * b.shade);
        joint = 1.18f;
        break;
    case WALL_PANELS:
        b = block_at(u, v, across / 8, down / 10, 0.012f, 0.02f);
        p = paint_scaled(p, 0.96f + 0.08f * b.shade);
        break;
    case WALL_STONE:
        b = block_at(u, v, across / 4, down / 5, 0.02f, 0.04f);
        p = paint_scaled(p, 0.93f + 0.14f * b.shade);
        break;
    case WALL_PLASTER:
        break;
    }
    return b.joint > 0 ? paint_scaled(p, joint) : p;
}

// --- windows ---

// The view through a window: (x, y) from 0 to 1 within its glass, y upwards; `id` tells windows
// apart.
static struct paint behind_glass(const struct spot *s, int id, float x, float y, float lit_share)
{
    const float c = paint_chance(s, 4 * id), tone = paint_chance(s, 4 * id + 1);
    const float drawn = paint_chance(s, 4 * id + 2);
    const float sky = 0.10f * y + 0.10f * paint_cloud(s, 1);
    struct paint glass = {0.17f + sky, 0.21f + sky, 0.25f + 1.15f * sky, 0};
    const bool lit = c < lit_share;
    if (lit) { // warm rooms, and cooler offices
        const struct paint warm = {0.98f, 0.80f, 0.52f, 0.9f}, cool = {0.86f, 0.92f, 0.95f, 0.8f};
        glass = paint_mix(warm, cool, tone > 0.6f ? 1 : tone * 0.5f);
        const float fall = 0.62f + 0.38f * y - 0.3f * rg_abs(x - 0.5f);
        const float things = y < 0.4f * drawn && paint_line(x + tone, 0.37f) < 0.3f ? 0.55f : 1;
        glass = paint_scaled(glass, fall * things);
        glass.a *= (0.45f + 0.55f * paint_chance(s, 4 * id + 3)) * fall * things;
    }
    // A partly lowered blind, or curtains at the sides.
    const struct paint cloth = {0.72f, 0.70f, 0.65f, glass.a * 0.5f};
    if (drawn < 0.3f && y > 1 - 2.5f * drawn)
        return paint_scaled(cloth, paint_line(y, 0.06f) < 0.15f ? 0.82f : 0.95f);
    if (drawn > 0.75f && rg_abs(x - 0.5f) > 0.32f)
        return paint_scaled(cloth, 0.75f + 0.25f * paint_line(x, 0.07f) * 2);
    return glass;
}

// A texel's bay: its number, and the place in it, y from the floor's lower edge.
struct bay {
    int id;
    float x, y;
};

static struct bay bay_at(const struct spot *s)
{
    const float x = s->u * PAINT_CELLS, y = (1 - s->v) * PAINT_CELLS;
    const int column = (int)x, row = (int)y;
    return (struct bay){row * PAINT_CELLS + column, x - (float)column, y - (float)row};
}

struct paint paint_facade(const struct spot *s)
{
    const struct facade_style style = s->style;
    const struct bay bay = bay_at(s);
    const float left = (float)style.left, right = (float)style.right;
    const float bottom = (float)style.bottom, top = (float)style.top;
    if (bay.x < left || bay.x > right || bay.y < bottom || bay.y > top) {
        struct paint wall = paint_wall(s, s->texture % PAINT_WALLS, s->u, s->v, 16 * 3, 40 * 3);
        // Water runs down from the sills, and dirt stays under them.
        if (bay.y < bottom && bay.x > left && bay.x < right)
            wall = paint_scaled(wall, 0.80f + 0.2f * (bottom - bay.y) / bottom * paint_stain(s));
        return bay.y < 0.02f ? paint_scaled(wall, 0.8f) : wall;
    }
    const float x = (bay.x - left) / (right - left), y = (bay.y - bottom) / (top - bottom);
    const float light = paint_chance(s, 1000) < 0.6f ? 0.82f : 0.30f;
    const struct paint frame = {light, light, light * 0.97f, 0};
    const bool in_frame = x < 0.04f || x > 0.96f || y < 0.035f || y > 0.965f ||
                          rg_abs(x - 0.5f) < 0.02f || rg_abs(y - 0.66f) < 0.015f;
    if (in_frame)
        return paint_scaled(frame, 0.85f + 0.15f * paint_cloud(s, 0));
    // The reveal casts a shadow on the glass.
    const float shade = y > 0.9f ? 0.75f : 1;
    return paint_scaled(behind_glass(s, bay.id, x, y, 0.30f), shade);
}

struct paint paint_curtain(const struct spot *s)
{
    static const struct paint tints[6] = {{0.62f, 0.78f, 0.86f, 0}, {0.58f, 0.70f, 0.68f, 0},
                                          {0.55f, 0.58f, 0.64f, 0}, {0.74f, 0.64f, 0.50f, 0},
                                          {0.48f, 0.60f, 0.76f, 0}, {0.42f, 0.44f, 0.46f, 0}};
    const struct facade_style style = s->style;
    const struct bay bay = bay_at(s);
    const struct paint tint = tints[s->texture % 6];
    const float bottom = (float)style.bottom;
    if (bay.x < 0.03f || bay.x > 0.97f || bay.y < 0.02f || bay.y > 0.98f ||
        rg_abs(bay.y - bottom) < 0.015f)
        return paint_scaled((struct paint){0.42f, 0.43f, 0.44f, 0},
                            0.9f + 0.2f * paint_cloud(s, 0));
    if (bay.y < bottom) // the panel in front of the floor slab
        return paint_scaled(tint, 0.46f + 0.08f * paint_cloud(s, 0));
    const float y = (bay.y - bottom) / (1 - bottom);
    struct paint glass = behind_glass(s, bay.id, bay.x, y, 0.26f);
    const float panes = 0.9f + 0.2f * paint_chance(s, 2000 + bay.id);
    if (glass.a > 0)
        return glass;
    // Coated glass reflects the sky.
    const float sky = (0.30f + 0.3f * paint_cloud(s, 2) + 0.10f * y) * panes;
    return paint_mix(glass, paint_scaled(tint, sky * 1.7f), 0.72f);
}

// --- shops ---

static struct paint sign_colour(const struct spot *s, int k)
{
    static const struct paint colours[8] = {{0.80f, 0.16f, 0.12f, 0}, {0.12f, 0.30f, 0.62f, 0},
                                            {0.10f, 0.42f, 0.24f, 0}, {0.88f, 0.70f, 0.16f, 0},
                                            {0.20f, 0.18f, 0.20f, 0}, {0.86f, 0.84f, 0.80f, 0},
                                            {0.50f, 0.14f, 0.34f, 0}, {0.90f, 0.46f, 0.12f, 0}};
    return colours[(int)(8 * paint_chance(s, k))];
}

// The sign over the windows, with letters as bars. `shade` is the board's.
static struct paint paint_sign(const struct spot *s, float y, float shade)
{
    const bool bright = paint_chance(s, 3) < 0.6f;
    struct paint board = paint_scaled(sign_colour(s, 1), shade);
    const float middle = rg_abs(s->u - 0.5f);
    const int letter = (int)rg_floor(s->u * 40);
    const float in_letter = s->u * 40 - (float)letter;
    const bool strokes = in_letter > 0.18f &&
                         (in_letter < 0.42f || in_letter > 0.78f ||
                          rg_abs(y - 0.25f - 0.5f * paint_chance(s, 40 + letter)) < 0.09f) &&
                         y > 0.2f && y < 0.8f && middle < 0.2f + 0.15f * paint_chance(s, 5) &&
                         paint_chance(s, 100 + letter) < 0.85f;
    board.a = bright ? 0.35f : 0;
    if (!strokes)
        return board;
    return (struct paint){0.95f, 0.93f, 0.85f, bright ? 0.9f : 0};
}

bool paint_sign_light(struct spot *s, float tint[3])
{
    enum { ACROSS = 400, DOWN = 20 };
    float sum[3] = {0};
    for (int i = 0; i < ACROSS * DOWN; i++) {
        s->u = ((float)(i % ACROSS) + 0.5f) / ACROSS;
        const struct paint p = paint_sign(s, ((float)(i / ACROSS) + 0.5f) / DOWN, 0.95f);
        sum[0] += p.a * p.r * p.r;
        sum[1] += p.a * p.g * p.g;
        sum[2] += p.a * p.b * p.b;
    }
    const float luminance = 0.2126f * sum[0] + 0.7152f * sum[1] + 0.0722f * sum[2];
    for (int c = 0; c < 3; c++)
        tint[c] = sum[c] / rg_max(luminance, 1e-6f);
    return luminance > 0;
}

struct paint paint_shop(const struct spot *s)
{
    const float y = 1 - s->v;
    const struct paint trim = paint_scaled(sign_colour(s, 2), 0.55f + 0.1f * paint_fine(s));
    if (y > CITY_SIGN_HIGH)
        return paint_scaled(trim, 0.8f);
    if (y > CITY_SIGN_LOW)
        return paint_sign(s, (y - CITY_SIGN_LOW) / 0.16f, 0.9f + 0.1f * paint_cloud(s, 0));
    const bool door = rg_abs(s->u - 0.72f) < 0.09f;
    if (y < (door ? 0.015f : 0.12f))
        return trim;
    const float frame =
        door ? rg_abs(rg_abs(s->u - 0.72f) - 0.085f) : paint_line(s->u + 0.06f, 0.33f) * 0.33f;
    if (frame < 0.008f || rg_abs(y - 0.60f) < 0.008f || y > 0.725f)
        return paint_scaled(trim, 0.7f);
    // The lit interior: shelves and goods, darker near the floor.
    const float depth = 0.55f + 0.45f * y;
    const int shelf = (int)(y * 20), place = (int)(s->u * 80);
    const float goods = paint_chance(s, 500 + shelf * 90 + place);
    const struct paint light = {0.98f, 0.90f, 0.72f, 0.75f};
    struct paint p = paint_scaled(light, depth * (0.62f + 0.2f * paint_cloud(s, 1)));
    if (!door && y < 0.5f && goods < 0.5f)
        p = paint_mix(p, paint_scaled(sign_colour(s, 900 + shelf * 90 + place), 0.75f), 0.4f);
    p.a = 0.75f * depth * (paint_chance(s, 7) < 0.85f ? 1 : 0.1f);
    return p;
}
