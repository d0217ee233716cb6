// The byte order mark that some editors begin a text of UTF-8 with: it is no part of the text.
#ifndef RG_CORE_BASE_TEXT_MARK_H
#define RG_CORE_BASE_TEXT_MARK_H

#include <stddef.h>
#include <string.h>

// How many bytes of the text are its mark: 3, or 0 where there is none.
static inline size_t rg_mark_bytes(const void *text, size_t size)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t length = sizeof(mark) - 1;
    return size >= length && !memcmp(text, mark, length) ? length : 0;
}

#endif
