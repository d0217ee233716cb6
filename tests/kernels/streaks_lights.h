// What light y does at point x: for tests.
#include "kernels/scenery/light.h"
#include "tests/kernels/streaks_lights_params.h"

#define RG_PARAMS test_streaks_lights_params
#define RG_SLOTS                                                                                   \
    IN(1, v3, points)                                                                              \
    IN(2, streaks_light, lights) IMAGE(3, D32F, shadows) OUT(4, test_streaks_lit, lit)
#include "kernels/dialect/slots/slots.h"

#include "kernels/scenery/shadow.h"

RG_GRID_KERNEL(test_streaks_lights)
{
    streaks_light light = lights_at(rg, y);
    v3 at = points_at(rg, x);
    streaks_reach reach = streaks_light_reach(light, at);
    test_streaks_lit here;
    here.to_light = reach.to_light;
    here.share = reach.share;
    here.unshadowed = streaks_unshadowed(rg, light, at);
    here.soft = streaks_unshadowed_soft(rg, light, at);
    here.surface = streaks_unshadowed_soft(
        rg, light, streaks_off_surface(light, at, v3_make(0.0f, 1.0f, 0.0f)));
    lit_put(rg, y * p.points + x, here);
}
