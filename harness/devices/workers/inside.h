// What both sides of a worker agree on. Only files of this folder may include this.
#ifndef RG_HARNESS_DEVICES_WORKERS_INSIDE_H
#define RG_HARNESS_DEVICES_WORKERS_INSIDE_H

// The channel's socket and its page in the worker's process, behind the three descriptors that
// every process has.
enum { RG_WORKER_SOCKET = 3, RG_WORKER_PAGE, RG_WORKER_FDS };
// Its arguments behind the program: RG_WORKER_ARGUMENT, and the harness's process.
#define RG_WORKER_CHANNEL "%ld"
// A reply has at most so many lines that were logged: beyond them a worker keeps none but one
// error.
enum { RG_WORKER_MOST_LINES = 1000 };

#endif
