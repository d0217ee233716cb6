#include "core/techniques/cartoon/rain/strokes.h"

#include <math.h>

void strokes_add(struct strokes *s, double x0, double y0, double r0, double x1, double y1,
                 double r1)
{
    if (s->count < STROKES)
        s->all[s->count++] = (struct stroke){x0, y0, r0, x1, y1, r1};
}

// --- the drops ---

// A streak that tapers upwards; heavier drops have rounder heads.
void strokes_of_drop(struct strokes *s, int weight)
{
    static const struct {
        double top, head, thin, wide, ink;
    } looks[CARTOON_DROP_TEXTURES] = {{0.10, 0.92, 0.006, 0.030, 0.0},
                                      {0.06, 0.90, 0.006, 0.048, 0.022},
                                      {0.04, 0.86, 0.006, 0.080, 0.030}};
    const double head = looks[weight].head, wide = looks[weight].wide;
    *s = (struct strokes){.ink = looks[weight].ink, .wobble = 0.10};
    strokes_add(s, 0.5, looks[weight].top, looks[weight].thin, 0.5, head - 0.25, wide * 0.62);
    strokes_add(s, 0.5, head - 0.25, wide * 0.62, 0.5, head - wide, wide);
}

// --- the splashes ---

// How far spray flies in its life, and how far it falls.
#define REACH  0.62
#define FALL   0.50
#define GROUND 0.06 // below the middle, at the near side of the ring, where falling spray ends

struct prong {
    double lean_rad; // from the vertical
    double force;    // fraction of REACH
};

static void at_time(const struct prong *p, double t, double at[2])
{
    at[0] = 0.5 + REACH * p->force * sin(p->lean_rad) * t;
    at[1] = 0.5 - REACH * p->force * cos(p->lean_rad) * t + FALL * t * t * p->force;
}

// A tongue of water in the first half of its life, then a drop that flies on to the ground.
static void add_prong(struct strokes *s, const struct prong *p, double t)
{
    double tip[2], tail[2];
    const double thick = 0.044 * (1 - 0.45 * t);
    at_time(p, t, tip);
    if (tip[1] > 0.5 + GROUND)
        return;
    at_time(p, fmax(t - (t < 0.5 ? 0.34 : 0.10), 0), tail);
    strokes_add(s, tail[0], tail[1], thick * (t < 0.5 ? 0.95 : 0.45), tip[0], tip[1], thick);
}

// The ring of water that runs outwards, seen from the side; far out it breaks up.
static void add_ring(struct strokes *s, double t, double aside)
{
    enum { PARTS = 28 };
    const double wide = 0.07 + 0.34 * t, high = 0.24 * wide, thick = 0.020 * (1 - 0.6 * t);
    for (int i = 0; i < PARTS; i++) {
        if (t > 0.45 && i % 4 == 3)
            continue;
        const double a = 2 * M_PI * i / PARTS, b = 2 * M_PI * (i + 1) / PARTS;
        strokes_add(s, 0.5 + aside * t + wide * cos(a), 0.5 + high * sin(a), thick,
                    0.5 + aside * t + wide * cos(b), 0.5 + high * sin(b), thick);
    }
}

// Steep hits throw up a crown, oblique hits lean, grazing hits skid along.
void strokes_of_splash(struct strokes *s, int pattern, int texture)
{
    static const struct prong prongs[CARTOON_PATTERNS][5] = {
        {{-0.95, 0.62}, {-0.45, 0.85}, {0.02, 1.0}, {0.50, 0.82}, {1.00, 0.60}},
        {{-0.55, 0.55}, {-0.05, 0.75}, {0.40, 1.0}, {0.80, 0.85}, {1.15, 0.60}},
        {{-0.90, 0.35}, {0.50, 0.55}, {0.95, 0.85}, {1.20, 1.0}, {1.38, 0.75}},
    };
    static const double asides[CARTOON_PATTERNS] = {0, 0.05, 0.12};
    const double t = (texture + 0.6) / CARTOON_FRAMES;
    *s = (struct strokes){.ink = 0.024, .wobble = 0.12};
    add_ring(s, t, asides[pattern]);
    for (int i = 0; i < 5; i++)
        add_prong(s, &prongs[pattern][i], t);
}

// --- painting ---

enum { FINER = 2, LARGEST = 64 * FINER };

// The distance of a place from a stroke, in widths of the picture; negative inside.
static double outside(const struct strokes *s, const struct stroke *b, double x, double y)
{
    const double dx = b->x1 - b->x0, dy = b->y1 - b->y0, square = dx * dx + dy * dy;
    const double along =
        square > 0 ? fmin(fmax(((x - b->x0) * dx + (y - b->y0) * dy) / square, 0), 1) : 0;
    const double ax = x - b->x0 - along * dx, ay = y - b->y0 - along * dy;
    // A trembling hand: slow waves that do not repeat within the picture.
    const double stray = sin(17 * y + 5 * x) * 0.6 + sin(41 * x - 29 * y + 1) * 0.4;
    return sqrt(ax * ax + ay * ay) - (b->r0 + (b->r1 - b->r0) * along) * (1 + s->wobble * stray);
}

static void find_distances(const struct strokes *s, int px, double *distances)
{
    for (int i = 0; i < px * px; i++)
        distances[i] = 1;
    for (int k = 0; k < s->count; k++) {
        const struct stroke *b = &s->all[k];
        const double reach = 1.3 * fmax(b->r0, b->r1) + 0.03;
        const int left = (int)fmax((fmin(b->x0, b->x1) - reach) * px, 0);
        const int right = (int)fmin((fmax(b->x0, b->x1) + reach) * px, px - 1);
        const int top = (int)fmax((fmin(b->y0, b->y1) - reach) * px, 0);
        const int bottom = (int)fmin((fmax(b->y0, b->y1) + reach) * px, px - 1);
        for (int y = top; y <= bottom; y++)
            for (int x = left; x <= right; x++)
                distances[y * px + x] =
                    fmin(distances[y * px + x], outside(s, b, (x + 0.5) / px, (y + 0.5) / px));
    }
}

// Water inside, ink towards the rim; edges are blurred over a texel of the finer picture.
static rgba colour_at(const struct strokes *s, double distance, double y, int px)
{
    const double water[3] = {0.86 + 0.10 * y, 0.94 + 0.05 * y, 1.0}, ink[3] = {0.16, 0.34, 0.58};
    const double cover = fmin(fmax(0.5 - distance * px, 0), 1);
    const double inked = s->ink > 0 ? fmin(fmax(0.5 + (distance + s->ink) * px, 0), 1) : 0;
    double c[3];
    for (int i = 0; i < 3; i++) {
        const double shown = water[i] + (ink[i] - water[i]) * inked;
        c[i] = shown * shown * cover;
    }
    return rg_rgba((float)c[0], (float)c[1], (float)c[2], (float)cover);
}

void strokes_paint(const struct strokes *s, int px, rgba *texels)
{
    double distances[LARGEST * LARGEST];
    const int fine = FINER * px;
    const float share = 1.0f / (FINER * FINER);
    find_distances(s, fine, distances);
    for (int i = 0; i < px * px; i++) {
        rgba sum = {0, 0, 0, 0};
        for (int k = 0; k < FINER * FINER; k++) {
            const int x = i % px * FINER + k % FINER, y = i / px * FINER + k / FINER;
            const rgba c = colour_at(s, distances[y * fine + x], (y + 0.5) / fine, fine);
            sum = rg_rgba(sum.r + c.r * share, sum.g + c.g * share, sum.b + c.b * share,
                          sum.a + c.a * share);
        }
        texels[i] = sum;
    }
}
