// A step of the splashes: each shows six textures, for the same time each, and fades to its end.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS  IN(1, uint, living) INOUT(2, cartoon_spray, sprays) ATOMIC(3, uint, tally)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(cartoon_age)
{
    int slot = rg_to_int(living_at(rg, p.drop_slots + x));
    cartoon_spray s = sprays_at(rg, slot);
    s.age = s.age + 1;
    s.texture = rg_imin(s.age * CARTOON_FRAMES / p.spray_steps, CARTOON_FRAMES - 1);
    s.alpha = 1.0f - rg_to_float(s.age) / rg_to_float(p.spray_steps);
    if (s.age >= p.spray_steps) {
        s.state = CARTOON_DEATH;
        tally_add(rg, CARTOON_SPRAY_ENDED, 1u);
    }
    sprays_put(rg, slot, s);
}
