// The messages of sessions between the processes. Structs with a table of fields are sent and
// received by it (harness/devices/workers/fields.h).
#ifndef RG_HARNESS_DEVICES_FRAMES_MESSAGES_H
#define RG_HARNESS_DEVICES_FRAMES_MESSAGES_H

#include "harness/devices/workers/fields.h"
#include "harness/devices/frames/digests.h"

// The request of a call: a name, a number, or both, as the call needs.
struct rg_asked {
    const char *name; // NULL: none
    int number;
};

// A run whose stages are examined, and a row of it.
struct rg_asked_run {
    struct rg_digest_run run; // the message owns its settings if it was received
    int row;
};

// A subject is sent by names, so that builds with other parameters can receive it: they refuse an
// unknown parameter only if it differs from its default.
void rg_put_subject(struct rg_message *message, const struct rg_subject *subject);
// The caller frees the settings, which are NULL on failure.
bool rg_take_subject(struct rg_message *message, struct rg_subject *subject);

// The reply to opening a session.
struct rg_told_session {
    int number, state_count;
};

// The time of each stage of a frame.
struct rg_told_stage {
    const char *kernel;
    double ms;
};
struct rg_told_stages {
    int count;
    int64_t room;
    struct rg_told_stage *rows; // owned
};

// Whether a law holds, and what is wrong if not.
struct rg_told_law {
    bool holds;
    char detail[512];
};

struct rg_told_texture {
    bool is_found;
    struct rg_image_desc desc;
    int first_level;
};

// Raw bytes: texels, words of a state, code.
struct rg_told_bytes {
    void *bytes; // owned
    size_t size;
    struct rg_state layout; // of a state, without its asset; no name for other bytes
};

// The contents of an asset in a run.
struct rg_told_contents {
    struct rg_contents contents;
    struct rg_state state; // its layout, as in struct rg_told_bytes
};

// Fields of the structs above, of struct rg_account, rg_tally, rg_session_code, rg_digests and
// rg_dispatches, of one double, and of one int64_t.
extern const struct rg_field rg_asked_fields[], rg_asked_run_fields[];
extern const struct rg_field rg_told_account_fields[], rg_told_tally_fields[],
    rg_told_code_fields[], rg_told_digests_fields[], rg_told_dispatches_fields[];
extern const struct rg_field rg_told_session_fields[], rg_told_stages_fields[],
    rg_told_law_fields[], rg_told_texture_fields[], rg_told_bytes_fields[],
    rg_told_contents_fields[];
extern const struct rg_field rg_ms_fields[], rg_time_fields[];

// Fields of struct rg_dispatched: its slots' contents before the run, and those after it, which are
// received into the struct of the request.
extern const struct rg_field rg_asked_dispatched_fields[], rg_told_dispatched_fields[];

#endif
