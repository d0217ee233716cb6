// Particles of cartoon's rain, and the parameters of its kernels (Feng et al., sections 3 to 5).
//
// Lengths are in metres, times in steps of step_s seconds. A particle keeps its slot for as long as
// it lives; the slots of dead ones are used again (life/list.h).
#ifndef RG_KERNELS_CARTOON_RAIN_PARAMS_H
#define RG_KERNELS_CARTOON_RAIN_PARAMS_H

#include "kernels/dialect/matrix.h"

// States of a particle. A slot of zeroes is free.
#define CARTOON_DEATH     0u
#define CARTOON_DROP      1u
#define CARTOON_COLLISION 2u // it has hit in this step
#define CARTOON_STICKED   3u // it fades where it hit

// A raindrop (the paper's particle1).
RG_STRUCT(cartoon_raindrop)
{
    float x; // position
    float y;
    float z;
    float vx; // velocity
    float vy;
    float vz;
    float ax; // acceleration
    float ay;
    float az;
    float from_x; // its place a step before
    float from_y;
    float from_z;
    float alpha;
    float size;  // 0 the lightest, 1 the heaviest
    int age;     // since it was released
    int stuck;   // since it hit
    uint number; // of drops released before it, modulo 2^32
    uint state;
};
RG_STRUCT_SIZE(cartoon_raindrop, 18)

// A splash (the paper's particle2).
RG_STRUCT(cartoon_spray)
{
    float x;
    float y;
    float z;
    float nx; // normal of the surface
    float ny;
    float nz;
    float weight; // the drop's size
    float alpha;
    float angle; // between the normal and where the drop came from, radians
    int pattern; // by the angle
    int texture; // of the CARTOON_FRAMES of its life
    int age;
    uint state; // CARTOON_DROP: it lives
};
RG_STRUCT_SIZE(cartoon_spray, 13)

// The surface that a drop has hit.
RG_STRUCT(cartoon_surface)
{
    float nx;
    float ny;
    float nz;
    float angle;
};
RG_STRUCT_SIZE(cartoon_surface, 4)

// Words of the tally: drops that were released, found no slot, hit, left, and faded; splashes that
// were made, found no slot, and ended.
#define CARTOON_RELEASED      0
#define CARTOON_REFUSED       1
#define CARTOON_HITS          2
#define CARTOON_LEFT          3
#define CARTOON_FADED         4
#define CARTOON_SPLASHED      5
#define CARTOON_SPRAY_REFUSED 6
#define CARTOON_SPRAY_ENDED   7
#define CARTOON_TALLY         8

// Streams of random numbers.
#define CARTOON_START    0u
#define CARTOON_DOWN     1u
#define CARTOON_GUST     2u
#define CARTOON_GUST_WAY 3u

#define CARTOON_DRAG_CONSTANT  0
#define CARTOON_DRAG_QUADRATIC 1

#define CARTOON_COLLIDE_FAITHFUL 0 // too few samples are seen, whatever hides them
#define CARTOON_COLLIDE_CORRECT  1 // the drop's middle passes the surface that is seen there
#define CARTOON_COLLIDE_ANY      2 // no sample is seen

#define CARTOON_DROP_TEXTURES 3 // light, middle, heavy
#define CARTOON_PATTERNS      3 // of splashes
#define CARTOON_FRAMES        6 // textures of a splash's life

RG_STRUCT(cartoon_rain_params)
{
    m4 to_clip; // from the world
    // the slots
    int drop_slots;
    int spray_slots;
    uint seed;
    // the lists of this step, before anything was created
    int free_drops;
    int free_sprays;
    // the release
    int released;
    uint released_before;
    float low_x;
    float low_y;
    float low_z;
    float wide_x; // of the space in which drops start
    float wide_y;
    float wide_z;
    float speed_m_s;  // of the heaviest
    float slow;       // share of it that the lightest have
    float spread_cos; // of the cone about down
    // the motion
    float step_s;
    float gravity_m_s2;
    int drag;
    float drag_m_s2; // constant
    float drag_1_m;  // quadratic
    float push_x;    // of the wind: with constant drag an acceleration, with quadratic its speed
    float push_z;
    float floor_m; // drops below it have left
    int life_steps;
    int fade_steps;
    int spray_steps;
    // collisions
    int collide;
    int least_samples;
    float bound_m; // radius of a drop's bounding sphere
    float precision_m;
    // the view
    int width;
    int height;
    float focal_px; // of a metre at a distance of a metre
    float depth_at; // depth = depth_at + depth_by / distance
    float depth_by;
    float eye_x;
    float eye_y;
    float eye_z;
    float right_x; // of the eye space
    float right_y;
    float right_z;
    float up_x;
    float up_y;
    float up_z;
    // the pictures
    float drop_m;   // side of the square of the heaviest drop
    float splash_m; // and of its splash
    float least;    // share of both that the lightest have
    int textures;   // levels of an image of textures
    int cut;        // 1: sprites are cut to the rectangle that is not transparent
    int facets;     // items that a drop's tessellated sphere takes
    int late;       // 1: the answers are those to the queries of the step before
};
RG_STRUCT_SIZE(cartoon_rain_params, 16 + 52)

#endif
