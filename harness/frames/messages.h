// What sessions hand from one process to the other.
#ifndef RG_HARNESS_FRAMES_MESSAGES_H
#define RG_HARNESS_FRAMES_MESSAGES_H

#include "harness/frames/subject.h"
#include "harness/devices/workers/message.h"

void rg_put_subject(struct rg_message *message, const struct rg_subject *subject);
// The caller frees the settings, NULL where it failed.
bool rg_take_subject(struct rg_message *message, struct rg_subject *subject);

void rg_put_account(struct rg_message *message, const struct rg_account *account);
bool rg_take_account(struct rg_message *message, struct rg_account *account);

// A state without its asset; no name where it is none.
void rg_put_layout(struct rg_message *message, const struct rg_state *layout);
bool rg_take_layout(struct rg_message *message, struct rg_state *layout);

#endif
