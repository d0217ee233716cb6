// How cells of each length are measured.
#include "harness/measure/calibration.h"
#include "harness/tables/measuring/measure.h"

// Of fewer than 6 samples a median has no interval of 95 %.
static const struct rg_measure_options quick = {.most_samples = 15,
                                                .least_samples = 6,
                                                .sample_ms = 15,
                                                .job_ms = 1000,
                                                .warm_up_ms = 250,
                                                .warm_up_frames = 4,
                                                .passes_ms = 400,
                                                .load = rg_calibration_load};
static const struct rg_measure_options full = {.most_samples = 61,
                                               .least_samples = 6,
                                               .sample_ms = 60,
                                               .job_ms = 2000,
                                               .warm_up_ms = 500,
                                               .warm_up_frames = 4,
                                               .passes_ms = 400,
                                               .load = rg_calibration_load};

// Frames that are long are warm after the one that is checked and the one that is counted.
static const struct rg_measure_options few = {.most_samples = 6,
                                              .least_samples = 6,
                                              .sample_ms = 15,
                                              .warm_up_ms = 100,
                                              .warm_up_frames = 1,
                                              .passes_ms = 0,
                                              .load = rg_calibration_load};

const struct rg_measure_options *rg_table_few_samples(void)
{
    return &few;
}

const struct rg_measure_options *rg_table_options(bool is_full)
{
    return is_full ? &full : &quick;
}
