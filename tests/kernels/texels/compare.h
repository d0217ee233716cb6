// Compares a depth with a shadow map's: with one texel's, and softly with four. Elements of `at`
// are x and y in texels, the layer and the depth.
#include "tests/kernels/texels/params.h"

#define RG_PARAMS test_texels_params
#define RG_SLOTS  SAMPLED(1, D32F, shadows, SHADOW) IN(2, rgba, at) OUT(3, rgba, lit)
#include "kernels/dialect/slots/slots.h"

#include "kernels/scenery/shadow.h"

RG_GRID_KERNEL(test_compare)
{
    rgba at = at_at(rg, x);
    scenery_shadow_place place;
    place.layer = rg_to_int(at.b);
    place.x = at.r;
    place.y = at.g;
    place.depth = at.a;
    place.known = 1;
    float one = scenery_shadow_tap(rg, place, scenery_shadow_texel(at.r, p.width),
                                   scenery_shadow_texel(at.g, p.height));
    lit_put(rg, x, rg_rgba(one, scenery_shadow_soft(rg, place), 0.0f, 0.0f));
}
