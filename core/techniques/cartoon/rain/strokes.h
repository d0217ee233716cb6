// Pictures of a few brush strokes with an inked outline, as a hand would draw rain.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_STROKES_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_STROKES_H

#include "kernels/cartoon/rain/params.h"

// A brush goes straight from one place to another, and its radius changes evenly. Places are 0 to
// 1, from the picture's upper left corner; so are radii.
struct stroke {
    double x0, y0, r0, x1, y1, r1;
};

enum { STROKES = 96 };

struct strokes {
    int count;
    struct stroke all[STROKES];
    double ink;    // width of the outline
    double wobble; // share by which the brush's width strays
};

// What is one too many is left out.
void strokes_add(struct strokes *s, double x0, double y0, double r0, double x1, double y1,
                 double r1);
// One of the drops' textures, of the light, the middle and the heavy ones: it falls towards y = 1.
void strokes_of_drop(struct strokes *s, int weight);
// A splash of a pattern, at a texture of its life: it stands in the middle, its top towards y = 0.
void strokes_of_splash(struct strokes *s, int pattern, int texture);
// Paints them: `px` x `px` texels, premultiplied, linear.
void strokes_paint(const struct strokes *s, int px, rgba *texels);

#endif
