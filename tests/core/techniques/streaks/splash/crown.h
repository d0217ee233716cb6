// A splash as one pixel sees it, in double precision, from the animation's synthesis
// (docs/atlas.md) and from optics, without including kernels/. Lengths are in metres.
#ifndef RG_TESTS_CORE_TECHNIQUES_STREAKS_SPLASH_CROWN_H
#define RG_TESTS_CORE_TECHNIQUES_STREAKS_SPLASH_CROWN_H

#include <stdbool.h>
#include <stdint.h>

enum { CROWN_FRAMES = 21, CROWN_WIDE = 48, CROWN_TALL = 32, CROWN_LEVELS = 6 };

// The shares of one material, of light from above: frames, each with its halved pictures; row 0 is
// on top.
struct crown_film {
    double texels[CROWN_FRAMES][CROWN_LEVELS][CROWN_TALL * CROWN_WIDE];
};

struct crown_eye {
    double clip[16]; // from the world
    double at[3];
    double focal_px; // pixels a metre at a distance of one metre
    int width, height;
};

struct crown_splash {
    const struct crown_film *film;
    double foot[3], up[3]; // the place of the hit, and the normal there
    double wide, lasts_s;  // the picture's width for a usual drop, and the animation's length
    double age_s, drops;   // drops: how many drops it stands for
    double size;           // of its drop, over the usual drop's
    uint32_t number;
};

// A splash as a pixel sees it.
struct crown_pixel {
    double cover;     // the share that it hides, 0 to 1 for one drop
    double at[3];     // in the world
    double middle[3]; // of the splash's picture
    // Surfaces in front of it by less than this share of the distance do not hide it.
    double near_by;
};

// Fills the halved pictures from the first one.
void crown_halve(struct crown_film *film, int frame);
// All visible parts are in columns from box[0] up to box[2], and rows from box[1] up to box[3].
void crown_reach(const struct crown_eye *eye, const struct crown_splash *splash, int box[4]);
// False if the splash's picture does not cover the pixel.
bool crown_seen(const struct crown_eye *eye, const struct crown_splash *splash, int x, int y,
                struct crown_pixel *pixel);
// Whether a plane through a place hides what a pixel sees.
bool crown_hidden(const struct crown_eye *eye, const struct crown_pixel *pixel,
                  const double place[3], const double normal[3]);

#endif
