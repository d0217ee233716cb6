#include "harness/devices/measure/sampling.h"

#include <math.h>
#include <stdlib.h>

#include "harness/devices/measure/measure.h"

// Longer frames are not slowed by another job's data in the caches.
#define LONG_FRAME_MS 100

bool rg_sampling_few(void)
{
    return getenv("RG_FEW_SAMPLES") != NULL;
}

bool rg_sampling_has_run_up(double frame_ms)
{
    return frame_ms < LONG_FRAME_MS;
}

struct rg_sampling rg_sampling_of(double frame_ms, int window_frames,
                                  const struct rg_measure_options *o)
{
    struct rg_sampling s = {.has_run_up = rg_sampling_has_run_up(frame_ms),
                            .passes_ms = rg_passes_expected_ms(frame_ms, o->passes_ms)};
    const double most_frames = window_frames ? window_frames - 1 : 100000;
    s.frames_a_sample = (int)fmin(fmax(ceil(o->sample_ms / frame_ms), 1), most_frames);
    const double sample_ms = frame_ms * (s.frames_a_sample + s.has_run_up);
    s.samples = (int)fmin(fmax(floor(o->job_ms / sample_ms), o->least_samples),
                          fmin(o->most_samples, RG_MAX_SAMPLES));
    return s;
}

double rg_sampling_ms(const struct rg_sampling *s, double frame_ms)
{
    return s->samples * (s->frames_a_sample + s->has_run_up) * frame_ms + s->passes_ms;
}
