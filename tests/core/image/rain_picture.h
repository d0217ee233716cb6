// A synthetic rain picture for the image tests: a sky with a gradient and a dark block, and bright,
// slightly slanted streaks blended over it. Seeded, so that every run draws the same.
#ifndef RG_TESTS_CORE_IMAGE_RAIN_PICTURE_H
#define RG_TESTS_CORE_IMAGE_RAIN_PICTURE_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/picture.h"

struct rain_look {
    int streaks;
    int skip_every; // leaves out every n-th streak; 0: none
    int shift_px, shifted_streak, shifted_streak_px;
    float alpha_scale;
};

static const struct rain_look honest_rain = {
    .streaks = 300, .shifted_streak = -1, .alpha_scale = 1};

static inline uint32_t rain_noise(uint32_t i)
{
    i = (i ^ 61u) ^ (i >> 16);
    i *= 9u;
    i ^= i >> 4;
    i *= 0x27d4eb2du;
    return i ^ i >> 15;
}

static inline void rain_background(struct rg_picture *picture)
{
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++)
            for (int c = 0; c < picture->channels; c++) {
                float sky = 0.05f + 0.1f * (float)y / (float)picture->height + 0.02f * (float)c;
                bool block = x > picture->width / 2 && y > picture->height / 2;
                picture->texels[((int64_t)y * picture->width + x) * picture->channels + c] =
                    c == 3  ? 1.0f
                    : block ? 0.5f * sky
                            : sky;
            }
}

static inline void rain_streak(struct rg_picture *picture, int x, int y, int length, float alpha)
{
    static const float colour[3] = {0.75f, 0.85f, 1.0f};
    for (int i = 0; i < length; i++) {
        int px = x + i / 6, py = y + i;
        if (px < 0 || py < 0 || px >= picture->width || py >= picture->height)
            continue;
        float *texel = picture->texels + ((int64_t)py * picture->width + px) * picture->channels;
        for (int c = 0; c < 3 && c < picture->channels; c++)
            texel[c] += alpha * (colour[c] - texel[c]);
    }
}

static inline void rain_draw(struct rg_picture *picture, struct rain_look look)
{
    rain_background(picture);
    for (int s = 0; s < look.streaks; s++) {
        uint32_t noise = rain_noise((uint32_t)s + 1);
        int x = (int)(noise % (uint32_t)picture->width) + look.shift_px;
        int y = (int)(rain_noise(noise) % (uint32_t)picture->height);
        if (s == look.shifted_streak)
            x += look.shifted_streak_px;
        if (look.skip_every && s % look.skip_every == look.skip_every / 2)
            continue;
        rain_streak(picture, x, y, 12 + (int)(noise >> 28),
                    (0.25f + 0.1f * (float)(noise >> 24 & 3)) * look.alpha_scale);
    }
}

#endif
