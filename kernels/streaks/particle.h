// A particle's place and state: a drop, a splash, or nothing (Creus, sections 4.2 and 4.4).
// Programs and kernels include this file after their slots, which have
//   IN(1, float, particles)  x and y in the rain space's clip coordinates, and oscillation + start
//   IN(2, uint, blocks)      the classes of sizes, then blocks of STREAKS_BLOCK_WORDS each
//   IMAGE(3, D32F, depths)   the scene seen along the fall
#ifndef RG_KERNELS_STREAKS_PARTICLE_H
#define RG_KERNELS_STREAKS_PARTICLE_H

#include "kernels/streaks/hit.h"
#include "kernels/streaks/size.h"

RG_STRUCT(streaks_particle)
{
    float x;
    float y;
    float s;   // of the drop, as if there were no scene
    float hit; // s of the first surface below the particle's place on the top plane
    float age; // of a splash, in seconds
    int oscillation;
    int state;
    uint number; // in its buffer
    // Values of its class, relative to the settings' drop.
    float radius;
    float speed;
    float swing;  // frequency
    float weight; // drops that it stands for
};

// The height of a streak's upper end above the drop. It is p.behind to the bit for the settings'
// drop.
RG_FN float streaks_behind(streaks_params p, streaks_particle t)
{
    return p.behind + p.fall * (t.speed - 1.0f) + p.drop_radius * (t.radius - 1.0f);
}

// A particle's state, by how far its streak's upper end is `past` the surface it hits. A particle
// that leaves the local ground comes in again at the local top. If its splash is not over by then,
// it stays a splash. So each drop that hits makes one splash, and all splashes last equally long.
RG_FN streaks_particle streaks_state(streaks_params p, streaks_particle particle)
{
    streaks_particle t = particle;
    float fall_speed = p.fall_speed * t.speed;
    float past = (t.s - streaks_behind(p, t)) - t.hit;
    int falling = streaks_below(past, 0.0f);
    float since = past + rg_to_float(falling) * p.local_height;
    float lasts = rg_min(p.splash_s * fall_speed, p.local_height);
    int splash = (1 - streaks_below(since, 0.0f)) & streaks_below(since, lasts) &
                 streaks_below(t.hit, p.top + p.local_height);
    t.age = since / fall_speed;
    t.state =
        splash * p.splashes * STREAKS_SPLASH + (1 - splash) * falling * p.drops * STREAKS_DROP;
    return t;
}

// The values that the particles of a block share.
RG_STRUCT(streaks_block)
{
    uint first;   // particle
    uint counted; // a bit for each
    float shift_x;
    float shift_y;
    float turn;
};

RG_FN streaks_block streaks_block_at(rg_ctx rg, streaks_params p, int i)
{
    int word = p.sizes * STREAKS_SIZE_WORDS + i * STREAKS_BLOCK_WORDS;
    streaks_block b;
    b.first = blocks_at(rg, word);
    b.counted = blocks_at(rg, word + 1);
    b.shift_x = rg_bits_float(blocks_at(rg, word + 2));
    b.shift_y = rg_bits_float(blocks_at(rg, word + 3));
    b.turn = rg_bits_float(blocks_at(rg, word + 4));
    return b;
}

RG_FN streaks_particle streaks_particle_of(rg_ctx rg, streaks_params p, streaks_block b,
                                           int in_block)
{
    uint number = b.first + rg_to_uint(in_block);
    int size = streaks_size_class(number, p.sizes) * STREAKS_SIZE_WORDS;
    int at = 3 * rg_to_int(number);
    float both = particles_at(rg, at + 2);
    float oscillation = rg_floor(both);
    float fallen = (both - oscillation) + b.turn + rg_bits_float(blocks_at(rg, size + 4));
    streaks_particle t;
    t.x = (particles_at(rg, at) + b.shift_x) * p.half_x;
    t.y = (particles_at(rg, at + 1) + b.shift_y) * p.half_y;
    t.s = p.top + p.local_height * (fallen - rg_floor(fallen));
    t.oscillation = rg_to_int(oscillation);
    t.number = number;
    t.radius = rg_bits_float(blocks_at(rg, size));
    t.speed = rg_bits_float(blocks_at(rg, size + 1));
    t.swing = rg_bits_float(blocks_at(rg, size + 2));
    t.weight = rg_bits_float(blocks_at(rg, size + 3));
    streaks_map_place under =
        streaks_map_place_at(p, t.x, t.y, depths_width(rg, 0), depths_height(rg, 0));
    t.hit = streaks_hit(rg, p, under);
    t.age = 0.0f;
    t = streaks_state(p, t);
    int counted = rg_to_int((b.counted >> rg_to_uint(in_block)) & 1u);
    float away = rg_max(rg_abs(t.x - p.eye_x), rg_abs(t.y - p.eye_y));
    t.state = t.state * counted * (1 - p.exact * streaks_below(p.radius, away)) *
              (1 - p.around * under.outside);
    return t;
}

RG_FN streaks_particle streaks_particle_at(rg_ctx rg, streaks_params p, int i)
{
    return streaks_particle_of(rg, p, streaks_block_at(rg, p, i >> 5), i & 31);
}

// The fractional part.
RG_FN float streaks_part(float cycles)
{
    return cycles - rg_floor(cycles);
}

// The turn of a drop's swing as it falls, 0 to 1; each drop has a phase of its own.
RG_FN float streaks_turn(streaks_params p, streaks_particle t)
{
    float begin = rg_to_float(rg_to_int(streaks_hash(t.number) & 1023u)) / 1024.0f;
    return streaks_part(t.s * (p.cycles_per_m * (t.swing / t.speed)) + begin);
}

#endif
