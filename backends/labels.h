// Whether passes are named for debuggers, by RG_LABELS=1.
#ifndef RG_BACKENDS_LABELS_H
#define RG_BACKENDS_LABELS_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static inline bool rg_labels_are_asked(void)
{
    const char *asked = getenv("RG_LABELS");
    return asked && !strcmp(asked, "1");
}

#endif
