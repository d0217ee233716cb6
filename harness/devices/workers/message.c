#include "harness/devices/workers/message.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"

void rg_message_free(struct rg_message *message)
{
    free(message->bytes);
    *message = (struct rg_message){0};
}

enum { WORD_BYTES = 4, MOST_NAMES = 4096, MOST_NAME_BYTES = 256 };

// --- putting ---

void rg_put(struct rg_message *message, const void *bytes, int64_t size)
{
    if (message->failed || !size)
        return;
    message->failed =
        !rg_array_fit(&message->bytes, &message->room, message->size + size, 1, "message");
    if (message->failed || !size)
        return;
    memcpy(message->bytes + message->size, bytes, (size_t)size);
    message->size += size;
}

void rg_put_int(struct rg_message *message, int64_t value)
{
    RG_PUT(message, value);
}

void rg_put_block(struct rg_message *message, const void *bytes, int64_t size)
{
    rg_put_int(message, size);
    rg_put(message, bytes, size);
}

void rg_put_text(struct rg_message *message, const char *text)
{
    rg_put_block(message, text, (int64_t)strlen(text) + 1);
}

// --- taking ---

bool rg_message_fail(struct rg_message *message)
{
    static const char damaged[] = "a message between processes is damaged; a driver may have "
                                  "written over it";
    if (!message->failed && message->device)
        rg_driver_error("device '%s': %s", message->device, damaged);
    else if (!message->failed)
        rg_driver_error("%s", damaged);
    message->failed = true;
    return false;
}

bool rg_take(struct rg_message *message, void *bytes, int64_t size)
{
    if (message->failed || size < 0 || size > message->size - message->at)
        return rg_message_fail(message);
    memcpy(bytes, message->bytes + message->at, (size_t)size);
    message->at += size;
    return true;
}

int64_t rg_take_int(struct rg_message *message)
{
    int64_t value = 0;
    RG_TAKE(message, value);
    return value;
}

int rg_take_index(struct rg_message *message, int end)
{
    const int64_t index = rg_take_int(message);
    if (index >= 0 && index < end)
        return (int)index;
    rg_message_fail(message);
    return 0;
}

// The place of a block in the message; NULL, and size 0, if it does not fit.
static const char *take_place(struct rg_message *message, int64_t *size)
{
    const int64_t said = rg_take_int(message);
    *size = 0;
    if (message->failed || said < 0 || said > message->size - message->at) {
        rg_message_fail(message);
        return NULL;
    }
    const char *place = message->bytes + message->at;
    message->at += *size = said;
    return place;
}

const char *rg_take_text(struct rg_message *message)
{
    int64_t size;
    const char *text = take_place(message, &size);
    if (text && size > 0 && !text[size - 1])
        return text;
    if (text)
        rg_message_fail(message);
    return "";
}

const char *rg_take_name(struct rg_message *message)
{
    static struct kept_name {
        struct kept_name *next;
        char text[];
    } * names;
    static int count;
    const char *text = rg_take_text(message);
    for (const struct kept_name *name = names; name; name = name->next)
        if (!strcmp(name->text, text))
            return name->text;
    if (count == MOST_NAMES || strlen(text) >= MOST_NAME_BYTES) {
        rg_message_fail(message);
        return "";
    }
    struct kept_name *name = malloc(sizeof(*name) + strlen(text) + 1);
    if (!name) {
        message->failed = true;
        rg_harness_error("a message between processes: no memory for a name");
        return "";
    }
    strcpy(name->text, text);
    name->next = names;
    names = name;
    count++;
    return name->text;
}

void *rg_take_block(struct rg_message *message, int64_t *size)
{
    const char *place = take_place(message, size);
    char *block = place ? malloc((size_t)*size + WORD_BYTES) : NULL;
    if (block) {
        memcpy(block, place, (size_t)*size);
        memset(block + *size, 0, WORD_BYTES); // for comparisons of whole words
    }
    if (place && !block) {
        message->failed = true;
        rg_harness_error("a message between processes: no memory for %lld bytes", (long long)*size);
        *size = 0;
    }
    return block;
}
