// Reports what render drew.
#ifndef RG_HARNESS_COMMANDS_DRAWING_DRAWN_H
#define RG_HARNESS_COMMANDS_DRAWING_DRAWN_H

#include "harness/devices/frames/sequence.h"

// Nothing in it is owned.
struct rg_drawn {
    struct rg_subject subject;
    const struct rg_device_info *on;
    const char *path;                   // of the file, or the pattern of all files
    const struct rg_sequence *sequence; // NULL: one frame
    struct rg_account account;          // after the last frame
};

// Prints one line to stdout.
void rg_drawn_print_text(const struct rg_drawn *drawn);
// Prints the JSON of docs/records.md.
void rg_drawn_print_json(const struct rg_drawn *drawn);

#endif
