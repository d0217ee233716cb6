// Constants that both sides of a worker share. Only files of this folder include it.
#ifndef RG_HARNESS_DEVICES_WORKERS_INSIDE_H
#define RG_HARNESS_DEVICES_WORKERS_INSIDE_H

// The worker's descriptors of the channel's socket and page, after the three standard ones.
enum { RG_WORKER_SOCKET = 3, RG_WORKER_PAGE, RG_WORKER_FDS };
// The arguments after the program: RG_WORKER_ARGUMENT, and the harness's process id.
#define RG_WORKER_CHANNEL "%ld"
// The most logged lines in a reply; beyond that a worker keeps only one error.
enum { RG_WORKER_MOST_LINES = 1000 };

#endif
