#include "harness/measure/expected.h"

#include <stdlib.h>

bool rg_expected_read(struct rg_expected *expected, struct rg_session *session)
{
    expected->device = rg_session_device(session)->info;
    expected->texels = rg_session_read(session, &expected->size);
    return expected->texels && rg_session_picture(session, expected->texels, &expected->picture);
}

void rg_expected_free(struct rg_expected *expected)
{
    rg_picture_destroy(&expected->picture);
    rg_picture_destroy(&expected->dry);
    free(expected->texels);
    *expected = (struct rg_expected){0};
}
