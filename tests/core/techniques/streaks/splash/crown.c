#include "tests/core/techniques/streaks/splash/crown.h"

#include <math.h>
#include <string.h>

#include "tests/oracle/raster.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross_unit(const double a[3], const double b[3], double of[3])
{
    double squared = 0;
    for (int i = 0; i < 3; i++) {
        of[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        squared += of[i] * of[i];
    }
    for (int i = 0; i < 3; i++)
        of[i] /= sqrt(squared);
}

static int wide_at(int level)
{
    return CROWN_WIDE >> level;
}

static int tall_at(int level)
{
    return CROWN_TALL >> level;
}

// The atlas stores shares below the smallest normal half as 0, but shrinks what they were.
static double kept(double opacity)
{
    return opacity < 1.0 / 16384 ? 0 : opacity;
}

// The mean of the texels that a texel of a level covers in the level before, whose sides may be
// odd.
static double mean_of(const double *above, int level, int x, int y)
{
    const int wide = wide_at(level - 1), tall = tall_at(level - 1);
    const int x0 = x * wide / wide_at(level), x1 = (x + 1) * wide / wide_at(level);
    const int y0 = y * tall / tall_at(level), y1 = (y + 1) * tall / tall_at(level);
    double sum = 0;
    for (int row = y0; row < y1; row++)
        for (int column = x0; column < x1; column++)
            sum += above[row * wide + column];
    return sum / ((x1 - x0) * (y1 - y0));
}

void crown_halve(struct crown_film *film, int frame)
{
    for (int level = 1; level < CROWN_LEVELS; level++)
        for (int y = 0; y < tall_at(level); y++)
            for (int x = 0; x < wide_at(level); x++)
                film->texels[frame][level][y * wide_at(level) + x] =
                    mean_of(film->texels[frame][level - 1], level, x, y);
}

// --- differences between splashes: docs/streaks.md ---

static uint32_t chance_of(uint32_t number)
{
    uint32_t h = number * 2654435769u;
    h = (h ^ h >> 16) * 2246822507u;
    return h ^ h >> 13;
}

static double differs(uint32_t ten_bits)
{
    return 0.85 + 0.3 * (ten_bits & 1023) / 1023.0;
}

// --- its picture ---

static double texel(const struct crown_film *film, int frame, int level, int x, int y)
{
    const int wide = wide_at(level), tall = tall_at(level);
    x = x < 0 ? 0 : x >= wide ? wide - 1 : x;
    y = y < 0 ? 0 : y >= tall ? tall - 1 : y;
    return kept(film->texels[frame][level][y * wide + x]);
}

// At a place from the upper left corner, 0 to 1.
static double frame_at(const struct crown_film *film, int frame, int level, double u, double v)
{
    const double x = u * wide_at(level) - 0.5, y = v * tall_at(level) - 0.5;
    const int x0 = (int)floor(x), y0 = (int)floor(y);
    const double s = x - x0, t = y - y0;
    return (1 - t) * ((1 - s) * texel(film, frame, level, x0, y0) +
                      s * texel(film, frame, level, x0 + 1, y0)) +
           t * ((1 - s) * texel(film, frame, level, x0, y0 + 1) +
                s * texel(film, frame, level, x0 + 1, y0 + 1));
}

// A frame shows the middle of its time, and the last one fades out.
static double film_at(const struct crown_splash *splash, int level, double u, double v)
{
    const double passed = splash->age_s / splash->lasts_s * CROWN_FRAMES;
    const double shown = fmin(fmax(passed - 0.5, 0), CROWN_FRAMES - 1);
    const int first = (int)fmin(shown, CROWN_FRAMES - 2);
    const double a = frame_at(splash->film, first, level, u, v);
    const double b = frame_at(splash->film, first + 1, level, u, v);
    return (a + (b - a) * (shown - first)) * fmin(CROWN_FRAMES - passed, 1);
}

static void clip_of(const struct crown_eye *eye, const double at[3], double is_place,
                    double clip[4])
{
    for (int i = 0; i < 4; i++)
        clip[i] = dot(eye->clip + 4 * i, at) + eye->clip[4 * i + 3] * is_place;
}

void crown_reach(const struct crown_eye *eye, const struct crown_splash *splash, int box[4])
{
    double c[4];
    clip_of(eye, splash->foot, 1, c);
    const double reach_m = 1.3 * splash->wide * splash->size, near_m = c[3] - reach_m;
    const double x = (c[0] / c[3] + 1) / 2 * eye->width, y = (c[1] / c[3] + 1) / 2 * eye->height;
    const bool is_known = near_m > 0;
    const double reach = is_known ? 2 * reach_m * eye->focal_px / near_m + 2 : 0;
    box[0] = is_known ? (int)fmax(x - reach, 0) : 0;
    box[1] = is_known ? (int)fmax(y - reach, 0) : 0;
    box[2] = is_known ? (int)fmin(x + reach + 1, eye->width) : eye->width;
    box[3] = is_known ? (int)fmin(y + reach + 1, eye->height) : eye->height;
}

// Whether a picture covers a pixel. It begins at `c` and spans `s` and `t` in clip space; its
// corners are snapped to 1/256 pixel, as when drawn.
static bool covers(const struct crown_eye *eye, const double c[4], const double s[4],
                   const double t[4], int x, int y)
{
    struct oracle_point corners[4];
    for (int i = 0; i < 4; i++) {
        double at[4];
        for (int k = 0; k < 4; k++)
            at[k] = c[k] + (i == 1 || i == 2 ? s[k] : 0) + (i >= 2 ? t[k] : 0);
        if (!(at[3] > 0))
            return false;
        corners[i].x = llround(128 * eye->width * (at[0] / at[3] + 1));
        corners[i].y = llround(128 * eye->height * (at[1] / at[3] + 1));
    }
    return oracle_covers(corners, 4, x, y);
}

// Draws a picture at least a pixel wide, and as high as the eye sees it, about its middle. Returns
// the share of the drawn picture that it would cover.
static double enlarge(const struct crown_eye *eye, const double middle[3], const double from_eye[3],
                      const double left[3], double pixel_m, double *wide, double corner[3],
                      double along[3])
{
    double towards[3], above[3];
    for (int i = 0; i < 3; i++)
        towards[i] = eye->at[i] - middle[i];
    cross_unit(from_eye, left, above);
    const double tall = sqrt(dot(along, along)), slant = dot(along, towards) / tall;
    const double seen = tall * sqrt(1 - slant * slant / dot(towards, towards));
    const double wider = fmax(*wide, pixel_m), taller = fmax(seen, pixel_m);
    const double share = *wide * seen / (wider * taller);
    for (int i = 0; i < 3; i++) {
        corner[i] -= above[i] * (taller - seen) / 2;
        along[i] += above[i] * (taller - seen);
    }
    *wide = wider;
    return share;
}

// The picture stands on its foot, which is a fifth of its height above its lower edge. It turns to
// the eye as far as its axis allows.
bool crown_seen(const struct crown_eye *eye, const struct crown_splash *splash, int x, int y,
                struct crown_pixel *pixel)
{
    const uint32_t chance = chance_of(splash->number);
    double wide = splash->wide * splash->size * differs(chance);
    const double tall = splash->wide * splash->size * differs(chance >> 22) * 2 / 3;
    double corner[3], from_eye[3], left[3], across[3], along[3], middle[3];
    for (int i = 0; i < 3; i++) {
        along[i] = splash->up[i] * tall;
        corner[i] = splash->foot[i] - along[i] / 5;
        from_eye[i] = corner[i] - eye->at[i];
        middle[i] = corner[i] + along[i] / 2;
    }
    cross_unit(splash->up, from_eye, left);
    double c[4], s[4], t[4], m[4];
    clip_of(eye, middle, 1, m);
    const double pixels = wide * eye->focal_px / m[3];
    const double thinner =
        enlarge(eye, middle, from_eye, left, m[3] / eye->focal_px, &wide, corner, along);
    for (int i = 0; i < 3; i++) {
        corner[i] += left[i] * wide / 2;
        across[i] = -left[i] * wide;
    }
    clip_of(eye, corner, 1, c);
    clip_of(eye, across, 0, s);
    clip_of(eye, along, 0, t);
    // Solves for the place whose clip coordinates over w are the pixel's.
    const double px = (x + 0.5) / eye->width * 2 - 1, py = (y + 0.5) / eye->height * 2 - 1;
    const double a = s[0] - px * s[3], b = t[0] - px * t[3], e = px * c[3] - c[0];
    const double d = s[1] - py * s[3], f = t[1] - py * t[3], g = py * c[3] - c[1];
    const double u = fmin(fmax((e * f - b * g) / (a * f - b * d), 0), 1);
    const double v = fmin(fmax((a * g - e * d) / (a * f - b * d), 0), 1);
    const double w = c[3] + u * s[3] + v * t[3];
    if (!covers(eye, c, s, t, x, y))
        return false;
    const double level = floor(log2(fmax(CROWN_WIDE / pixels, 1)) + 0.5);
    const bool mirrored = chance >> 10 & 1;
    memcpy(pixel->middle, middle, sizeof(middle));
    pixel->cover = splash->drops * thinner *
                   film_at(splash, (int)fmin(level, CROWN_LEVELS - 1), mirrored ? 1 - u : u, 1 - v);
    double towards[3], squared = 0;
    for (int i = 0; i < 3; i++) {
        pixel->at[i] = corner[i] + u * across[i] + v * along[i];
        towards[i] = eye->at[i] - middle[i];
        squared += towards[i] * towards[i];
    }
    const double sine = fmax(dot(towards, splash->up) / sqrt(squared), 0.05);
    pixel->near_by = (tall / 5 / sine + 0.002) / w;
    return true;
}

bool crown_hidden(const struct crown_eye *eye, const struct crown_pixel *pixel,
                  const double place[3], const double normal[3])
{
    double ray[3], to[3];
    for (int i = 0; i < 3; i++) {
        ray[i] = pixel->at[i] - eye->at[i];
        to[i] = place[i] - eye->at[i];
    }
    const double met = dot(to, normal) / dot(ray, normal);
    return met > 0 && met < 1 - pixel->near_by;
}
