// A splash as one pixel sees it, in double precision, written from the animation's synthesis
// (docs/atlas.md) and from optics; nothing of kernels/ is included. All lengths are metres.
#ifndef RG_TESTS_CORE_TECHNIQUES_STREAKS_SPLASH_CROWN_H
#define RG_TESTS_CORE_TECHNIQUES_STREAKS_SPLASH_CROWN_H

#include <stdbool.h>
#include <stdint.h>

enum { CROWN_FRAMES = 21, CROWN_WIDE = 48, CROWN_TALL = 32, CROWN_LEVELS = 6 };

// The opacity of one material: frames, each with its halved pictures, row 0 on top.
struct crown_film {
    double texels[CROWN_FRAMES][CROWN_LEVELS][CROWN_TALL * CROWN_WIDE];
};

struct crown_eye {
    double clip[16]; // from the world
    double at[3];
    double focal_px; // pixels a metre at a distance of one
    int width, height;
};

struct crown_splash {
    const struct crown_film *film;
    double foot[3], up[3]; // where the drop hit, and the normal there
    double wide, lasts_s;  // of the picture of a drop of the usual size, and of its animation
    double age_s, drops;   // drops: for how many it stands
    double size;           // of its drop, in the usual drop's
    uint32_t number;
};

// What a pixel sees of a splash.
struct crown_pixel {
    double cover; // what it hides, 0 to 1 for one drop
    double at[3]; // in the world
    // What lies before it by less than this share of the distance does not hide it.
    double near_by;
};

// Fills the halved pictures from the first.
void crown_halve(struct crown_film *film, int frame);
// Columns from box[0] up to box[2] and rows from box[1] up to box[3] hold all that is seen of it.
void crown_reach(const struct crown_eye *eye, const struct crown_splash *splash, int box[4]);
// False where the splash's picture does not reach.
bool crown_seen(const struct crown_eye *eye, const struct crown_splash *splash, int x, int y,
                struct crown_pixel *pixel);
// Whether a plane through a place hides what a pixel sees.
bool crown_hidden(const struct crown_eye *eye, const struct crown_pixel *pixel,
                  const double place[3], const double normal[3]);

#endif
