// What was done on a device since it was opened.
#ifndef RG_CORE_DEVICE_WORK_H
#define RG_CORE_DEVICE_WORK_H

#include <stdint.h>

struct rg_work {
    int64_t runs;                      // pass runs asked for
    int64_t dispatches;                // pass runs after folding
    int64_t items;                     // items run
    int64_t bytes_written, bytes_read; // between host and device
    int64_t live_buffers, live_images, live_passes;
    int64_t live_bytes; // of buffers and images
};

#endif
