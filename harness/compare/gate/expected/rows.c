#include <limits.h>

#include "core/base/array.h"
#include "harness/compare/gate/expected/inside.h"

const char *const rg_known_kinds[] = {"skip", "flake", "fail", NULL};
const char *const rg_known_fields[] = {"device", "driver", "outcome", "pixels", "difference",
                                       "reason", "link",   "since",   "until",  NULL};

struct rg_expectation *rg_known_new(struct rg_known *expected, enum rg_known_kind kind,
                                    int64_t line)
{
    if (!rg_array_fit(&expected->rows, &expected->room, expected->count + 1,
                      sizeof(*expected->rows), "expectations"))
        return NULL;
    struct rg_expectation *row = &expected->rows[expected->count++];
    *row = (struct rg_expectation){.kind = kind,
                                   .file = expected->file_count - 1,
                                   .line = line,
                                   .line_count = 1,
                                   .outcomes = RG_KNOWN_ANY,
                                   .until = INT_MAX};
    return row;
}
