// streaks: writes the frame's particles, so that states can be compared. Each has
// STREAKS_STATE_WORDS words: x, y, s, hit height, age, state, the material of the surface hit,
// oscillation + turn, radius in metres, and the number of drops that it stands for.
#include "kernels/streaks/params.h"

#define RG_PARAMS streaks_params
#define RG_SLOTS                                                                                   \
    IN(1, float, particles)                                                                        \
    IN(2, uint, blocks)                                                                            \
    IMAGE(3, D32F, depths)                                                                         \
    OUT(4, float, places) IMAGE(10, RGBA8, numbers) IN(11, uint, surfaces)
#include "kernels/dialect/slots/slots.h"

#include "kernels/streaks/material.h"

RG_GRID_KERNEL(streaks_state)
{
    streaks_particle t = streaks_particle_at(rg, p, x);
    int material = streaks_material(rg, p, t);
    int word = STREAKS_STATE_WORDS * (p.first_place + x);
    bool seen = t.state != STREAKS_NOTHING;
    places_put(rg, word, seen ? t.x : 0.0f);
    places_put(rg, word + 1, seen ? t.y : 0.0f);
    places_put(rg, word + 2, seen ? t.s : 0.0f);
    places_put(rg, word + 3, seen ? t.hit : 0.0f);
    places_put(rg, word + 4, t.state == STREAKS_SPLASH ? t.age : 0.0f);
    places_put(rg, word + 5, rg_to_float(t.state));
    places_put(rg, word + 6, seen ? rg_to_float(material) : 0.0f);
    places_put(rg, word + 7, seen ? rg_to_float(t.oscillation) + streaks_turn(p, t) : 0.0f);
    places_put(rg, word + 8, seen ? p.drop_radius * t.radius : 0.0f);
    places_put(rg, word + 9, seen ? t.weight : 0.0f);
}
