// Four fixed pieces of work, each limited by another part of the machine. Their times make times of
// two machines, or of one that has changed, comparable.
//
// They run on the host, whatever the device is, because software devices are limited by the same
// parts. For a GPU they only show how fast its host is.
#ifndef RG_HARNESS_DEVICES_MEASURE_YARDSTICKS_H
#define RG_HARNESS_DEVICES_MEASURE_YARDSTICKS_H

#include <stdbool.h>

enum rg_yardstick {
    RG_YARDSTICK_CHAIN,  // scalar multiplications and additions, each dependent on the one before
    RG_YARDSTICK_VECTOR, // the same on vectors of four floats, twelve chains at a time
    RG_YARDSTICK_COPY,   // a copy of 64 MiB
    RG_YARDSTICK_FORK,   // a second thread is woken and waited for, repeatedly
};
enum { RG_YARDSTICKS = RG_YARDSTICK_FORK + 1 };

// "chain", "vector", "copy", "fork_join".
const char *rg_yardstick_name(enum rg_yardstick yardstick);

// Buffers for the yardsticks. Zero it before; false, and one logged line, when memory runs out or
// there is no second thread. The owner calls rg_yardsticks_close in either case.
struct rg_yardstick_room {
    void *from, *to; // 64 MiB each
    struct rg_fork *fork;
};
bool rg_yardsticks_open(struct rg_yardstick_room *room);
void rg_yardsticks_close(struct rg_yardstick_room *room);

// Runs one yardstick and returns its duration: some milliseconds.
double rg_yardstick_take(struct rg_yardstick_room *room, enum rg_yardstick yardstick);

#endif
