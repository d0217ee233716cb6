// Predicts how long a cell of a table takes, from the times of a few frames.
#ifndef RG_HARNESS_TABLES_MEASURING_CELL_H
#define RG_HARNESS_TABLES_MEASURING_CELL_H

#include "harness/devices/measure/job.h"
#include "harness/tables/papers/published.h"

// The number of frames before a cell's image is compared.
int rg_cell_check_frames(const struct rg_table *table);

// Milliseconds to open an instance, to simulate a frame, and to simulate and draw one.
struct rg_cell_frames {
    double open_ms, step_ms, frame_ms;
};

// Opens a subject and measures these times: two frames, then `steps` steps and, after more than
// one, a third frame, because frames take longer while rain builds up. Steps end after four
// seconds; step_ms is their average. The caller closes the session. NULL, and one logged line, on
// failure.
struct rg_session *rg_cell_look(struct rg_device *device, const struct rg_subject *subject,
                                int steps, struct rg_cell_frames *frames);
// The number of steps after which the third frame resembles the timed ones.
int rg_cell_steps(const struct rg_table *table);

// Milliseconds that a cell takes: opening, check frames, the counting frame, warm-up, samples with
// a frame before each, and the separate timing of passes.
double rg_cell_ms(const struct rg_table *table, const struct rg_cell_frames *frames,
                  const struct rg_measure_options *options);
// Milliseconds for a reference image: opening, simulating and drawing it once.
double rg_cell_image_ms(const struct rg_table *table, const struct rg_cell_frames *frames);

#endif
