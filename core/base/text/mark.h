// The byte order mark with which some editors begin a UTF-8 text; it is not part of the text.
#ifndef RG_CORE_BASE_TEXT_MARK_H
#define RG_CORE_BASE_TEXT_MARK_H

#include <stddef.h>
#include <string.h>

// The length in bytes of the text's byte order mark: 3, or 0 where there is none.
static inline size_t rg_mark_bytes(const void *text, size_t size)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t length = sizeof(mark) - 1;
    return size >= length && !memcmp(text, mark, length) ? length : 0;
}

#endif
