#include "harness/tables/measuring/cell.h"

#include <math.h>

#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/expected.h"
#include "harness/devices/measure/sampling.h"

int rg_cell_check_frames(const struct rg_table *table)
{
    return table->check_frames ? table->check_frames : RG_CHECK_FRAMES;
}

int rg_cell_steps(const struct rg_table *table)
{
    return (int)fmax(rg_cell_check_frames(table) - 2, 1);
}

double rg_cell_image_ms(const struct rg_table *table, const struct rg_cell_frames *f)
{
    return f->open_ms + (rg_cell_check_frames(table) - 1) * f->step_ms + f->frame_ms;
}

// Simulates steps, but not for long: this must not take as long as the measurement that it
// predicts.
static bool simulate(struct rg_session *session, int steps, double *step_ms)
{
    enum { LONGEST_MS = 4000 };
    const double start = rg_now_ms();
    double passed_ms = 0;
    bool ok = true;
    int done = 0;
    while (ok && done < steps && passed_ms < LONGEST_MS && !rg_interrupted()) {
        ok = rg_session_step(session) && rg_session_sync(session);
        passed_ms = rg_now_ms() - start;
        done++;
    }
    *step_ms = passed_ms / fmax(done, 1);
    return ok;
}

// Opening draws the first frame, in which drivers compile, so the second one is timed.
struct rg_session *rg_cell_look(struct rg_device *device, const struct rg_subject *subject,
                                int steps, struct rg_cell_frames *f)
{
    const double start = rg_now_ms();
    struct rg_session *session = rg_session_run(device, subject, 1);
    const double opened = rg_now_ms();
    if (!session)
        return NULL;
    bool ok = rg_session_frames(session, 1, &f->frame_ms);
    f->open_ms = fmax(opened - start - f->frame_ms, 0);
    ok = ok && simulate(session, steps, &f->step_ms) &&
         (steps == 1 || rg_session_frames(session, 1, &f->frame_ms));
    if (ok)
        return session;
    rg_session_close(session);
    return NULL;
}

// The time for opening the instance again each time it has used up its window of frames.
static double reopen_ms(const struct rg_table *table, const struct rg_cell_frames *f, double frames)
{
    if (!table->window_frames)
        return 0;
    return floor(frames / table->window_frames) * rg_cell_image_ms(table, f);
}

// Long frames end the warm-up when its time is over; short ones end it once they are steady, which
// they are after the check frames.
static double warm_up_frames(double ms, const struct rg_measure_options *o)
{
    return fmin(fmax(o->warm_up_frames, 1), floor(o->warm_up_ms / ms) + 1);
}

// Only the first and the last of the check frames are drawn; the others are simulated.
static double check_ms(const struct rg_table *table, const struct rg_cell_frames *f)
{
    const int frames = rg_cell_check_frames(table);
    return f->open_ms + f->frame_ms + fmax(frames - 2, 0) * f->step_ms + (frames > 1) * f->frame_ms;
}

double rg_cell_ms(const struct rg_table *table, const struct rg_cell_frames *f,
                  const struct rg_measure_options *o)
{
    const double ms = fmax(f->frame_ms, 1e-3);
    const struct rg_sampling sampling = rg_sampling_of(ms, table->window_frames, o);
    const double calibration = ms < o->sample_ms ? 4 : 0;
    const double frames =
        1 + warm_up_frames(ms, o) + calibration + rg_sampling_ms(&sampling, ms) / ms;
    return check_ms(table, f) + frames * ms + reopen_ms(table, f, frames);
}
