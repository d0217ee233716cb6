// A message between two processes of this program: values one after the other, as they lie in
// memory. Whoever takes them does so in the order in which they were put.
//
// A driver may have scribbled over what its process sends. So taking checks every size, a message
// that is too short or too long has failed, and taking more of it gives nothing.
#ifndef RG_HARNESS_DEVICES_WORKERS_MESSAGE_H
#define RG_HARNESS_DEVICES_WORKERS_MESSAGE_H

#include <stdbool.h>
#include <stdint.h>

// Zeroed: empty. The owner calls rg_message_free.
struct rg_message {
    char *bytes; // owned
    int64_t size, room;
    int64_t at;         // of the next value to take
    bool failed;        // without memory, or taken amiss; one line has been logged
    const char *device; // whose process sent it, which outlives it; NULL: whoever
};

void rg_message_free(struct rg_message *message);

// --- putting ---

void rg_put(struct rg_message *message, const void *bytes, int64_t size);
#define RG_PUT(message, value) rg_put(message, &(value), sizeof(value))
void rg_put_int(struct rg_message *message, int64_t value);
void rg_put_text(struct rg_message *message, const char *text);
// Bytes with their size before them.
void rg_put_block(struct rg_message *message, const void *bytes, int64_t size);

// --- taking: false, 0 or NULL from a message that has failed ---

bool rg_take(struct rg_message *message, void *bytes, int64_t size);
#define RG_TAKE(message, value) rg_take(message, &(value), sizeof(value))
int64_t rg_take_int(struct rg_message *message);
// A number from 0 to `end` - 1; else the message has failed.
int rg_take_index(struct rg_message *message, int end);
// A text of the message, which lives as long; "" where it has failed.
const char *rg_take_text(struct rg_message *message);
// The same text for as long as this process lives: names that structs point to. No process gives
// more of them, or longer ones, than a program has; else the message has failed.
const char *rg_take_name(struct rg_message *message);
// A block, which the caller frees, with a word of zeros behind it; one of no bytes is no NULL. Its
// size is 0 where it is NULL.
void *rg_take_block(struct rg_message *message, int64_t *size);
// For those who find that what they took cannot be: the message has failed. False.
bool rg_message_fail(struct rg_message *message);

#endif
