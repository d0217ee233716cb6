#include "tests/oracle/particle.h"

#include <math.h>

static void keep_least(double *least, double value)
{
    if (fabs(value) < *least)
        *least = fabs(value);
}

// One life of a particle: it enters at the top, passes the local ground, and goes on unseen. Its
// drop is seen until its streak's end has passed the surface. From then on its splash is seen, if
// the surface is above the local ground.
static void live(const struct particle_space *space, double s, double hit,
                 struct particle_seen *seen, int present)
{
    const double below_m = s - space->streak - hit;
    const double age_s = below_m / space->speed;
    const double ground = space->top + space->height;
    const double lasts_s = fmin(space->splash_s, space->height / space->speed);
    keep_least(&seen->margin_m, below_m);
    keep_least(&seen->margin_m, below_m - lasts_s * space->speed);
    if (below_m >= 0 && age_s < lasts_s && hit < ground) {
        seen->state = PARTICLE_SPLASH;
        seen->age_s = age_s;
    } else if (present && below_m < 0) {
        seen->state = PARTICLE_DROP;
    }
}

struct particle_seen particle_oracle(const struct particle_space *space, double x, double y,
                                     double start, double run, double hit)
{
    struct particle_seen seen = {.x = x * space->half_x, .y = y * space->half_y, .margin_m = 1e9};
    const double fallen = fmod(start + run, 1) * space->height;
    seen.s = space->top + fallen;
    keep_least(&seen.margin_m, fallen);
    keep_least(&seen.margin_m, space->height - fallen);
    keep_least(&seen.margin_m, hit - space->top - space->height);
    live(space, seen.s, hit, &seen, 1);
    live(space, seen.s + space->height, hit, &seen, 0); // the splash of the life before goes on
    const double away = fmax(fabs(seen.x - space->eye_x), fabs(seen.y - space->eye_y));
    if (space->exact) {
        keep_least(&seen.margin_m, away - space->radius);
        if (away > space->radius)
            seen.state = PARTICLE_NOTHING;
    }
    return seen;
}
