// The options for measuring cells quickly, fully, and with the fewest samples.
#include "harness/devices/measure/calibration.h"
#include "harness/tables/measuring/measure.h"

// A median of fewer than 6 samples has no 95 % interval.
static const struct rg_measure_options quick = {.most_samples = 15,
                                                .least_samples = 6,
                                                .sample_ms = 15,
                                                .job_ms = 1000,
                                                .warm_up_ms = 250,
                                                .warm_up_frames = 4,
                                                .passes_ms = 400,
                                                .load = rg_calibration_load,
                                                .watch = rg_processors_now};
static const struct rg_measure_options full = {.most_samples = 61,
                                               .least_samples = 6,
                                               .sample_ms = 60,
                                               .job_ms = 2000,
                                               .warm_up_ms = 500,
                                               .warm_up_frames = 4,
                                               .passes_ms = 400,
                                               .load = rg_calibration_load,
                                               .watch = rg_processors_now};

// Long frames are warm after the checked frame and the counted one.
static const struct rg_measure_options few = {.most_samples = 6,
                                              .least_samples = 6,
                                              .sample_ms = 15,
                                              .warm_up_ms = 100,
                                              .warm_up_frames = 1,
                                              .passes_ms = 0,
                                              .load = rg_calibration_load,
                                              .watch = rg_processors_now};

const struct rg_measure_options *rg_table_few_samples(void)
{
    return &few;
}

const struct rg_measure_options *rg_table_options(bool is_full)
{
    return is_full ? &full : &quick;
}
