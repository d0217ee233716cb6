// Text that grows in memory of a fixed size.
#ifndef RG_CORE_BASE_TEXT_ADD_H
#define RG_CORE_BASE_TEXT_ADD_H

#include <stddef.h>

// Appends to a text, as far as it fits into `size` bytes. Unless the text is empty, `between` is
// appended first.
void rg_text_add(char *text, size_t size, const char *between, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
