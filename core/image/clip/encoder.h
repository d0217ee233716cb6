// vpxenc as a process: frames go in as Y4M, a WebM file in memory comes out.
//
// What it prints is shown to nobody, but for its last line where it failed.
#ifndef RG_CORE_IMAGE_CLIP_ENCODER_H
#define RG_CORE_IMAGE_CLIP_ENCODER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

struct rg_encoder {
    const char *name;   // the clip's, for messages
    bool (*stop)(void); // asked while it is waited for: true gives up, and nothing is logged; NULL:
                        // never
    double patience_s;  // 0: without end
    double since_s;     // when it last took or coded something, or was begun to be waited for
    int64_t coded_bytes;
    pid_t process; // 0: does not run
    int feed;      // what is written here it reads; -1: closed
    int coded;     // the file in memory; -1: none
    FILE *messages;
};

// Starts it. False, and one logged line, where it is missing, which is unsupported, or does not
// start. To be ended in either case; `name` outlives it. `patience_s`: how long it may take and
// code nothing while it is waited for; 0: without end.
bool rg_encoder_start(struct rg_encoder *encoder, const char *name, double patience_s,
                      bool (*stop)(void));
// Hands bytes on. False, and one logged line, where it has ended or does nothing.
bool rg_encoder_feed(struct rg_encoder *encoder, const void *data, size_t bytes);
// Says that there are no more, and waits until it has made its file, from the start of `coded`.
// False, and one logged line, where it failed.
bool rg_encoder_finish(struct rg_encoder *encoder);
// Kills it where it still runs, and frees what it holds.
void rg_encoder_end(struct rg_encoder *encoder);

#endif
