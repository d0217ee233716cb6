// Memory that two processes share, which nothing names: it goes with the last process that has it.
// Unlike a file in memory it is under no limit on files' sizes (ulimit -f).
#ifndef RG_HARNESS_DEVICES_WORKERS_SEGMENT_H
#define RG_HARNESS_DEVICES_WORKERS_SEGMENT_H

#include <stdbool.h>
#include <stdint.h>

// Zeroed: none.
struct rg_segment {
    int id; // by which another process joins it while one has it
    void *bytes;
    int64_t size;
};

// Memory of at least so many bytes, zeroed; what the segment was before is let go. 0, or the errno.
int rg_segment_create(struct rg_segment *segment, int64_t size);
// Joins another process's, of whatever size that is. False where there is none, or it is not ours.
bool rg_segment_join(struct rg_segment *segment, int id);
// Lets it go.
void rg_segment_free(struct rg_segment *segment);

#endif
