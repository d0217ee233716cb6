// A step of shower: particles move and die; then new ones are born up to the expected number
// (section II), or the dead are promoted (section III.D).
#include <math.h>
#include <string.h>

#include "core/techniques/shower/instance.h"
#include "kernels/dialect/rng.h"

// The number of particles by eq. 1. R0 is uniform in [-1, 1).
static int wanted_at(const struct shower_settings *s, int64_t frame)
{
    const rg_uint4 words = rg_random((uint32_t)s->seed, 0, (uint32_t)frame, SHOWER_NUMBER);
    const double r0 = 2 * (double)rg_uniform(words.x) - 1;
    return s->particles + (int)floor(r0 * s->variation * s->particles + 0.5);
}

// The wind of a frame (eqs. 9 and 11), with gusts.
static void set_wind(struct shower *s, int64_t frame)
{
    const struct shower_settings *set = &s->settings;
    const double phase = 2 * M_PI * set->step_s * (double)frame / set->gust_s;
    const double speed = set->wind_m_s * (1 + set->gust * sin(phase));
    s->params.wind_x = (float)(speed * cos(set->wind_deg * M_PI / 180));
    s->params.wind_z = (float)(speed * sin(set->wind_deg * M_PI / 180));
}

static bool renew_by_birth(struct shower *s)
{
    return rg_scan_compact(s->scan, s->marks->buf, s->unused->buf, s->found->buf,
                           s->params.slots) &&
           rg_stage(&s->base, s->first_stage + SHOWER_RUN_BEAR);
}

static bool renew_by_promotion(struct shower *s)
{
    const uint32_t none = 0;
    const int chunks = (s->params.slots + SHOWER_CHUNK - 1) / SHOWER_CHUNK;
    return rg_buf_write(s->counts->buf, SHOWER_ALIVE * 4, &none, sizeof(none)) &&
           rg_stage_over(&s->base, s->first_stage + SHOWER_RUN_PROMOTE, (struct rg_extent){0, 0, 0},
                         (struct rg_extent){chunks, 1, 1});
}

// Advances the counters by the tally's increase, whose words are modulo 2^32.
static bool count(struct shower *s)
{
    static const int words[] = {SHOWER_BORN, SHOWER_DIED, SHOWER_RAISED, SHOWER_PASSED,
                                SHOWER_PLACED};
    uint32_t tally[SHOWER_TALLY];
    if (!rg_buf_read(s->counts->buf, 0, tally, sizeof(tally)))
        return false;
    for (int i = 0; i < SHOWER_COUNT_DRAWN; i++)
        s->base.counters[i].value += (uint32_t)(tally[words[i]] - s->tally[words[i]]);
    memcpy(s->tally, tally, sizeof(tally));
    return true;
}

bool shower_step(struct rg_instance *instance)
{
    struct shower *s = (struct shower *)instance;
    const int64_t frame = instance->frame++;
    s->params.step = (uint32_t)frame;
    s->params.wanted = wanted_at(&s->settings, frame);
    set_wind(s, frame);
    if (!shower_look(s, instance->frame))
        return false;
    if (s->heap)
        return shower_heap_step(s) && count(s);
    return rg_stage(instance, s->first_stage + SHOWER_RUN_MOVE) &&
           (s->params.is_promoted ? renew_by_promotion(s) : renew_by_birth(s)) && count(s);
}
