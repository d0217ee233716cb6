// For tests: the effect of light y at point x.
#include "kernels/scenery/light.h"
#include "tests/kernels/scenery_lights_params.h"

#define RG_PARAMS test_scenery_lights_params
#define RG_SLOTS                                                                                   \
    IN(1, v3, points)                                                                              \
    IN(2, scenery_light, lights) SAMPLED(3, D32F, shadows, SHADOW) OUT(4, test_streaks_lit, lit)
#include "kernels/dialect/slots/slots.h"

#include "kernels/scenery/shadow.h"

RG_GRID_KERNEL(test_scenery_lights)
{
    scenery_light light = lights_at(rg, y);
    v3 at = points_at(rg, x);
    scenery_reach reach = scenery_light_reach(light, at);
    test_streaks_lit here;
    here.to_light = reach.to_light;
    here.share = reach.share;
    here.unshadowed = scenery_unshadowed(rg, light, at);
    here.soft = scenery_unshadowed_soft(rg, light, at);
    here.surface = scenery_unshadowed_soft(
        rg, light, scenery_off_surface(light, at, v3_make(0.0f, 1.0f, 0.0f)));
    lit_put(rg, y * p.points + x, here);
}
