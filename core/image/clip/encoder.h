// vpxenc as a process: frames go in as Y4M, a WebM file in memory comes out.
//
// Its messages are not shown, except the last line if it failed.
#ifndef RG_CORE_IMAGE_CLIP_ENCODER_H
#define RG_CORE_IMAGE_CLIP_ENCODER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

struct rg_encoder {
    const char *name;   // the clip's name, for messages
    bool (*stop)(void); // called while waiting; true gives up, without a message; NULL: never
    double patience_s;  // 0: unlimited
    double since_s;     // when it last read or coded something, or when waiting began
    int64_t coded_bytes;
    pid_t process; // 0: not running
    int feed;      // the socket to its input; -1: closed
    int coded;     // the file in memory that it writes; -1: none
    FILE *messages;
};

// Starts vpxenc. False, and one logged line, where it is missing (unsupported) or does not start.
// Call rg_encoder_end in either case; `name` must outlive the encoder. `patience_s` is the time for
// which it may neither read nor code while the caller waits; 0: unlimited.
bool rg_encoder_start(struct rg_encoder *encoder, const char *name, double patience_s,
                      bool (*stop)(void));
// Writes bytes to the encoder. False, and one logged line, where it has ended or hangs.
bool rg_encoder_feed(struct rg_encoder *encoder, const void *data, size_t bytes);
// Closes the encoder's input and waits until it has written its whole file to `coded`, from offset
// 0. False, and one logged line, where it failed.
bool rg_encoder_finish(struct rg_encoder *encoder);
// Kills the encoder if it still runs, and frees its memory.
void rg_encoder_end(struct rg_encoder *encoder);

#endif
