// What a picture's file holds besides the texels that are read of it, its extras: further channels,
// parts, pages and frames, what is known of its colours but not applied to them, where it is shown.
//
// Extras are a text, so that the reader's process hands them back as they are: a line for each,
// "name TAB value", with a '!' before it where the extra would change the picture and is not
// applied. A name stands once. What is large is told by its size and a digest. NULL: no extras.
#ifndef RG_CORE_IMAGE_EXTRAS_H
#define RG_CORE_IMAGE_EXTRAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Adds an extra; the caller frees the text. Characters that would end a field become '?'. False
// without memory.
bool rg_extras_add(char **extras, bool is_applied, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// One extra of a text; nothing of it is owned, and nothing ends in a zero.
struct rg_extra {
    bool is_applied;
    const char *name, *value;
    int name_length, value_length;
};

// Steps through them: `at` is the text at first. False after the last.
bool rg_extras_next(const char **at, struct rg_extra *extra);

// Tells `hear` of each extra that is in one of the texts only, or has another value there, in the
// order of A, then of B. An extra that is not there has the value "none". Returns how many.
typedef void rg_extras_hear(void *user, const struct rg_extra *a, const struct rg_extra *b);
int rg_extras_compare(const char *a, const char *b, rg_extras_hear *hear, void *user);

#endif
