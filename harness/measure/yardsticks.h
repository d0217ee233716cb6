// Four pieces of work that are always the same, each bound by another part of a machine: by how
// long they take, times of two machines, or of one that has changed, are laid beside each other.
//
// They run on the host, whatever the device is: software devices are bound by the same parts. What
// they tell of a GPU is how fast its host is.
#ifndef RG_HARNESS_MEASURE_YARDSTICKS_H
#define RG_HARNESS_MEASURE_YARDSTICKS_H

#include <stdbool.h>

enum rg_yardstick {
    RG_YARDSTICK_CHAIN,  // scalar multiplications and additions, each of which waits for the last
    RG_YARDSTICK_VECTOR, // the same on vectors of four floats, twelve of them side by side
    RG_YARDSTICK_COPY,   // a copy of 64 MiB
    RG_YARDSTICK_FORK,   // a second thread is woken, and waited for, over and over
};
enum { RG_YARDSTICKS = RG_YARDSTICK_FORK + 1 };

// "chain", "vector", "copy", "fork_join".
const char *rg_yardstick_name(enum rg_yardstick yardstick);

// What they work on. Zeroed before; false, and one logged line, without memory or a second thread.
// The owner calls rg_yardsticks_close in either case.
struct rg_yardstick_room {
    void *from, *to; // 64 MiB each
    struct rg_fork *fork;
};
bool rg_yardsticks_open(struct rg_yardstick_room *room);
void rg_yardsticks_close(struct rg_yardstick_room *room);

// Runs one, and returns how long it took: some milliseconds.
double rg_yardstick_take(struct rg_yardstick_room *room, enum rg_yardstick yardstick);

#endif
