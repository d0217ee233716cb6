// The picture reader's reply, however wrong. The first byte is the file's alleged length in
// kibibytes; the rest is the reply.
#include <stdlib.h>
#include <string.h>

#include "core/image/extras.h"
#include "core/image/files/format.h"
#include "core/image/reader/reply.h"
#include "tests/fuzz/heard.h"

// Mostly makes a reply without an error, whose size fits its texels, with extras in the rest.
// Otherwise nothing else would be tried.
static void mend_header(uint8_t *reply, size_t size)
{
    struct rg_picture_reply header;
    memcpy(&header, reply, sizeof(header));
    if (header.reserved % 4 == 0)
        return;
    header.magic = RG_PICTURE_REPLY_MAGIC;
    header.why[0] = 0;
    const int32_t values = (int32_t)((size - sizeof(header)) / 4);
    if (header.reserved % 4 == 1 && header.channels > 0 && header.channels < 5 && values) {
        header.width = 1 + (int32_t)((uint32_t)header.width % 16);
        header.height = values / header.width / header.channels;
        header.extras_bytes = (uint32_t)(size - sizeof(header) -
                                         (size_t)rg_picture_reply_values(&header) * sizeof(float));
    }
    memcpy(reply, &header, sizeof(header));
}

static void count(void *user, const struct rg_extra *a, const struct rg_extra *b)
{
    *(int *)user += a->name_length + a->value_length + b->value_length;
}

// Checks that the picture has all of the reply, and no more.
static void judge(const struct rg_picture *picture, const uint8_t *reply, size_t size)
{
    struct rg_picture_reply header;
    memcpy(&header, reply, sizeof(header));
    const size_t texels_bytes = (size_t)rg_picture_values(picture) * sizeof(float);
    if (sizeof(header) + texels_bytes + header.extras_bytes != size ||
        header.extras_bytes > RG_PICTURE_EXTRAS_BYTES)
        fuzz_complain("a reply of another size was taken");
    if (picture->extras && strlen(picture->extras) > header.extras_bytes)
        fuzz_complain("extras without an end");
    int heard = 0;
    rg_extras_compare(picture->extras, NULL, count, &heard);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 1 + sizeof(struct rg_picture_reply))
        return 0;
    uint8_t *reply = malloc(size - 1);
    if (!reply)
        abort();
    memcpy(reply, data + 1, size - 1);
    mend_header(reply, size - 1);
    struct rg_picture picture = {0};
    struct rg_why why = {.text = ""};
    if (rg_oiio_take_reply(reply, size - 1, (int64_t)data[0] << 10, RG_PICTURE_MAX_BYTES, &picture,
                           &why))
        judge(&picture, reply, size - 1);
    else if (!*why.text)
        fuzz_complain("refused without a word");
    rg_picture_destroy(&picture);
    free(reply);
    return 0;
}
