// What a cell of a table is expected to take, by what its frames take.
#ifndef RG_HARNESS_TABLES_MEASURING_CELL_H
#define RG_HARNESS_TABLES_MEASURING_CELL_H

#include "harness/measure/job.h"
#include "harness/tables/papers/published.h"

// The frames before its image is compared.
int rg_cell_check_frames(const struct rg_table *table);

// What opening an instance takes, simulating a frame, and a frame that is drawn too; all in
// milliseconds.
struct rg_cell_frames {
    double open_ms, step_ms, frame_ms;
};

// Opens a subject and finds them by two frames, so many steps, of which each takes what all do on
// average, and behind more than one a third frame: where rain builds up, the last takes the
// longest. After four seconds no more steps follow. The caller closes the session. NULL, and one
// logged line, on failure.
struct rg_session *rg_cell_look(struct rg_device *device, const struct rg_subject *subject,
                                int steps, struct rg_cell_frames *frames);
// The steps behind which the third frame is like those that are timed.
int rg_cell_steps(const struct rg_table *table);

// What a cell takes, in milliseconds: opening, the frames before its image is compared, the one
// that is counted, warming up, samples with a frame before each, and the passes told apart.
double rg_cell_ms(const struct rg_table *table, const struct rg_cell_frames *frames,
                  const struct rg_measure_options *options);
// What an image that others are compared with takes: it is opened, simulated and drawn once.
double rg_cell_image_ms(const struct rg_table *table, const struct rg_cell_frames *frames);

#endif
