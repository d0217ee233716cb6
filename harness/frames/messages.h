// What sessions hand from one process to the other.
#ifndef RG_HARNESS_FRAMES_MESSAGES_H
#define RG_HARNESS_FRAMES_MESSAGES_H

#include "core/techniques/stages/dispatched.h"
#include "harness/frames/subject.h"
#include "harness/devices/workers/message.h"

// A subject goes by names, so that a build with other parameters takes it too: what it does not
// know it refuses only where the value is not the usual one.
void rg_put_subject(struct rg_message *message, const struct rg_subject *subject);
// The caller frees the settings, NULL where it failed.
bool rg_take_subject(struct rg_message *message, struct rg_subject *subject);

void rg_put_account(struct rg_message *message, const struct rg_account *account);
bool rg_take_account(struct rg_message *message, struct rg_account *account);

// Counts, of which -1 is one that is unknown.
void rg_put_tally(struct rg_message *message, const struct rg_tally *tally);
bool rg_take_tally(struct rg_message *message, struct rg_tally *tally);

// A state without its asset; no name where it is none.
void rg_put_layout(struct rg_message *message, const struct rg_state *layout);
bool rg_take_layout(struct rg_message *message, struct rg_state *layout);

// What an image is; a buffer has no levels.
bool rg_take_image_desc(struct rg_message *message, struct rg_image_desc *desc);
// The bytes of what `contents->desc` describes, which was taken before.
bool rg_take_contents_bytes(struct rg_message *message, struct rg_contents *contents);

// What lay in its slots before goes one way, and what lies there after the other.
void rg_put_dispatched(struct rg_message *message, const struct rg_dispatched *dispatched);
void rg_put_dispatched_after(struct rg_message *message, const struct rg_dispatched *dispatched);
// Zeroed before; freed by the caller in either case.
bool rg_take_dispatched(struct rg_message *message, struct rg_dispatched *dispatched);
bool rg_take_dispatched_after(struct rg_message *message, struct rg_dispatched *dispatched);

#endif
