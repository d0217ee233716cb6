#include "harness/compare/gate/report/texts.h"

#include <stdint.h>
#include <string.h>

#include "core/base/alloc.h"

enum { FOREIGN = 0xfffd, PICTURES = 0x2400, PICTURE_OF_DELETE = 0x2421, LONGEST = 3 };

// Decodes a character of `*bytes` bytes; FOREIGN, and one byte, if it is not valid UTF-8.
static uint32_t decode(const unsigned char *text, int *bytes)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const int length = *text < 0x80             ? 1
                       : (*text & 0xe0) == 0xc0 ? 2
                       : (*text & 0xf0) == 0xe0 ? 3
                       : (*text & 0xf8) == 0xf0 ? 4
                                                : 0;
    uint32_t code = length == 1 ? *text : *text & (0x7fu >> length);
    *bytes = 1;
    for (int i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return FOREIGN;
        code = code << 6 | (text[i] & 0x3f);
    }
    if (!length || code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
        return FOREIGN;
    *bytes = length;
    return code;
}

// Replaces a character that some form cannot hold; returns others unchanged.
static uint32_t shown(uint32_t code, bool is_line)
{
    if (!is_line && (code == '\n' || code == '\t'))
        return code;
    if (code < 0x20)
        return PICTURES + code;
    if (code == 0x7f)
        return PICTURE_OF_DELETE;
    // 8-bit controls steer terminals; other characters break lines in some readers, or reverse the
    // text after them; XML cannot hold the last two.
    const bool is_control = code >= 0x80 && code < 0xa0;
    const bool is_break = code == 0x2028 || code == 0x2029;
    const bool is_turn = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return is_control || is_break || is_turn || code == 0xfffe || code == 0xffff ? FOREIGN : code;
}

// Writes a character of three bytes, as all replacements are.
static char *put(char *to, uint32_t code)
{
    *to++ = (char)(0xe0 | code >> 12);
    *to++ = (char)(0x80 | (code >> 6 & 0x3f));
    *to++ = (char)(0x80 | (code & 0x3f));
    return to;
}

char *rg_texts_clean(const char *text, bool is_line)
{
    char *made = rg_alloc(strlen(text) * LONGEST + 1, 1, "a report"), *to = made;
    for (const unsigned char *from = (const unsigned char *)text; made && *from;) {
        int bytes;
        const uint32_t code = decode(from, &bytes), kept = shown(code, is_line);
        const bool is_kept = kept == code && (code != FOREIGN || bytes == 3);
        if (is_kept)
            to = (char *)memcpy(to, from, (size_t)bytes) + bytes;
        else
            to = put(to, kept);
        from += bytes;
    }
    return made;
}

size_t rg_texts_fit(const char *text, size_t size)
{
    const size_t length = strnlen(text, size + 1);
    if (length <= size)
        return length;
    while (size > 0 && (text[size] & 0xc0) == 0x80)
        size--;
    return size;
}
