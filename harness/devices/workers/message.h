// A message between two processes of this program: values in sequence, in their memory layout. The
// receiver takes them in the order in which they were put.
//
// A driver may have overwritten the sender's memory. So taking checks every size; a message that is
// too short or too long has failed, and taking more from it gives nothing.
#ifndef RG_HARNESS_DEVICES_WORKERS_MESSAGE_H
#define RG_HARNESS_DEVICES_WORKERS_MESSAGE_H

#include <stdbool.h>
#include <stdint.h>

// Zeroed: empty. The owner calls rg_message_free.
struct rg_message {
    char *bytes; // owned
    int64_t size, room;
    int64_t at;         // offset of the next value to take
    bool failed;        // memory ran out, or the content is invalid; one line was logged
    const char *device; // whose process sent it, which outlives it; NULL: unknown
};

void rg_message_free(struct rg_message *message);

// --- putting ---

void rg_put(struct rg_message *message, const void *bytes, int64_t size);
#define RG_PUT(message, value) rg_put(message, &(value), sizeof(value))
void rg_put_int(struct rg_message *message, int64_t value);
void rg_put_text(struct rg_message *message, const char *text);
// Puts bytes preceded by their size.
void rg_put_block(struct rg_message *message, const void *bytes, int64_t size);

// --- taking: false, 0 or NULL from a message that has failed ---

bool rg_take(struct rg_message *message, void *bytes, int64_t size);
#define RG_TAKE(message, value) rg_take(message, &(value), sizeof(value))
int64_t rg_take_int(struct rg_message *message);
// Takes a number from 0 to `end` - 1; else the message has failed.
int rg_take_index(struct rg_message *message, int end);
// A text in the message, valid as long as it; "" if the message has failed.
const char *rg_take_text(struct rg_message *message);
// The same text, valid for the process's life: for names that structs point to. A message with more
// or longer names than any program has fails.
const char *rg_take_name(struct rg_message *message);
// Takes a block, which the caller frees, with a word of zeros after it; an empty block is not NULL.
// The size is 0 if the result is NULL.
void *rg_take_block(struct rg_message *message, int64_t *size);
// Marks the message as failed because its content is invalid. Returns false.
bool rg_message_fail(struct rg_message *message);

#endif
