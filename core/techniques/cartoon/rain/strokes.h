// Pictures of a few brush strokes with an inked outline, which look drawn by hand.
#ifndef RG_CORE_TECHNIQUES_CARTOON_RAIN_STROKES_H
#define RG_CORE_TECHNIQUES_CARTOON_RAIN_STROKES_H

#include "kernels/cartoon/rain/params.h"

// A straight brush stroke whose radius changes linearly. Places and radii are in widths of the
// picture, from its upper left corner.
struct stroke {
    double x0, y0, r0, x1, y1, r1;
};

enum { STROKES = 96 };

struct strokes {
    int count;
    struct stroke all[STROKES];
    double ink;    // width of the outline
    double wobble; // fraction by which the brush's width varies
};

// Adds a stroke; when the list is full, it is dropped.
void strokes_add(struct strokes *s, double x0, double y0, double r0, double x1, double y1,
                 double r1);
// A texture of a light, middle or heavy drop, which falls towards y = 1.
void strokes_of_drop(struct strokes *s, int weight);
// A texture of a splash's pattern at a moment of its life: in the middle, its top towards y = 0.
void strokes_of_splash(struct strokes *s, int pattern, int texture);
// Paints strokes onto `px` x `px` texels, premultiplied, linear.
void strokes_paint(const struct strokes *s, int px, rgba *texels);

#endif
