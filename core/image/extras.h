// Extras: the contents of a picture file besides the texels that we read. Examples are further
// channels, parts, pages and frames, colour information that is not applied, and the place at which
// the picture is shown.
//
// Extras are a text, so that the reader's process can return them unchanged: a line for each, "name
// TAB value". A '!' before it marks an extra that would change the picture and is not applied. Each
// name occurs once. Large values are given by size and digest. NULL: no extras.
#ifndef RG_CORE_IMAGE_EXTRAS_H
#define RG_CORE_IMAGE_EXTRAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Adds an extra; the caller frees the text. Characters that would end a field become '?'. False
// when memory runs out.
bool rg_extras_add(char **extras, bool is_applied, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// One extra of a text. The pointers lead into that text and end in no zero.
struct rg_extra {
    bool is_applied;
    const char *name, *value;
    int name_length, value_length;
};

// Steps through the extras; at first `at` is the text. False after the last.
bool rg_extras_next(const char **at, struct rg_extra *extra);

// Calls `differ` for each extra that only one text has, or whose values differ, in the order of A,
// then of B. A missing extra has the value "none". Returns their number.
typedef void rg_extras_differ(void *user, const struct rg_extra *a, const struct rg_extra *b);
int rg_extras_compare(const char *a, const char *b, rg_extras_differ *differ, void *user);

#endif
